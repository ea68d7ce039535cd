#include <cstddef>
#include <cstdint>

#include "tests/datasets/fuzz_entry.h"

// libFuzzer's entry: anything that ReadHostileBytes lets out ends the run as a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hoplab::testing::ReadHostileBytes({reinterpret_cast<const char*>(data), size});
  return 0;
}
