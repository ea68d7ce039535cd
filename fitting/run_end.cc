#include "fitting/run_end.h"

#include <cmath>
#include <optional>
#include <vector>

#include "base/text.h"
#include "model/formula/formula.h"

namespace hoplab {
namespace {

std::string FormulaText(const Formula& formula) {
  return "the formula " + formula.source().name + " (" + formula.source().acts_as + "), " +
         formula.source().formula;
}

double VariableOf(FormulaVariable variable, const BodyMotion<double>& body) {
  using V = FormulaVariable;
  switch (variable) {
    case V::kTime:
      return body.t;
    case V::kX:
      return body.x;
    case V::kY:
      return body.y;
    case V::kVx:
      return body.vx;
    case V::kVy:
      return body.vy;
    case V::kSpeed:
      return std::hypot(body.vx, body.vy);
    default:
      return body.in_stance ? 1.0 : 0.0;
  }
}

// "x = 0 m, vx = 1.3 m/s": what the formula knows there.
std::string PlaceText(const Formula& formula, const BodyMotion<double>& body) {
  std::vector<std::string> words;
  for (const VariableInfo& v : InfoOf(formula.place()).variables) {
    if (!formula.Uses(v.variable)) continue;
    const std::string unit = v.unit == "1" || v.unit == "-" ? "" : " " + std::string(v.unit);
    words.push_back(std::string(v.name) + " = " + Rounded(VariableOf(v.variable, body)) + unit);
  }
  return Join(words);
}

// Where the run was last known to be.
std::optional<BodyMotion<double>> LastMotion(const Trajectory& run,
                                             std::span<const double> initial) {
  const bool in_stance = run.final_mode != Mode::kFlight;
  const auto known = [](std::span<const double> z) {
    return z.size() >= 4 && std::isfinite(z[0] + z[1] + z[2] + z[3]);
  };
  for (const std::span<const double> z : {std::span<const double>(run.final_state), initial})
    if (known(z)) return BodyMotion<double>{run.end_time, z[0], z[1], z[2], z[3], in_stance};
  return std::nullopt;
}

bool IsNumber(const EffectSetting& setting, const BodyMotion<double>& body) {
  CornerSides sides;
  sides.fill(kFreeSide);
  Vector2<double> force{0.0, 0.0};
  setting.effect->formula->AddBodyForce(setting.values.data(), sides, body, force);
  return std::isfinite(force.x) && std::isfinite(force.y);
}

// Where the formula is no number, there or a moment later: a solver stops before such a place.
std::optional<BodyMotion<double>> FaultOf(const EffectSetting& setting,
                                          const BodyMotion<double>& last) {
  for (const double later : {0.0, 1e-6, 1e-4, 1e-2}) {
    BodyMotion<double> body = last;
    body.t += later;
    body.x += later * body.vx;
    body.y += later * body.vy;
    if (!IsNumber(setting, body)) return body;
  }
  return std::nullopt;
}

}  // namespace

std::string WhyEnded(const Trajectory& run, std::span<const EffectSetting> effects,
                     std::span<const double> initial) {
  const std::string sentence(SentenceOf(run.outcome));
  if (run.outcome != Outcome::kIntegrationFailed) return sentence;
  const auto last = LastMotion(run, initial);
  std::string others;
  for (const EffectSetting& setting : effects) {
    if (setting.effect->formula == nullptr) continue;
    const Formula& formula = *setting.effect->formula;
    const auto fault = last ? FaultOf(setting, *last) : std::nullopt;
    if (fault)
      return "could not go on: " + FormulaText(formula) + ", is no number at " +
             PlaceText(formula, *fault);
    others += " or of " + FormulaText(formula);
  }
  return sentence + others;
}

}  // namespace hoplab
