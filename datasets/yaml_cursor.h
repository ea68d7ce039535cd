#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/range.h"
#include "datasets/yaml_tree.h"

namespace hoplab {

/// A strict view of one YAML value that knows where it stands: `dataset.yaml:12` and
/// `mechanism.leg.E_Pa`. Each reading function throws InputError with both, the value, the rule it
/// breaks and a remedy. The node must outlive the cursor.
class YamlCursor {
 public:
  /// `key_path` is what stands before the keys in messages; empty at the root.
  YamlCursor(const YamlNode& node, std::string key_path)
      : node_(&node), key_path_(std::move(key_path)), key_place_(node.place) {}

  const YamlNode& node() const { return *node_; }
  const std::string& place() const { return node_->place; }
  const std::string& key_path() const { return key_path_; }

  /// Throws unless this is a map with keys from `known` only.
  void AllowOnly(const std::vector<std::string>& known) const;
  /// The value under `key`; throws if it is absent or null. `what` completes "Add KEY: ...".
  YamlCursor Required(std::string_view key, const std::string& what) const;
  /// The value under `key`, or nothing if it is absent or null.
  std::optional<YamlCursor> Optional(std::string_view key) const;

  /// A finite number in `range`.
  double Number(const Range& range) const;
  double RequiredNumber(std::string_view key, const Range& range) const;
  std::optional<double> OptionalNumber(std::string_view key, const Range& range) const;
  /// A whole number in [low, high].
  int Integer(int low, int high) const;

  /// Text, at most `max_length` bytes.
  std::string Text(std::size_t max_length = 10'000) const;
  /// As Text, on one line and not empty: a name.
  std::string Name() const;
  std::string OptionalText(std::string_view key) const;
  /// The index in `choices` of the word that stands here.
  std::size_t Choice(const std::vector<std::string>& choices) const;

  /// The values of a list; throws if this is none or has fewer than `min_size`.
  std::vector<YamlCursor> Items(std::size_t min_size) const;
  /// Keys and values of a map, in order; throws if this is none or has fewer than `min_size`.
  std::vector<std::pair<std::string, YamlCursor>> Entries(std::size_t min_size) const;

  /// Throws the InputError for what stands here.
  [[noreturn]] void Fail(const std::string& rule, const std::string& remedy) const;
  /// The same, at the key instead of the value, for a key that should not be here.
  [[noreturn]] void FailAtKey(const std::string& rule, const std::string& remedy) const;

 private:
  YamlCursor At(const YamlEntry& entry) const;
  std::string Path(std::string_view key) const;

  const YamlNode* node_;
  std::string key_path_;
  std::string key_place_;
};

}  // namespace hoplab
