#pragma once

#include <optional>
#include <string>

#include "base/range.h"
#include "datasets/dataset.h"
#include "datasets/mechanism_spec.h"
#include "datasets/read_mechanism.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

// The blocks that datasets and scenarios share. Each throws InputError for a missing, unknown or
// misspelt key, a value of the wrong type or outside its range.

ControllerSpec ReadController(const YamlCursor& cursor);
/// All four components.
StateSpec ReadState(const YamlCursor& cursor);
/// Standard deviations of a state, each optional; kFreeSigma where one is absent.
StateSpec ReadStateSigma(const YamlCursor& cursor);
/// "flight", "rolling", "toe", "stance", in the order of StartMode.
const std::vector<std::string>& StartModeNames();
/// Throws, at `owner`, for a start in a mode the mechanism does not have, or along the ground where
/// a guide holds it.
void CheckStart(const YamlCursor& owner, const StateSpec& start, const MechanismSpec& mechanism);
/// What an angle of a touch-down may be.
Range TouchdownAngleRange(MechanismKind type);
/// `touchdown_angle_deg` of `owner`, in rad; required but for a ball (0 without).
double ReadTouchdownAngle(const YamlCursor& owner, MechanismKind type);
/// The channels of a block such as `{body_x_m: {sigma: 0.001}}`, at least one.
std::vector<ChannelSpec> ReadChannels(const YamlCursor& cursor);
/// `train` or `test`.
TrialRole ReadRole(const YamlCursor& cursor);
/// Throws unless `format` of `root` is `expected`; says what to do with the other one of the two.
void CheckFormat(const YamlCursor& root, const std::string& expected);

/// Runs `read` on the value under `key` of `owner`, the value under the same key of `defaults` (may
/// be null) beneath it; nothing where neither has it or the owner's is null.
template <typename Read>
auto ReadOver(const YamlCursor& owner, const char* key, const YamlNode* defaults, Read read)
    -> std::optional<decltype(read(owner))> {
  const YamlNode* own = owner.node().Find(key);
  if (own == nullptr && defaults == nullptr) return std::nullopt;
  const YamlNode merged = own == nullptr        ? *defaults
                          : defaults == nullptr ? *own
                                                : MergeYaml(*defaults, *own);
  if (merged.kind == YamlNode::Kind::kNull) return std::nullopt;
  const std::string path = owner.key_path().empty() ? key : owner.key_path() + "." + key;
  return read(YamlCursor(merged, path));
}

}  // namespace hoplab
