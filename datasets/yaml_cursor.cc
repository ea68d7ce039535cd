#include "datasets/yaml_cursor.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/key_advice.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;

std::string Shown(const YamlNode& node) {
  switch (node.kind) {
    case Kind::kNull:
      return "(nothing)";
    case Kind::kSequence:
      return "(a list)";
    case Kind::kMap:
      return "(a block of keys)";
    case Kind::kScalar:
      return node.text.empty() ? "(empty text)" : Printable(node.text);
  }
  return "";
}

// What to write in place of a text that is no number: the same with a point for a decimal comma.
std::string NumberRemedy(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma != text.npos) {
    std::string pointed = text;
    pointed[comma] = '.';
    if (ParseDouble(pointed)) return "The decimal sign is a point: " + Printable(pointed) + ".";
  }
  return "Write a number such as 0.09 or 22e9, without unit.";
}

}  // namespace

std::string YamlCursor::Path(std::string_view key) const {
  const std::string shown = Printable(key);
  return key_path_.empty() ? shown : key_path_ + "." + shown;
}

YamlCursor YamlCursor::At(const YamlEntry& entry) const {
  YamlCursor cursor(entry.value, Path(entry.key));
  cursor.key_place_ = entry.key_place;
  return cursor;
}

void YamlCursor::Fail(const std::string& rule, const std::string& remedy) const {
  // An empty path is the whole document; the place says which.
  const std::string value = key_path_.empty() ? "" : key_path_ + " = " + Shown(*node_);
  throw InputError({node_->place, value, rule, remedy});
}

void YamlCursor::FailAtKey(const std::string& rule, const std::string& remedy) const {
  throw InputError({key_place_, key_path_, rule, remedy});
}

void YamlCursor::AllowOnly(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : Entries(0)) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const KeyAdvice advice = UnknownKeyAdvice(key, known);
    value.FailAtKey(advice.rule, advice.remedy);
  }
}

YamlCursor YamlCursor::Required(std::string_view key, const std::string& what) const {
  if (const std::optional<YamlCursor> value = Optional(key)) return *value;
  const std::string owner = key_path_.empty() ? "" : key_path_;
  const YamlNode* empty = node_->Find(key);
  throw InputError({empty != nullptr ? empty->place : node_->place, owner,
                    empty != nullptr ? "the key " + std::string(key) + " has no value"
                                     : "must have the key " + std::string(key),
                    "Add " + std::string(key) + ": " + what + "."});
}

std::optional<YamlCursor> YamlCursor::Optional(std::string_view key) const {
  if (node_->kind != Kind::kMap) Entries(0);
  for (const YamlEntry& entry : node_->entries)
    if (entry.key == key && entry.value.kind != Kind::kNull) return At(entry);
  return std::nullopt;
}

double YamlCursor::Number(const Range& range) const {
  const std::string rule =
      "must be " + std::string(std::isfinite(range.low) || std::isfinite(range.high) ? "in " : "") +
      range.Text();
  if (node_->kind != Kind::kScalar)
    Fail("must be one number; " + rule, "Write a single number here.");
  const std::optional<double> value = ParseDouble(node_->text);
  if (!value) Fail("is not a number; " + rule, NumberRemedy(node_->text));
  if (!range.Contains(*value)) Fail(rule, RangeRemedy(*value, range));
  return *value;
}

double YamlCursor::RequiredNumber(std::string_view key, const Range& range) const {
  return Required(key, "a number in " + range.Text()).Number(range);
}

std::optional<double> YamlCursor::OptionalNumber(std::string_view key, const Range& range) const {
  const std::optional<YamlCursor> value = Optional(key);
  if (!value) return std::nullopt;
  return value->Number(range);
}

int YamlCursor::Integer(int low, int high) const {
  const double value = Number({static_cast<double>(low), static_cast<double>(high)});
  if (value != std::floor(value)) Fail("must be a whole number", "Remove the fraction.");
  return static_cast<int>(value);
}

std::string YamlCursor::Text(std::size_t max_length) const {
  if (node_->kind != Kind::kScalar)
    Fail("must be text", "Write one text here, in quotes if it has a colon or brackets.");
  if (node_->text.size() > max_length)
    Fail("must have at most " + std::to_string(max_length) + " bytes", "Shorten it.");
  return node_->text;
}

std::string YamlCursor::Name() const {
  const std::string text = Text(200);
  const bool has_control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (Trim(text).empty() || has_control)
    Fail("must be a text of one line and not empty", "Write a short name.");
  return text;
}

std::string YamlCursor::OptionalText(std::string_view key) const {
  const std::optional<YamlCursor> value = Optional(key);
  return value ? value->Text() : std::string();
}

std::size_t YamlCursor::Choice(const std::vector<std::string>& choices) const {
  const std::string rule = "must be one of " + Join(choices);
  if (node_->kind != Kind::kScalar) Fail(rule, "Write one of these words.");
  const auto found = std::find(choices.begin(), choices.end(), node_->text);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const std::optional<std::string> nearest = NearestWord(node_->text, choices);
  Fail(rule, nearest ? "Did you mean " + *nearest + "?" : "Write one of these words.");
}

std::vector<YamlCursor> YamlCursor::Items(std::size_t min_size) const {
  if (node_->kind != Kind::kSequence)
    Fail("must be a list", "Write `- ` before each item, or [a, b].");
  if (node_->items.size() < min_size)
    Fail("must have at least " + std::to_string(min_size) + (min_size == 1 ? " item" : " items"),
         "Add what is missing.");
  std::vector<YamlCursor> items;
  for (const YamlNode& item : node_->items)
    items.emplace_back(item, key_path_ + "[" + std::to_string(items.size()) + "]");
  return items;
}

std::vector<std::pair<std::string, YamlCursor>> YamlCursor::Entries(std::size_t min_size) const {
  if (node_->kind != Kind::kMap)
    Fail("must be a block of keys and values", "Write `key: value` lines, or {key: value}.");
  if (node_->entries.size() < min_size)
    Fail("must have at least " + std::to_string(min_size) + (min_size == 1 ? " key" : " keys"),
         "Add what is missing.");
  std::vector<std::pair<std::string, YamlCursor>> entries;
  for (const YamlEntry& entry : node_->entries) entries.emplace_back(entry.key, At(entry));
  return entries;
}

}  // namespace hoplab
