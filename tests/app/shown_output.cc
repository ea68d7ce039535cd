#include "tests/app/shown_output.h"

#include <cmath>
#include <regex>
#include <sstream>

namespace hoplab::testing {
namespace {

// One and a half units of the last digit of "20.74", "6e-05".
double LastDigit(const std::string& number) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = std::min(number.find('.'), e);
  const int decimals = point < e ? static_cast<int>(e - point - 1) : 0;
  const int power = e < number.size() ? std::stoi(number.substr(e + 1)) : 0;
  return 1.5 * std::pow(10.0, power - decimals);
}

}  // namespace

std::vector<std::string> ShownLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

bool SameLine(const std::string& shown, const std::string& printed) {
  const std::regex number("[0-9]+(\\.[0-9]+)?([eE][-+]?[0-9]+)?");
  using Iterator = std::sregex_iterator;
  Iterator a(shown.begin(), shown.end(), number), b(printed.begin(), printed.end(), number);
  const Iterator end;
  std::size_t from_a = 0, from_b = 0;
  for (; a != end && b != end; ++a, ++b) {
    const auto at_a = static_cast<std::size_t>(a->position());
    const auto at_b = static_cast<std::size_t>(b->position());
    if (shown.substr(from_a, at_a - from_a) != printed.substr(from_b, at_b - from_b)) return false;
    if (std::abs(std::stod(a->str()) - std::stod(b->str())) > LastDigit(a->str())) return false;
    from_a = at_a + a->str().size();
    from_b = at_b + b->str().size();
  }
  return a == end && b == end && shown.substr(from_a) == printed.substr(from_b);
}

::testing::AssertionResult PrintsAs(const std::vector<std::string>& shown,
                                    const std::vector<std::string>& printed) {
  std::size_t at = 0;
  bool any = false;
  for (const std::string& line : shown) {
    if (line.find_first_not_of(' ') != std::string::npos &&
        line.substr(line.find_first_not_of(' ')) == "...") {
      any = true;
      continue;
    }
    while (any && at < printed.size() && !SameLine(line, printed[at])) ++at;
    if (at >= printed.size() || !SameLine(line, printed[at]))
      return ::testing::AssertionFailure()
             << "the page shows\n"
             << line << "\nand the command prints\n"
             << (at < printed.size() ? printed[at] : "(nothing more)");
    ++at;
    any = false;
  }
  if (!any && at < printed.size())
    return ::testing::AssertionFailure() << "the page does not show\n" << printed[at];
  return ::testing::AssertionSuccess();
}

}  // namespace hoplab::testing
