#include "datasets/known_spec.h"

namespace hoplab {
namespace {

constexpr const char* kAtMost = "at_most";
constexpr Range kSize = Positive(1e15, "");

bool IsText(const YamlCursor& cursor) { return cursor.node().kind == YamlNode::Kind::kScalar; }
bool IsMap(const YamlCursor& cursor) { return cursor.node().kind == YamlNode::Kind::kMap; }

// `none` or {at_most: NUMBER}; absent where it says none.
std::optional<double> ReadSize(const YamlCursor& cursor) {
  if (IsText(cursor)) {
    if (cursor.Text() != "none")
      cursor.Fail("must be none or {at_most: NUMBER}",
                  "Write none if the set-up rules it out, {at_most: NUMBER} if it bounds it.");
    return std::nullopt;
  }
  cursor.AllowOnly({kAtMost});
  return cursor.Required(kAtMost, "how far from none it can be, in its own unit").Number(kSize);
}

}  // namespace

std::vector<KnownSpec> ReadKnown(const YamlCursor& cursor) {
  std::vector<KnownSpec> known;
  for (const auto& [effect, said] : cursor.Entries(0)) {
    const bool by_parameter = IsMap(said) && said.node().Find(kAtMost) == nullptr;
    if (!by_parameter) {
      known.push_back({effect, "", ReadSize(said), {said.place()}});
      continue;
    }
    for (const auto& [parameter, size] : said.Entries(1))
      known.push_back({effect, parameter, ReadSize(size), {size.place()}});
  }
  return known;
}

}  // namespace hoplab
