#include "datasets/input_spec.h"

#include "datasets/key_advice.h"

namespace hoplab {
namespace {

constexpr Range kDelay = Within(1, "s");
constexpr Range kScale = Within(1e6, "");

InputSpec ReadInput(InputKind id, const YamlCursor& block) {
  InputSpec input;
  input.id = id;
  input.column = InfoOf(id).key;
  input.origin.place = block.place();
  // `hip_torque_N_m:` with nothing behind it is all defaults.
  if (block.node().kind == YamlNode::Kind::kNull) return input;
  block.AllowOnly({"column", "hold", "delay_s", "delay_sigma_s", "scale", "scale_sigma", "clock"});
  if (const auto column = block.Optional("column")) input.column = column->Name();
  if (const auto hold = block.Optional("hold")) {
    const int choice = hold->Choice({"linear", "previous", "stance"});
    input.held = choice > 0;
    input.of_stance = choice == 2;
    if (input.of_stance && id != InputKind::kHipTorque)
      hold->Fail("is for hip_torque_N_m alone", "Write hold: previous, or linear.");
  }
  input.delay_s = block.OptionalNumber("delay_s", kDelay).value_or(0);
  input.delay_sigma_s = block.OptionalNumber("delay_sigma_s", Positive(1, "s"));
  input.scale = block.OptionalNumber("scale", kScale).value_or(1);
  input.scale_sigma = block.OptionalNumber("scale_sigma", Positive(1e6, ""));
  if (const auto clock = block.Optional("clock")) input.clock = clock->Name();
  return input;
}

}  // namespace

std::vector<InputSpec> ReadInputs(const YamlCursor& cursor) {
  std::vector<InputSpec> inputs;
  for (const auto& [name, block] : cursor.Entries(0)) {
    const std::optional<InputKind> id = InputFromKey(name);
    if (!id) {
      const KeyAdvice advice = UnknownKeyAdvice(name, InputKeys());
      block.FailAtKey(
          advice.rule == "unknown key" ? "is nothing that can drive a simulation" : advice.rule,
          advice.remedy);
    }
    inputs.push_back(ReadInput(*id, block));
  }
  return inputs;
}

std::vector<ClockSpec> ReadClocks(const YamlCursor& cursor) {
  std::vector<ClockSpec> clocks;
  for (const auto& [name, block] : cursor.Entries(1)) {
    if (name.find_first_of(". @") != std::string::npos || name.empty())
      block.FailAtKey("a clock's name must be a word without blanks and dots", "Rename it.");
    ClockSpec clock;
    clock.name = name;
    clock.origin.place = block.place();
    block.AllowOnly({"offset_s", "sigma_s", "per"});
    clock.offset_s = block.OptionalNumber("offset_s", kDelay).value_or(0);
    clock.sigma_s = block.OptionalNumber("sigma_s", Positive(1, "s"));
    if (const auto per = block.Optional("per")) {
      clock.per_trial = per->Choice({"dataset", "trial"}) == 1;
      if (clock.per_trial && !clock.sigma_s)
        per->Fail("says that the offset differs between trials, but not by how much",
                  "Add sigma_s, one standard deviation in s.");
    }
    clocks.push_back(std::move(clock));
  }
  return clocks;
}

const InputSpec* FindInput(const std::vector<InputSpec>& inputs, InputKind id) {
  for (const InputSpec& input : inputs)
    if (input.id == id) return &input;
  return nullptr;
}

}  // namespace hoplab
