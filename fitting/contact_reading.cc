#include "fitting/contact_reading.h"

#include <array>

#include "model/effects/active_effects.h"
#include "model/jet.h"

namespace hoplab {
namespace {

using Of = SensitivityDirection::Of;
using Rate = Jet<1>;

bool ShiftsTime(const EffectSetting& s) {
  return s.effect->hooks0.change_observation_time != nullptr;
}

}  // namespace

ContactReading::ContactReading(const FitProblem& problem, const TrialProblem& trial,
                               const EvaluationRequest& request)
    : clock_(problem.contact_clock) {
  const bool seen = !trial.contact.touchdown_s.empty() || !trial.contact.liftoff_s.empty();
  if (seen) FillTrialRequest(problem, trial, request.shared, request.own, trial_);
}

double ContactReading::Time(double stamp) const {
  if (clock_ >= 0) stamp += trial_.clock_offsets[static_cast<std::size_t>(clock_)];
  ActiveEffects<double> effects;
  for (const EffectSetting& s : trial_.effects)
    if (ShiftsTime(s)) effects.Add(*s.effect, s.values);
  return effects.ObservationTime(stamp);
}

double ContactReading::Slope(double stamp, const SensitivityDirection& by) const {
  const bool by_clock = by.of == Of::kClock && by.index == clock_;
  const bool by_effect =
      by.of == Of::kEffect && ShiftsTime(trial_.effects[static_cast<std::size_t>(by.index)]);
  if (!by_clock && !by_effect) return 0.0;
  Rate time = Seeded<Rate>(stamp, 0, by_clock ? 1.0 : 0.0);
  if (clock_ >= 0) time += trial_.clock_offsets[static_cast<std::size_t>(clock_)];
  ActiveEffects<Rate> effects;
  for (std::size_t i = 0; i < trial_.effects.size(); ++i) {
    const EffectSetting& s = trial_.effects[i];
    if (!ShiftsTime(s)) continue;
    std::array<Rate, kMaxEffectParameters> values;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool sought = by_effect && static_cast<std::size_t>(by.index) == i &&
                          static_cast<std::size_t>(by.component) == k;
      values[k] = Seeded<Rate>(s.values[k], 0, sought ? 1.0 : 0.0);
    }
    effects.Add(*s.effect, values);
  }
  return hoplab::Slope(effects.ObservationTime(time), 0);
}

}  // namespace hoplab
