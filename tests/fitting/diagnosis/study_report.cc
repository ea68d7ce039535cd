#include "tests/fitting/diagnosis/study_report.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace hoplab::testing {

bool IsQuick() { return std::getenv("HOPLAB_STATISTICS_QUICK") != nullptr; }

int SeedCount(int full) {
  if (IsQuick()) return 1;
  const char* wanted = std::getenv("HOPLAB_STATISTICS_SEEDS");
  return wanted ? std::clamp(std::atoi(wanted), 1, full) : full;
}

double PerCent(long part, long whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole)
                   : std::numeric_limits<double>::quiet_NaN();
}

bool IsAtLeast(long part, long whole, double rate) {
  if (whole == 0) return true;
  const bool reduced = IsQuick() || std::getenv("HOPLAB_STATISTICS_SEEDS") != nullptr;
  return reduced ? part >= Band99(static_cast<int>(whole), rate).first
                 : static_cast<double>(part) >= rate * static_cast<double>(whole);
}

bool IsAtMost(long part, long whole, double rate) {
  return IsAtLeast(whole - part, whole, 1.0 - rate);
}

std::pair<int, int> Band99(int trials, double probability) {
  const boost::math::binomial counts(trials, probability);
  int low = 0, high = trials;
  while (boost::math::cdf(counts, low) <= 0.005) ++low;
  while (high > 0 && boost::math::cdf(boost::math::complement(counts, high - 1)) <= 0.005) --high;
  return {low, high};
}

// ---- the report

Report::Report(std::string name, std::string title) : name_(std::move(name)) {
  Write("## " + title);
  Write("");
}

Report::~Report() {
  const char* folder = std::getenv("HOPLAB_STATISTICS_DIR");
  std::ofstream(std::filesystem::path(folder ? folder : ".") / (name_ + ".md")) << text_ << '\n';
}

void Report::Say(const char* format, ...) {
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (in_table_) Write("");
  in_table_ = false;
  Write(text);
  Write("");
}

void Report::Head(const std::vector<std::string>& cells) {
  Row(cells);
  Row(std::vector<std::string>(cells.size(), "---"));
}

void Report::Row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  in_table_ = true;
  Write(line);
}

void Report::Write(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  text_ += line + "\n";
}

std::string Cell(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace hoplab::testing
