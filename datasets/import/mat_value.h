#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hoplab {

/// Numbers of one of MATLAB's classes, column by column.
using MatNumbers =
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int8_t>,
                 std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>,
                 std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<std::int64_t>,
                 std::vector<std::uint64_t>>;

/// A value of a MAT-file, as MATLAB's objects are made of.
struct MatValue {
  enum class Kind { kNumbers, kText, kCells, kStruct, kOther };
  Kind kind = Kind::kOther;
  std::vector<std::size_t> size;
  MatNumbers numbers;
  std::vector<double> imaginary;    // of complex doubles
  std::string text;                 // a row of characters, UTF-8
  std::vector<std::string> fields;  // of a struct
  std::vector<MatValue> cells;      // of a cell array, or the fields' values, one struct at a time
};

/// No numbers of a class: double, single, int8, uint8, ... uint64 in the order of MatNumbers.
/// `index` beyond them: uint64.
MatNumbers EmptyNumbers(std::size_t index);

/// How many values `size` says there are; the largest number where that is too many to count.
std::size_t CountOf(const std::vector<std::size_t>& size);

/// The field of a struct that is no array; null for another value.
const MatValue* FieldOf(const MatValue& value, std::string_view field);
/// The first of the value's real numbers; NaN if there is none.
double FirstNumber(const MatValue& value);
/// The texts of a cell array; empty where a cell holds something else.
std::vector<std::string> TextsIn(const MatValue& value);

/// Appends a Unicode character as UTF-8.
void AppendUtf8(std::uint32_t character, std::string* text);
/// UTF-16 code units as UTF-8; half a pair becomes ?.
std::string Utf8Of(const std::vector<std::uint16_t>& units);

}  // namespace hoplab
