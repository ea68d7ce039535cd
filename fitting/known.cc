#include "fitting/known.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

const EffectParameter& ParameterOf(const KnownParameter& known) {
  return known.effect->info.parameters[static_cast<std::size_t>(known.parameter)];
}

std::string WholeName(const Effect& effect, int parameter) {
  return std::string(effect.info.name) + "." +
         std::string(effect.info.parameters[static_cast<std::size_t>(parameter)].name);
}

std::vector<std::string> ParameterNames(const Effect& effect) {
  std::vector<std::string> names;
  for (const EffectParameter& p : effect.info.parameters) names.emplace_back(p.name);
  return names;
}

int ParameterNamed(const Effect& effect, const KnownSpec& spec) {
  if (const std::optional<int> found = effect.FindParameter(spec.parameter)) return *found;
  throw InputError({spec.origin.place, "known." + spec.effect + "." + Printable(spec.parameter),
                    "is not a parameter of this effect",
                    DidYouMean(spec.parameter, ParameterNames(effect))});
}

// The power of a mass in a unit of the catalogue: 1 of "N s/m" and "kg", -1 of "m/(N s)", 0 of
// "rad".
int MassPower(std::string_view unit) {
  const std::size_t place = std::min(unit.find('N'), unit.find("kg"));
  if (place == std::string_view::npos) return 0;
  return unit.find('/') < place ? -1 : 1;
}

constexpr double kTenths = 9.0;  // that may be taken of a stated value that an effect adds to

// Gravity at sea level goes from 9.780 to 9.832 m/s^2, on high ground down to 9.764: within half a
// per cent of 9.81.
constexpr double kGravityDiffers = 0.005;
constexpr const char* kNothingHolds =
    "the mechanism, since nothing holds a ball (`known: {gravity_scale: {at_most: 0.2}}` in "
    "dataset.yaml allows more)";

}  // namespace

std::vector<KnownSpec> WithFactsOf(const MechanismSpec& mechanism, std::vector<KnownSpec> said) {
  const std::string gravity = "gravity_scale";
  const bool is_told = std::any_of(said.begin(), said.end(),
                                   [&](const KnownSpec& s) { return s.effect == gravity; });
  const bool is_free = mechanism.type == MechanismKind::kBall && !mechanism.on_guide;
  if (is_free && !is_told) said.push_back({gravity, "", kGravityDiffers, {.place = kNothingHolds}});
  return said;
}

KnownCauses::KnownCauses(const std::vector<KnownSpec>& specs,
                         std::span<const Effect* const> formulas, const Parameters<double>& stated)
    : stated_(stated) {
  for (const KnownSpec& spec : specs) {
    const Effect& effect = ResolveEffect(spec.effect, spec.origin.place, formulas);
    const auto count = static_cast<int>(effect.info.parameters.size());
    if (!spec.parameter.empty()) {
      Add(effect, ParameterNamed(effect, spec), spec);
      continue;
    }
    if (spec.at_most && count > 1)
      throw InputError({spec.origin.place, "known." + spec.effect + ".at_most",
                        "the effect has " + std::to_string(count) +
                            " parameters: " + Join(ParameterNames(effect)),
                        "Say of which, as " + spec.effect + ": {" + ParameterNames(effect)[0] +
                            ": {at_most: " + FormatDouble(*spec.at_most) + "}}."});
    for (int i = 0; i < count; ++i) Add(effect, i, spec);
  }
}

void KnownCauses::Add(const Effect& effect, int parameter, const KnownSpec& spec) {
  const std::string name = "known." + WholeName(effect, parameter);
  if (const KnownParameter* before = Find(effect, parameter))
    throw InputError(
        {spec.origin.place, name, "is said already at " + before->place, "Remove one of the two."});
  const EffectParameter& p = effect.info.parameters[static_cast<std::size_t>(parameter)];
  const double reach = std::max(p.upper - p.null, p.null - p.lower);
  if (spec.at_most && *spec.at_most > reach)
    throw InputError({spec.origin.place, name + ".at_most = " + FormatDouble(*spec.at_most),
                      "says nothing: the parameter is in [" + FormatDouble(p.lower) + ", " +
                          FormatDouble(p.upper) + "] " + std::string(p.unit) + " anyway",
                      "Give it in " + (p.unit == "-" ? "parts of one" : std::string(p.unit)) +
                          ", or remove the line."});
  parameters_.push_back({&effect, parameter, spec.at_most.value_or(0.0), spec.origin.place});
}

const KnownParameter* KnownCauses::Find(const Effect& effect, int parameter) const {
  for (const KnownParameter& known : parameters_)
    if (known.effect == &effect && known.parameter == parameter) return &known;
  return nullptr;
}

std::optional<EffectParameter> KnownCauses::Open(const Effect& effect, int parameter) const {
  EffectParameter p = effect.info.parameters[static_cast<std::size_t>(parameter)];
  if (effect.formula == nullptr) p.typical *= std::pow(stated_.m, MassPower(p.unit));
  if (p.adds_to && stated_.robot) {
    p.lower -= Field(stated_, *p.adds_to) * kTenths / 10.0;
    // A file states 2 r at most, of an arc of pi r.
    if (p.adds_to == ParameterId::kClamp) p.upper = std::min(p.upper, 0.5 * stated_.r);
  }
  const KnownParameter* known = Find(effect, parameter);
  if (known == nullptr) return p;
  if (known->at_most == 0.0) return std::nullopt;
  p.lower = std::max(p.lower, p.null - known->at_most);
  p.upper = std::min(p.upper, p.null + known->at_most);
  p.typical = std::clamp(p.typical, -known->at_most, known->at_most);
  return p;
}

std::vector<OpenParameter> KnownCauses::OpenParameters(const Effect& effect) const {
  std::vector<OpenParameter> open;
  for (int i = 0; i < static_cast<int>(effect.info.parameters.size()); ++i) {
    const std::optional<EffectParameter> p = Open(effect, i);
    if (p && !p->is_shape) open.push_back({i, *p});
  }
  return open;
}

void KnownCauses::CheckValue(const Effect& effect, int parameter, double value,
                             const std::string& place) const {
  const KnownParameter* known = Find(effect, parameter);
  if (known == nullptr) return;
  const EffectParameter& p = ParameterOf(*known);
  const std::optional<EffectParameter> open = Open(effect, parameter);
  if (open ? value >= open->lower && value <= open->upper : value == p.null) return;
  throw InputError({place, WholeName(effect, parameter) + " = " + FormatDouble(value),
                    open ? "is known to be in [" + FormatDouble(open->lower) + ", " +
                               FormatDouble(open->upper) + "] " + std::string(p.unit) + ", by " +
                               known->place
                         : "is known to be " + FormatDouble(p.null) + ", by " + known->place,
                    "Change what is known there if it is not so."});
}

void KnownCauses::CheckOpen(const Effect& effect, const std::string& place) const {
  if (!RulesOut(effect)) return;
  const std::string name(effect.info.name);
  throw InputError({place, "effect " + name,
                    "is ruled out by " + Find(effect, 0)->place + " (known: " + name + ": none)",
                    "Remove the line there if the effect may be present after all."});
}

std::string KnownCauses::Text() const {
  std::vector<std::string> words;
  for (const KnownParameter& known : parameters_) {
    const bool whole = RulesOut(*known.effect);
    if (whole && known.parameter > 0) continue;
    const std::string name =
        whole ? std::string(known.effect->info.name) : WholeName(*known.effect, known.parameter);
    const std::string unit(ParameterOf(known).unit);
    words.push_back(known.at_most == 0.0 ? name + " none"
                                         : name + " at most " + FormatDouble(known.at_most) +
                                               (unit == "-" ? "" : " " + unit));
  }
  return Join(words);
}

}  // namespace hoplab
