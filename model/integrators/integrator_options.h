#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace hoplab {

/// Solver of the continuous modes. All three stand behind one stepper interface (stepper.h).
enum class IntegratorKind {
  kDop853,   // explicit, order 8, our own: the default (docs/decisions/0001-integrator.md)
  kErkStep,  // explicit, SUNDIALS ARKODE: the oracle of the default, and what `generate` uses
  kCvodes    // stiff, SUNDIALS CVODES BDF with its own forward sensitivities
};
std::string_view NameOf(IntegratorKind kind);
std::optional<IntegratorKind> FindIntegrator(std::string_view name);

/// Tolerances of one step: |error| <= absolute unit + relative |state| per component, root mean
/// square over the state; the unit is 1 (m, rad, m/s, rad/s) but where a mechanism says otherwise
/// (HybridSystem::ErrorUnit). Sensitivities follow the steps of the state, but for those of the
/// steering directions (all of them under cvodes): each relative to the largest of its direction.
struct IntegratorOptions {
  IntegratorKind kind = IntegratorKind::kDop853;
  double relative_tolerance = 1e-9;
  double absolute_tolerance = 1e-10;
  /// Bit k: the k-th direction that is integrated steers the steps, too.
  std::uint32_t steering = 0;
  /// Steps after which a run ends as `step_limit`.
  long max_steps = 1000000;
};

/// What a step did.
enum class StepStatus {
  kOk,
  kFailed  // no step small enough meets the tolerance, or the right-hand side is not finite
};

}  // namespace hoplab
