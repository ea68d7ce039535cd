#include "app/terminal/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>

#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {
namespace {
constexpr std::size_t kNameColumn = 25;
constexpr char kSeparator = '|';

// Behind a message: how "0,001" is to be written; else `other`.
std::string NumberRemedy(const std::string& word, const std::string& other) {
  std::string pointed = word;
  const std::size_t comma = pointed.find(',');
  if (comma == pointed.npos) return other;
  pointed[comma] = '.';
  if (!ParseDouble(pointed)) return other;
  return " The decimal sign is a point: " + Printable(pointed) + ".";
}

}  // namespace

HelpFormatter::HelpFormatter(std::size_t columns) : columns_(columns) { column_width(kNameColumn); }

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  return Line(make_option_name(option, is_positional) + make_option_opts(option),
              make_option_desc(option));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  return option->get_option_text().empty() ? "" : " " + option->get_option_text();
}

std::string HelpFormatter::make_subcommand(const CLI::App* sub) const {
  return Line(sub->get_name(), sub->get_description());
}

std::string HelpFormatter::Line(const std::string& name, const std::string& description) const {
  // A long name pushes its own description only: the reader's column stays where it is.
  const std::string begin = fmt::format("{:<{}}", "  " + name, kNameColumn);
  const std::string text = Wrapped(description, kNameColumn, columns_);
  if (begin.size() <= kNameColumn) return begin + text + "\n";
  return begin + "\n" + std::string(kNameColumn, ' ') + text + "\n";
}

CLI::Validator OneOf(const std::vector<std::string>& words) {
  return {[words](std::string& word) {
            return std::find(words.begin(), words.end(), word) != words.end()
                       ? std::string()
                       : Printable(word) + " is none of its values. " + DidYouMean(word, words);
          },
          Join(words, std::string(1, kSeparator)), "OneOf"};
}

CLI::Validator NumberIn(double least, double most) {
  return {[least, most](std::string& word) {
            const std::optional<double> value = ParseDouble(word);
            if (value && *value >= least && *value <= most) return std::string();
            return Printable(word) + fmt::format(" is no number from {:g} to {:g}.", least, most) +
                   NumberRemedy(word, " Give one.");
          },
          "", "NumberIn"};
}

CLI::Validator NumberAbove0(double most, double least) {
  return {[most, least](std::string& word) {
            const std::optional<double> value = ParseDouble(word);
            const bool above = value && *value > 0.0;
            if (above && *value >= least && *value <= most) return std::string();
            std::string rule = "a number above 0";
            if (above) rule = "at most " + FormatDouble(most);
            if (above && *value < least) rule = "at least " + FormatDouble(least);
            return Printable(word) + "; must be " + rule + "." + NumberRemedy(word, "");
          },
          "", "NumberAbove0"};
}

CLI::Validator WholeNumber() {
  return {[](std::string& word) {
            std::uint64_t value = 0;
            const char* const end = word.data() + word.size();
            const auto [stop, error] = std::from_chars(word.data(), end, value);
            if (error == std::errc() && stop == end) return std::string();
            return Printable(word) + "; must be a whole number from 0 to " +
                   std::to_string(std::numeric_limits<std::uint64_t>::max()) + ".";
          },
          "", "WholeNumber"};
}

std::vector<std::string> ChoicesOf(const CLI::Option& option) {
  // CLI11 tells the descriptions of an option's validators behind its type, as TEXT:a|b.
  const std::string type = option.get_type_name();
  if (type.find(kSeparator) == type.npos) return {};
  std::vector<std::string> words;
  for (std::size_t begin = type.find(':') + 1; begin <= type.size();) {
    const std::size_t end = std::min(type.find(kSeparator, begin), type.size());
    words.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace hoplab
