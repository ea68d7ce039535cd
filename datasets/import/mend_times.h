#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace hoplab {

/// A row of a log and its stamp.
struct StampedRow {
  std::size_t row = 0;  // of the log
  std::string text;     // the stamp in s, as printed
  double time_s = 0;
};

/// What was done to a log's stamps.
struct MendedTimes {
  std::size_t swapped = 0;  // rows put where their stamps belong
  std::size_t dropped = 0;  // rows that repeat the one before, stamp and samples
  std::size_t spread = 0;   // rows that shared a stamp and got one of their own
  bool any() const { return swapped + dropped + spread > 0; }
  /// "2 rows swapped back, 1 repeated row dropped"; empty where nothing was done.
  std::string Text() const;
};

/// A row that lies further than this many rows from where its stamp belongs was not swapped: the
/// clock was set back.
inline constexpr std::size_t kFurthestSwap = 8;

/// Makes the stamps of `rows` increase: rows are sorted by their stamps, of rows with one stamp and
/// the same samples (`same_samples(row, other)`) all but the first are dropped, and rows with one
/// stamp and other samples are spread evenly up to the next stamp (the last ones by the step
/// before). `too_far(row)` is called, and must throw, for a row that lies more than kFurthestSwap
/// rows from its place.
MendedTimes MendTimes(std::vector<StampedRow>& rows,
                      const std::function<bool(std::size_t, std::size_t)>& same_samples,
                      const std::function<void(std::size_t)>& too_far);

}  // namespace hoplab
