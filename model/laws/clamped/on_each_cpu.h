#pragma once

// What is compiled once for plain processors and once for those that work on four or eight numbers
// at a time, and chosen as the program starts. Every number is formed by the same operations, none
// of them fused (-ffp-contract=off): results do not differ.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HOPLAB_ON_EACH_CPU __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define HOPLAB_ON_EACH_CPU
#endif
