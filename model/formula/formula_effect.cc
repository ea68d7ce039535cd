#include "model/formula/formula_effect.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <list>
#include <mutex>

#include "base/random.h"
#include "base/text.h"

namespace hoplab {
namespace {

// An effect with all it points at.
struct Kept {
  Formula formula;
  std::string equation;
  std::vector<EffectParameter> parameters;
  Effect effect;

  explicit Kept(const FormulaSource& from) : formula(from) {}
};

bool IsName(const std::string& name) {
  constexpr std::size_t kLongest = 40;
  if (name.empty() || name.size() > kLongest) return false;
  if (std::isdigit(static_cast<unsigned char>(name.front()))) return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  });
}

void CheckParameterName(const FormulaSource& source, int i) {
  const std::string& name = source.parameters[static_cast<std::size_t>(i)].name;
  if (!IsName(name))
    throw FormulaError(i, "is no name of a parameter",
                       "Use letters, digits and _, a letter first, at most 40 of them.");
  for (const PlaceInfo& place : AllPlaces()) {
    if (place.name != source.acts_as) continue;
    for (const VariableInfo& v : place.variables)
      if (v.name == name)
        throw FormulaError(i, "is the name of a variable of " + source.acts_as,
                           "Call the parameter otherwise.");
  }
  for (int j = 0; j < i; ++j)
    if (source.parameters[static_cast<std::size_t>(j)].name == name)
      throw FormulaError(i, "is there twice", "Remove one of the two.");
}

void CheckParameter(const FormulaSource& source, int i) {
  CheckParameterName(source, i);
  const FormulaParameter& p = source.parameters[static_cast<std::size_t>(i)];
  if (p.null.has_value() == p.value.has_value())
    throw FormulaError(i, p.null ? "has both a null and a value" : "has neither a null nor a value",
                       "Give null, at which the formula is zero, or value, if it only shapes it.");
  if (!(p.lower < p.upper))
    throw FormulaError(i,
                       "has the bounds [" + FormatDouble(p.lower) + ", " + FormatDouble(p.upper) +
                           "], which leave nothing",
                       "lower must be below upper.");
  const double at = p.null ? *p.null : *p.value;
  if (!(at >= p.lower && at <= p.upper))
    throw FormulaError(i,
                       std::string(p.null ? "null" : "value") + " = " + FormatDouble(at) +
                           " lies outside its bounds [" + FormatDouble(p.lower) + ", " +
                           FormatDouble(p.upper) + "]",
                       "Move the bounds, or the number.");
  if (p.typical && (!std::isfinite(*p.typical) || *p.typical == 0.0))
    throw FormulaError(i, "typical must be a number off zero",
                       "Give the size you expect when the effect is there.");
}

void CheckParameters(const FormulaSource& source) {
  const std::size_t count = source.parameters.size();
  if (count == 0)
    throw FormulaError(FormulaError::Of::kSource, "has no parameters",
                       "Give the formula a factor that may be zero, as c in \"-c * vx\".");
  if (count > kMostFormulaParameters)
    throw FormulaError(FormulaError::Of::kSource,
                       "has " + std::to_string(count) + " parameters; there may be " +
                           std::to_string(kMostFormulaParameters),
                       "Write numbers for those that are known.");
  for (int i = 0; i < static_cast<int>(count); ++i) CheckParameter(source, i);
  const bool has_null = std::any_of(source.parameters.begin(), source.parameters.end(),
                                    [](const FormulaParameter& p) { return p.null.has_value(); });
  if (!has_null)
    throw FormulaError(FormulaError::Of::kSource, "has no parameter with a null",
                       "Give the factor in front of the formula null: 0.");
}

double TypicalOf(const FormulaParameter& p) {
  if (p.typical) return *p.typical;
  const double at = p.null ? *p.null : *p.value;
  if (!p.null && at != 0.0) return 0.1 * std::abs(at);
  return 0.05 * std::max(std::abs(p.upper - at), std::abs(p.lower - at));
}

// A formula that is not zero at null would be there without anybody asking for it.
void CheckZeroAtNull(const Kept& kept) {
  std::vector<double> values;
  for (const EffectParameter& p : kept.parameters) values.push_back(p.null);
  values.resize(kMaxEffectParameters, 0.0);
  const PlaceInfo& place = InfoOf(kept.formula.place());
  RandomStream random(1, 1);
  for (int trial = 0; trial < 32; ++trial) {
    std::array<double, kFormulaVariables> at{};
    FormulaView<double> view{};
    for (const VariableInfo& v : place.variables) {
      const auto i = static_cast<std::size_t>(v.variable);
      const double u = random.Uniform(0.0, 1.0);
      at[i] = v.usual * (v.never_negative ? u : 2.0 * u - 1.0);
      view[i] = &at[i];
    }
    CornerSides sides;
    sides.fill(kFreeSide);
    const double value = kept.formula.Evaluate(values.data(), view, sides);
    if (value == 0.0 || std::isnan(value)) continue;
    throw FormulaError(FormulaError::Of::kFormula,
                       "is " + FormatDouble(value) + " where its parameters are at null",
                       "It must be zero there: multiply it by a parameter with null: 0.");
  }
}

EffectKind KindOf(FormulaPlace place) {
  using P = FormulaPlace;
  if (place == P::kReadingX || place == P::kReadingY) return EffectKind::kObservation;
  const bool guard = place == P::kLandingVelocityAlong || place == P::kLandingVelocityAcross ||
                     place == P::kTouchdownAngle || place == P::kRestitution;
  return guard ? EffectKind::kGuard : EffectKind::kForce;
}

// Where sensors' offsets act: after clock, delay and scale, before the camera's roll.
constexpr int kReadingOrder = 4;

void Complete(Kept& kept) {
  for (const FormulaParameter& p : kept.formula.source().parameters)
    kept.parameters.push_back({p.name, p.unit, p.null ? *p.null : *p.value, p.lower, p.upper,
                               TypicalOf(p), !p.null.has_value()});
  const PlaceInfo& place = InfoOf(kept.formula.place());
  kept.equation = std::string(place.symbol) + " + [" + kept.formula.source().formula + "]";
  EffectInfo& info = kept.effect.info;
  info.name = kept.formula.source().name;
  info.kind = KindOf(place.place);
  info.equation = kept.equation;
  info.sentence = kept.formula.source().sentence;
  info.for_legs = place.for_legs;
  info.for_ball = place.for_ball;
  info.dissipative = false;  // nobody has shown it
  info.order = info.kind == EffectKind::kObservation ? kReadingOrder : 0;
  info.sharp = kept.formula.sharp();
  info.parameters = kept.parameters;
  kept.effect.formula = &kept.formula;
}

}  // namespace

const Effect& FormulaEffect(const FormulaSource& source) {
  static std::mutex mutex;
  static std::list<Kept> all;
  const std::lock_guard lock(mutex);
  for (const Kept& kept : all)
    if (kept.formula.source() == source) return kept.effect;
  if (!IsName(source.name))
    throw FormulaError(FormulaError::Of::kSource,
                       "name = " + Printable(source.name) + " is no name of an effect",
                       "Use letters, digits and _, a letter first, at most 40 of them.");
  if (FindEffect(source.name))
    throw FormulaError(FormulaError::Of::kSource,
                       "name = " + source.name + " is an effect of the catalogue",
                       "Call it otherwise.");
  CheckParameters(source);
  all.emplace_back(source);
  try {
    Complete(all.back());
    CheckZeroAtNull(all.back());
  } catch (...) {
    all.pop_back();
    throw;
  }
  return all.back().effect;
}

const FormulaSource* SourceOf(const Effect& effect) {
  return effect.formula == nullptr ? nullptr : &effect.formula->source();
}

}  // namespace hoplab
