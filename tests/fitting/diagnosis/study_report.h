#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hoplab::testing {

/// Whether HOPLAB_STATISTICS_QUICK asks for a small part of every table.
bool IsQuick();

/// Number of seeds: `full`, or HOPLAB_STATISTICS_SEEDS if that is set and smaller; 1 with
/// HOPLAB_STATISTICS_QUICK.
int SeedCount(int full);

/// Share in per cent.
double PerCent(long part, long whole);

/// Whether `part` of `whole` may pass for a rate of at least (at most) `rate`: exactly so for the
/// full number of seeds, within the 99 % band of a binomial for fewer.
bool IsAtLeast(long part, long whole, double rate);
bool IsAtMost(long part, long whole, double rate);

/// Central 99 % band of a binomial count.
std::pair<int, int> Band99(int trials, double probability);

/// A part of the report: printed, and written to NAME.md in HOPLAB_STATISTICS_DIR (else the
/// current folder) when it ends.
class Report {
 public:
  Report(std::string name, std::string title);
  ~Report();
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;
  /// A paragraph, formatted as by printf.
  [[gnu::format(printf, 2, 3)]] void Say(const char* format, ...);
  void Head(const std::vector<std::string>& cells);
  void Row(const std::vector<std::string>& cells);

 private:
  void Write(const std::string& line);
  std::string name_, text_;
  bool in_table_ = false;
};
[[gnu::format(printf, 1, 2)]] std::string Cell(const char* format, ...);

}  // namespace hoplab::testing
