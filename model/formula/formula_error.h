#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "base/formula_source.h"

namespace hoplab {

/// What is wrong with a FormulaSource.
class FormulaError : public std::runtime_error {
 public:
  /// The part of the source that is wrong.
  enum class Of { kFormula, kActsAs, kParameter, kSource };
  FormulaError(Of of, const std::string& rule, std::string remedy)
      : std::runtime_error(rule), of_(of), remedy_(std::move(remedy)) {}
  /// In the formula's text, from byte `begin` to before `end`.
  FormulaError(std::size_t begin, std::size_t end, const std::string& rule, std::string remedy)
      : std::runtime_error(rule),
        of_(Of::kFormula),
        begin_(begin),
        end_(end),
        remedy_(std::move(remedy)) {}
  /// Of a parameter.
  FormulaError(int parameter, const std::string& rule, std::string remedy)
      : std::runtime_error(rule),
        of_(Of::kParameter),
        parameter_(parameter),
        remedy_(std::move(remedy)) {}

  Of of() const { return of_; }
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  int parameter() const { return parameter_; }
  std::string rule() const { return what(); }
  const std::string& remedy() const { return remedy_; }
  /// The formula's line with a caret under what is wrong; empty unless it is in the formula.
  std::string Picture(const std::string& formula) const;

 private:
  Of of_;
  std::size_t begin_ = 0, end_ = 0;
  int parameter_ = -1;
  std::string remedy_;
};

}  // namespace hoplab
