# The simulator for the processor that builds it: with AVX2, which most have had since 2013, dual
# numbers are worked on four directions at a time, in two thirds of the time with sixteen of them.
# Every number is formed by the same operations in the same order, none of them fused: results do not
# differ. The program and the Python module ask for such a processor as they start (base/processor.h).
option(HOPLAB_FOR_THIS_PROCESSOR "Compile the simulator for processors like the one that builds it" OFF)

set(HOPLAB_WITH_AVX2 OFF)
if(HOPLAB_FOR_THIS_PROCESSOR AND NOT CMAKE_CROSSCOMPILING AND NOT HOPLAB_SANITIZE AND NOT HOPLAB_FUZZ)
  include(CheckCXXSourceRuns)
  unset(HOPLAB_HAS_AVX2 CACHE) # the folder may have come from another machine
  check_cxx_source_runs(
    "int main() { return __builtin_cpu_supports(\"avx2\") ? 0 : 1; }" HOPLAB_HAS_AVX2)
  if(HOPLAB_HAS_AVX2)
    set(HOPLAB_WITH_AVX2 ON)
  endif()
endif()
