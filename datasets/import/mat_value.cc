#include "datasets/import/mat_value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hoplab {
namespace {

template <std::size_t... kIndex>
MatNumbers EmptyAt(std::size_t index, std::index_sequence<kIndex...>) {
  MatNumbers numbers = std::vector<std::uint64_t>();
  ((index == kIndex ? void(numbers.emplace<kIndex>()) : void()), ...);
  return numbers;
}

}  // namespace

MatNumbers EmptyNumbers(std::size_t index) {
  return EmptyAt(index, std::make_index_sequence<std::variant_size_v<MatNumbers>>());
}

std::size_t CountOf(const std::vector<std::size_t>& size) {
  std::size_t count = 1;
  for (const std::size_t n : size) {
    if (n != 0 && count > std::numeric_limits<std::size_t>::max() / n)
      return std::numeric_limits<std::size_t>::max();
    count *= n;
  }
  return size.empty() ? 0 : count;
}

const MatValue* FieldOf(const MatValue& value, std::string_view field) {
  if (value.kind != MatValue::Kind::kStruct || value.cells.size() != value.fields.size())
    return nullptr;
  const auto found = std::find(value.fields.begin(), value.fields.end(), field);
  if (found == value.fields.end()) return nullptr;
  return &value.cells[static_cast<std::size_t>(found - value.fields.begin())];
}

double FirstNumber(const MatValue& value) {
  if (value.kind != MatValue::Kind::kNumbers) return std::nan("");
  return std::visit(
      [](const auto& numbers) {
        return numbers.empty() ? std::nan("") : static_cast<double>(numbers.front());
      },
      value.numbers);
}

std::vector<std::string> TextsIn(const MatValue& value) {
  std::vector<std::string> texts;
  if (value.kind != MatValue::Kind::kCells) return texts;
  for (const MatValue& cell : value.cells) texts.push_back(cell.text);
  return texts;
}

void AppendUtf8(std::uint32_t character, std::string* text) {
  const auto add = [&](std::uint32_t byte) { *text += static_cast<char>(byte); };
  if (character < 0x80) return add(character);
  if (character < 0x800) {
    add(0xC0 | character >> 6);
  } else if (character < 0x10000) {
    add(0xE0 | character >> 12);
    add(0x80 | (character >> 6 & 0x3F));
  } else {
    add(0xF0 | (character >> 18 & 0x07));
    add(0x80 | (character >> 12 & 0x3F));
    add(0x80 | (character >> 6 & 0x3F));
  }
  add(0x80 | (character & 0x3F));
}

std::string Utf8Of(const std::vector<std::uint16_t>& units) {
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::uint32_t unit = units[i];
    const bool first = unit >= 0xD800 && unit < 0xDC00;
    const bool second =
        first && i + 1 < units.size() && units[i + 1] >= 0xDC00 && units[i + 1] < 0xE000;
    if (second) {
      AppendUtf8(0x10000 + ((unit - 0xD800) << 10) + (units[++i] - 0xDC00u), &text);
    } else if (unit >= 0xD800 && unit < 0xE000) {
      text += '?';
    } else {
      AppendUtf8(unit, &text);
    }
  }
  return text;
}

}  // namespace hoplab
