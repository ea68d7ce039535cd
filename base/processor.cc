#include "base/processor.h"

namespace hoplab {

const char* MissingOfProcessor() {
#ifdef HOPLAB_NEEDS_AVX2
  if (!__builtin_cpu_supports("avx2")) return "AVX2";
#endif
  return nullptr;
}

}  // namespace hoplab
