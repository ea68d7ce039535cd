#include "model/integrators/erkstep.h"

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <sundials/sundials_context.hpp>

#include "base/check.h"

namespace hoplab {

struct ErkStepSolver::Memory {
  sundials::Context context;
  FlatSystem system;
  IntegratorOptions options;
  N_Vector y = nullptr;
  void* solver = nullptr;
  bool backward = false;

  Memory(const IntegratorOptions& o, const FlatSystem& s) : system(s), options(o) {}
  ~Memory() {
    if (solver) ERKStepFree(&solver);
    if (y) N_VDestroy(y);
  }

  static int Derivative(double t, N_Vector y, N_Vector dy, void* user) {
    const auto* self = static_cast<const Memory*>(user);
    double* out = N_VGetArrayPointer(dy);
    self->system.derivative(self->system.context, t, N_VGetArrayPointer(y), out);
    const bool finite = std::all_of(out, out + self->system.controlled,
                                    [](double rate) { return std::isfinite(rate); });
    return finite ? 0 : 1;  // 1: try a smaller step
  }
  // Error weights, as a rule of the state alone, sensitivities following its steps; the mean in the
  // norm runs over the whole vector, hence the factor.
  static int Weights(N_Vector y, N_Vector weights, void* user) {
    const auto* self = static_cast<const Memory*>(user);
    double* w = N_VGetArrayPointer(weights);
    const double* value = N_VGetArrayPointer(y);
    const int states = self->system.controlled, width = self->system.size / states - 1;
    const auto steers = [&](int i) {
      return i < states || (self->options.steering >> ((i - states) % width) & 1u) != 0;
    };
    // Of a direction, the largest sensitivity is what its errors are held against.
    const auto size_of = [&](int i) {
      if (i < states) return std::abs(value[i]);
      double size = 1e-6;
      for (int j = states + (i - states) % width; j < self->system.size; j += width)
        size = std::max(size, std::abs(value[j]));
      return size;
    };
    int controlled = 0;
    for (int i = 0; i < self->system.size; ++i) controlled += steers(i);
    const double factor = std::sqrt(static_cast<double>(self->system.size) / controlled);
    for (int i = 0; i < self->system.size; ++i) {
      const double unit = i < states ? self->system.units[i] : 1.0;
      w[i] = steers(i) ? factor / (self->options.absolute_tolerance * unit +
                                   self->options.relative_tolerance * size_of(i))
                       : 1e-300;
    }
    return 0;
  }
};

ErkStepSolver::ErkStepSolver(const IntegratorOptions& options, const FlatSystem& system)
    : memory_(std::make_unique<Memory>(options, system)) {
  memory_->y = N_VNew_Serial(system.size, memory_->context);
  N_VConst(0.0, memory_->y);
  HOPLAB_CHECK(memory_->y != nullptr);
}
ErkStepSolver::~ErkStepSolver() = default;

void ErkStepSolver::Start(double t, const double* y, double first_step) {
  Memory& m = *memory_;
  std::copy(y, y + m.system.size, N_VGetArrayPointer(m.y));
  // ERKStepReInit keeps the direction of the last step: a stopping time on the other side is
  // refused.
  if (m.solver && m.backward != (first_step < 0.0)) ERKStepFree(&m.solver);
  m.backward = first_step < 0.0;
  if (m.solver == nullptr) {
    m.solver = ERKStepCreate(&Memory::Derivative, t, m.y, m.context);
    HOPLAB_CHECK(m.solver != nullptr);
    HOPLAB_CHECK(ERKStepSetUserData(m.solver, &m) == ARK_SUCCESS);
    HOPLAB_CHECK(ERKStepSetTableNum(m.solver, ARKODE_FEHLBERG_13_7_8) == ARK_SUCCESS);
    HOPLAB_CHECK(ERKStepWFtolerances(m.solver, &Memory::Weights) == ARK_SUCCESS);
    HOPLAB_CHECK(ERKStepSetMaxNumSteps(m.solver, 1000000) == ARK_SUCCESS);
    // A sharp effect turns over within one step, which then has to shrink far; 7 by default.
    HOPLAB_CHECK(ERKStepSetMaxErrTestFails(m.solver, 50) == ARK_SUCCESS);
    HOPLAB_CHECK(ERKStepSetErrHandlerFn(
                     m.solver, [](int, const char*, const char*, char*, void*) {}, nullptr) ==
                 ARK_SUCCESS);
  } else {
    HOPLAB_CHECK(ERKStepReInit(m.solver, &Memory::Derivative, t, m.y) == ARK_SUCCESS);
  }
  HOPLAB_CHECK(ERKStepSetInitStep(m.solver, first_step) == ARK_SUCCESS);
}

StepStatus ErkStepSolver::Step(double t_limit, double* t, double* y) {
  Memory& m = *memory_;
  HOPLAB_CHECK(ERKStepSetStopTime(m.solver, t_limit) == ARK_SUCCESS);
  const int flag = ERKStepEvolve(m.solver, t_limit, m.y, t, ARK_ONE_STEP);
  std::copy(N_VGetArrayPointer(m.y), N_VGetArrayPointer(m.y) + m.system.size, y);
  return flag < 0 ? StepStatus::kFailed : StepStatus::kOk;
}

StepStatus ErkStepSolver::EndAt(double t0, const double* y0, double t, double* y) {
  Memory& m = *memory_;
  Start(t0, y0, t - t0);
  HOPLAB_CHECK(ERKStepSetStopTime(m.solver, t) == ARK_SUCCESS);
  double reached = t0;
  const int flag = ERKStepEvolve(m.solver, t, m.y, &reached, ARK_NORMAL);
  std::copy(N_VGetArrayPointer(m.y), N_VGetArrayPointer(m.y) + m.system.size, y);
  return flag < 0 ? StepStatus::kFailed : StepStatus::kOk;
}

void ErkStepSolver::At(double t, double* y) {
  Memory& m = *memory_;
  HOPLAB_CHECK(ERKStepGetDky(m.solver, t, 0, m.y) == ARK_SUCCESS);
  std::copy(N_VGetArrayPointer(m.y), N_VGetArrayPointer(m.y) + m.system.size, y);
}

}  // namespace hoplab
