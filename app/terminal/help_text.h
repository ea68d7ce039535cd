#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hoplab {

/// Help of CLI11 with descriptions wrapped to `columns`, placeholders without types.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::size_t columns);

  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* sub) const override;

 private:
  std::string Line(const std::string& name, const std::string& description) const;

  std::size_t columns_;
};

/// Accepts one of `words`, and says which was meant where a word is none of them.
CLI::Validator OneOf(const std::vector<std::string>& words);

/// A number from `least` to `most`.
CLI::Validator NumberIn(double least, double most);

/// A number above 0 from `least` to `most`.
CLI::Validator NumberAbove0(double most, double least = 0.0);

/// A number from 0 to 2^64 - 1, in digits.
CLI::Validator WholeNumber();

/// The words of OneOf, or none for an option that takes anything.
std::vector<std::string> ChoicesOf(const CLI::Option& option);

}  // namespace hoplab
