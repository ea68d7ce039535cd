#include "datasets/effect_file.h"

#include <optional>

#include "datasets/read_spec.h"
#include "datasets/text_file.h"
#include "datasets/yaml_cursor.h"
#include "datasets/yaml_tree.h"

namespace hoplab {
namespace {

constexpr const char* kEffectFormat = "hoplab-effect/1";
constexpr std::size_t kMostBytes = 64 << 10;
constexpr Range kBound = Within(1e15, "");

FormulaParameter ReadParameter(const std::string& name, const YamlCursor& cursor) {
  cursor.AllowOnly({"unit", "null", "value", "lower", "upper", "typical"});
  FormulaParameter p;
  p.name = name;
  p.unit = cursor.Required("unit", "as \"N s/m\", or 1 for a plain number").Text();
  p.null = cursor.OptionalNumber("null", kBound);
  p.value = cursor.OptionalNumber("value", kBound);
  p.lower = cursor.RequiredNumber("lower", kBound);
  p.upper = cursor.RequiredNumber("upper", kBound);
  p.typical = cursor.OptionalNumber("typical", kBound);
  return p;
}

}  // namespace

bool IsEffectFile(std::string_view name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

EffectFile ReadEffectBlock(const YamlCursor& block) {
  if (block.node().kind == YamlNode::Kind::kNull)
    block.Fail("is empty; must begin with format: hoplab-effect/1",
               "See docs/adding/formula.md for an example.");
  CheckFormat(block, kEffectFormat);
  block.AllowOnly({"format", "name", "acts_as", "formula", "parameters", "sentence"});
  EffectFile file;
  file.origin.place = block.place();
  file.source.name = block.Required("name", "a short name").Name();
  const YamlCursor acts_as = block.Required("acts_as", "where it acts, as body_force_x");
  file.source.acts_as = acts_as.Name();
  file.acts_as_origin.place = acts_as.place();
  const YamlCursor formula = block.Required("formula", "what it adds there, as \"-c * vx\"");
  file.source.formula = formula.Text(kMostBytes);
  file.formula_origin.place = formula.place();
  for (const auto& [name, parameter] :
       block.Required("parameters", "a block with unit, null, lower and upper of each")
           .Entries(1)) {
    file.source.parameters.push_back(ReadParameter(name, parameter));
    file.parameter_origins.push_back({parameter.place()});
  }
  file.source.sentence = block.OptionalText("sentence");
  if (file.source.sentence.empty()) file.source.sentence = file.source.name;
  return file;
}

EffectFile ParseEffectFile(std::string_view text, const std::string& place) {
  YamlLimits limits;
  limits.max_bytes = kMostBytes;
  const YamlNode node = ParseYaml(text, place, limits);
  return ReadEffectBlock(YamlCursor(node, ""));
}

EffectFile ReadEffectFile(const std::filesystem::path& file) {
  return ParseEffectFile(ReadFileBytes(file, kMostBytes, "An effect is a formula of one line."),
                         file.string());
}

}  // namespace hoplab
