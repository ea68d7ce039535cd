#pragma once

#include <cstddef>
#include <cstdint>

namespace hoplab {

// What no log of hops needs: a file with more is damaged, or made to fill the memory.
inline constexpr std::uint64_t kMostBytes = 1ull << 30;      // of a file
inline constexpr std::size_t kMostNumbers = 20'000'000;      // of a file's tables
inline constexpr std::size_t kWidestMatrix = 256;            // columns
inline constexpr int kDeepestStruct = 4;                     // structs within structs
inline constexpr int kDeepestValue = 24;                     // values within MATLAB objects
inline constexpr std::size_t kMostObjectValues = 2'000'000;  // of MATLAB objects

}  // namespace hoplab
