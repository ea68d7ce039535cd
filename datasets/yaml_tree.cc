#include "datasets/yaml_tree.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;

std::optional<std::size_t> PlaceInList(std::string_view text) {
  std::size_t index = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, index);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return index;
}

[[noreturn]] void BadSetKey(std::string_view dotted_key, const std::string& place,
                            const std::string& rule) {
  throw InputError({place, Printable(dotted_key), rule,
                    "Give a key as it stands in the file, parts joined by dots: "
                    "mechanism.leg.E_Pa."});
}

YamlNode& ListItem(YamlNode& list, std::string_view part, std::string_view dotted_key,
                   const std::string& place) {
  const std::optional<std::size_t> index = PlaceInList(part);
  if (!index || *index >= list.items.size())
    BadSetKey(dotted_key, place,
              "`" + Printable(part) + "` must be the place in a list of " +
                  std::to_string(list.items.size()) + ", counted from 0");
  return list.items[*index];
}

}  // namespace

const YamlNode* YamlNode::Find(std::string_view key) const {
  for (const YamlEntry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

YamlNode* YamlNode::Find(std::string_view key) {
  return const_cast<YamlNode*>(std::as_const(*this).Find(key));
}

const YamlNode* YamlNode::At(std::string_view key) const {
  if (kind != Kind::kSequence) return Find(key);
  const std::optional<std::size_t> place = PlaceInList(key);
  return place && *place < items.size() ? &items[*place] : nullptr;
}

void YamlNode::Erase(std::string_view key) {
  std::erase_if(entries, [&](const YamlEntry& entry) { return entry.key == key; });
}

YamlNode MergeYaml(YamlNode base, const YamlNode& overlay) {
  if (base.kind != Kind::kMap || overlay.kind != Kind::kMap) return overlay;
  for (const YamlEntry& entry : overlay.entries) {
    YamlNode* present = base.Find(entry.key);
    if (entry.value.kind == Kind::kNull) {
      base.Erase(entry.key);
    } else if (present == nullptr) {
      base.entries.push_back(entry);
    } else {
      *present = MergeYaml(std::move(*present), entry.value);
    }
  }
  base.place = overlay.place;
  return base;
}

void SetYaml(YamlNode& root, std::string_view dotted_key, YamlNode value,
             const std::vector<std::string>& whole_key_maps) {
  const std::string place = value.place;
  if (dotted_key.size() > 200) BadSetKey(dotted_key, place, "is too long for a key");
  YamlNode* node = &root;
  std::string_view rest = dotted_key;
  while (true) {
    const std::string_view walked = dotted_key.substr(0, dotted_key.size() - rest.size());
    const std::string_view parent = walked.substr(0, walked.empty() ? 0 : walked.size() - 1);
    const bool whole =
        std::find(whole_key_maps.begin(), whole_key_maps.end(), parent) != whole_key_maps.end();
    const std::size_t end = whole ? rest.size() : std::min(rest.find('.'), rest.size());
    const std::string_view part = rest.substr(0, end);
    if (part.empty()) BadSetKey(dotted_key, place, "has an empty part");

    if (node->kind == Kind::kSequence) {
      node = &ListItem(*node, part, dotted_key, place);
    } else if (node->kind == Kind::kMap || node->kind == Kind::kNull) {
      if (node->kind == Kind::kNull) {
        node->kind = Kind::kMap;
        node->place = place;
      }
      if (node->Find(part) == nullptr) {
        YamlEntry entry;
        entry.key = part;
        entry.key_place = place;
        entry.value.place = place;
        node->entries.push_back(std::move(entry));
      }
      node = node->Find(part);
    } else {
      BadSetKey(dotted_key, place, "leads through a value that has no keys below it");
    }
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  *node = std::move(value);
}

}  // namespace hoplab
