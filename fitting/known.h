#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datasets/known_spec.h"
#include "datasets/mechanism_spec.h"
#include "model/effects/effect.h"
#include "model/parameters.h"

namespace hoplab {

/// `said` with what a mechanism rules out by itself, unless `said` speaks of it: nothing holds a
/// ball that is on no guide, so gravity may differ from what is stated only as it does on the
/// ground of the Earth.
std::vector<KnownSpec> WithFactsOf(const MechanismSpec& mechanism, std::vector<KnownSpec> said);

/// What is known of one parameter of an effect.
struct KnownParameter {
  const Effect* effect = nullptr;
  int parameter = 0;
  double at_most = 0.0;  // |value - null| is no larger, in the parameter's unit; 0: it is at null
  std::string place;     // where the dataset says so
};

/// A parameter of an effect that may be off its null, with the bounds that hold.
struct OpenParameter {
  int place = 0;  // among the effect's parameters
  EffectParameter info;
};

/// What a set-up rules out or bounds, held against the catalogue of effects. Empty: nothing known.
class KnownCauses {
 public:
  KnownCauses() = default;
  /// Throws InputError (place: where it was said) for an effect or parameter that does not exist,
  /// something said twice, or a size for a whole effect that has several parameters. `formulas` are
  /// known beside the catalogue. Forces, torques and masses of a size one would expect grow with
  /// the body: the mass in `stated` scales what is typical of them. A formula states its own. What
  /// adds to a stated value (EffectParameter::adds_to) may take nine tenths of it away.
  explicit KnownCauses(const std::vector<KnownSpec>& specs,
                       std::span<const Effect* const> formulas = {},
                       const Parameters<double>& stated = {});

  const std::vector<KnownParameter>& parameters() const { return parameters_; }
  /// The parameters of `effect` that may be off their null, with the bounds known of them put over
  /// their physical ones; in the order of the catalogue. One that only shapes it is not among them.
  std::vector<OpenParameter> OpenParameters(const Effect& effect) const;
  /// Every parameter is known to be null.
  bool RulesOut(const Effect& effect) const { return OpenParameters(effect).empty(); }
  /// Bounds and typical size of one parameter; absent: it is known to be null.
  std::optional<EffectParameter> Open(const Effect& effect, int parameter) const;
  /// Throws InputError, place `place` (an option), unless `value` is one that parameter may have.
  void CheckValue(const Effect& effect, int parameter, double value,
                  const std::string& place) const;
  /// Throws InputError, place `place` (an option), if the effect is ruled out.
  void CheckOpen(const Effect& effect, const std::string& place) const;
  /// "gravity_scale none, camera_roll.angle at most 0.002 rad"; empty if nothing is known.
  std::string Text() const;

 private:
  const KnownParameter* Find(const Effect& effect, int parameter) const;
  void Add(const Effect& effect, int parameter, const KnownSpec& spec);

  std::vector<KnownParameter> parameters_;
  Parameters<double> stated_;
};

}  // namespace hoplab
