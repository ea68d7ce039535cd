#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/formula_source.h"
#include "datasets/origin.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

/// An effect as a formula, out of a file of the format hoplab-effect/1. What the formula says is
/// not checked here.
struct EffectFile {
  FormulaSource source;
  Origin origin = {}, formula_origin = {}, acts_as_origin = {};
  std::vector<Origin> parameter_origins = {};  // one a parameter
  bool operator==(const EffectFile&) const = default;
};

/// Whether a name given for an effect is that of a file.
bool IsEffectFile(std::string_view name);

/// The same where it stands inside another file, as a block.
EffectFile ReadEffectBlock(const YamlCursor& block);
/// Throws InputError if the file is absent, too large or not of the format.
EffectFile ReadEffectFile(const std::filesystem::path& file);
/// The same for a text in memory; `place` is its name in messages.
EffectFile ParseEffectFile(std::string_view text, const std::string& place);

}  // namespace hoplab
