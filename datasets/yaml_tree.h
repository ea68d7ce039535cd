#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

struct YamlEntry;

/// A YAML document as plain values: every scalar is text, aliases are replaced by what they stand
/// for, and each node knows its place. yaml-cpp stays behind ParseYaml.
struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };
  Kind kind = Kind::kNull;
  std::string text;                // kScalar
  std::vector<YamlNode> items;     // kSequence
  std::vector<YamlEntry> entries;  // kMap, in the order of the file
  std::string place;               // "dataset.yaml:12" or "--set key"

  /// The value under `key`, or null if this is no map or has no such key.
  const YamlNode* Find(std::string_view key) const;
  YamlNode* Find(std::string_view key);
  /// The value under `key`, or the item of a list at that place, counted from 0; null if there is
  /// none.
  const YamlNode* At(std::string_view key) const;
  /// Removes `key` and its value if they are there.
  void Erase(std::string_view key);
};

struct YamlEntry {
  std::string key;
  std::string key_place;
  YamlNode value;
};

/// What to do about a YAML file that is too large.
inline constexpr const char* kSamplesElsewhere = "Samples belong into the CSV files.";

/// Limits that no honest file comes near, and that keep a hostile one from costing anything.
struct YamlLimits {
  std::size_t max_bytes = 1 << 20;           // of the file
  std::size_t max_nodes = 100'000;           // with every alias written out
  std::size_t max_expanded_bytes = 4 << 20;  // of text, with every alias written out
  int max_depth = 24;
};

/// Reads one YAML document. Throws InputError with `document`:line if it is too large, no text, not
/// valid YAML, more than one document, nested too deeply, if a key is repeated or not plain text,
/// if a tag is used, if an alias names itself, or if the aliases expand beyond the limits (counted
/// while parsing, before anything is copied).
YamlNode ParseYaml(std::string_view bytes, const std::string& document,
                   const YamlLimits& limits = {});

/// As ParseYaml, for a value given outside a file: every node has the place `place`.
YamlNode ParseYamlValue(std::string_view text, const std::string& place);

/// `base` with the values of `overlay` put over it: maps are merged key by key, anything else is
/// replaced, and a null in `overlay` removes the key.
YamlNode MergeYaml(YamlNode base, const YamlNode& overlay);

/// Puts `value` at a dotted key such as `mechanism.leg.E_Pa` or `dataset.trials.0.role`, making
/// maps on the way. What follows one of `whole_key_maps` is one key, dots included:
/// `search.over.controller.kp_N_s` with `search.over` among them. Throws InputError with the
/// value's place if the key is empty, leads through a number or text, or past the end of a list.
void SetYaml(YamlNode& root, std::string_view dotted_key, YamlNode value,
             const std::vector<std::string>& whole_key_maps = {});

}  // namespace hoplab
