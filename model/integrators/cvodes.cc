#include "model/integrators/cvodes.h"

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>
#include <sundials/sundials_context.hpp>
#include <vector>

#include "base/check.h"

namespace hoplab {

struct CvodesSolver::Memory {
  sundials::Context context;
  FlatSystem system;
  IntegratorOptions options;
  int sensitivities;
  N_Vector y = nullptr;
  N_Vector* s = nullptr;  // sensitivity vectors, one per direction
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* solver = nullptr;
  mutable std::vector<double> flat, flat_rate;

  Memory(const IntegratorOptions& o, const FlatSystem& f)
      : system(f),
        options(o),
        sensitivities(f.size / f.controlled - 1),
        flat(f.size),
        flat_rate(f.size) {}
  ~Memory() {
    if (solver) CVodeFree(&solver);
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    if (s) N_VDestroyVectorArray(s, sensitivities);
    if (y) N_VDestroy(y);
  }

  int n() const { return system.controlled; }
  // [state | sensitivities, component by component] to and from CVODES' vectors.
  void Scatter(const double* from) {
    std::copy(from, from + n(), N_VGetArrayPointer(y));
    for (int i = 0; i < n(); ++i) {
      for (int k = 0; k < sensitivities; ++k)
        N_VGetArrayPointer(s[k])[i] = from[n() + i * sensitivities + k];
    }
  }
  void Gather(double* to) const {
    std::copy(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + n(), to);
    for (int i = 0; i < n(); ++i) {
      for (int k = 0; k < sensitivities; ++k)
        to[n() + i * sensitivities + k] = N_VGetArrayPointer(s[k])[i];
    }
  }

  static int Derivative(double t, N_Vector y, N_Vector dy, void* user) {
    const auto* self = static_cast<const Memory*>(user);
    std::fill(self->flat.begin(), self->flat.end(), 0.0);
    std::copy(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + self->n(), self->flat.begin());
    self->system.derivative(self->system.context, t, self->flat.data(), self->flat_rate.data());
    std::copy(self->flat_rate.begin(), self->flat_rate.begin() + self->n(), N_VGetArrayPointer(dy));
    for (int i = 0; i < self->n(); ++i) {
      if (!std::isfinite(self->flat_rate[i])) return 1;
    }
    return 0;
  }
  static int SensitivityDerivative(int count, double t, N_Vector y, N_Vector, N_Vector* s,
                                   N_Vector* ds, void* user, N_Vector, N_Vector) {
    const auto* self = static_cast<const Memory*>(user);
    const int n = self->n();
    std::copy(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + n, self->flat.begin());
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < count; ++k) self->flat[n + i * count + k] = N_VGetArrayPointer(s[k])[i];
    }
    self->system.derivative(self->system.context, t, self->flat.data(), self->flat_rate.data());
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < count; ++k)
        N_VGetArrayPointer(ds[k])[i] = self->flat_rate[n + i * count + k];
    }
    return std::isfinite(self->flat_rate[n - 1]) ? 0 : 1;
  }
};

CvodesSolver::CvodesSolver(const IntegratorOptions& options, const FlatSystem& system)
    : memory_(std::make_unique<Memory>(options, system)) {
  Memory& m = *memory_;
  m.y = N_VNew_Serial(m.n(), m.context);
  N_VConst(0.0, m.y);
  if (m.sensitivities > 0) m.s = N_VCloneVectorArray(m.sensitivities, m.y);
  m.matrix = SUNDenseMatrix(m.n(), m.n(), m.context);
  m.linear = SUNLinSol_Dense(m.y, m.matrix, m.context);
  HOPLAB_CHECK(m.matrix != nullptr && m.linear != nullptr);
}
CvodesSolver::~CvodesSolver() = default;

void CvodesSolver::Start(double t, const double* y, double first_step) {
  Memory& m = *memory_;
  m.Scatter(y);
  if (m.solver == nullptr) {
    m.solver = CVodeCreate(CV_BDF, m.context);
    HOPLAB_CHECK(m.solver != nullptr);
    HOPLAB_CHECK(CVodeInit(m.solver, &Memory::Derivative, t, m.y) == CV_SUCCESS);
    HOPLAB_CHECK(CVodeSetUserData(m.solver, &m) == CV_SUCCESS);
    const N_Vector absolute = N_VClone(m.y);
    for (int i = 0; i < m.n(); ++i)
      N_VGetArrayPointer(absolute)[i] = m.options.absolute_tolerance * m.system.units[i];
    HOPLAB_CHECK(CVodeSVtolerances(m.solver, m.options.relative_tolerance, absolute) == CV_SUCCESS);
    N_VDestroy(absolute);
    HOPLAB_CHECK(CVodeSetMaxNumSteps(m.solver, 1000000) == CV_SUCCESS);
    HOPLAB_CHECK(CVodeSetErrHandlerFn(
                     m.solver, [](int, const char*, const char*, char*, void*) {}, nullptr) ==
                 CV_SUCCESS);
    HOPLAB_CHECK(CVodeSetLinearSolver(m.solver, m.linear, m.matrix) == CV_SUCCESS);
    if (m.sensitivities > 0) {
      HOPLAB_CHECK(CVodeSensInit(m.solver, m.sensitivities, CV_SIMULTANEOUS,
                                 &Memory::SensitivityDerivative, m.s) == CV_SUCCESS);
      std::vector<double> absolute(m.sensitivities, m.options.absolute_tolerance);
      HOPLAB_CHECK(CVodeSensSStolerances(m.solver, m.options.relative_tolerance, absolute.data()) ==
                   CV_SUCCESS);
      HOPLAB_CHECK(CVodeSetSensErrCon(m.solver, SUNTRUE) == CV_SUCCESS);
    }
  } else {
    HOPLAB_CHECK(CVodeReInit(m.solver, t, m.y) == CV_SUCCESS);
    if (m.sensitivities > 0)
      HOPLAB_CHECK(CVodeSensReInit(m.solver, CV_SIMULTANEOUS, m.s) == CV_SUCCESS);
  }
  // A first-order start needs a far smaller step than the one-step methods begin with.
  HOPLAB_CHECK(CVodeSetInitStep(m.solver, std::copysign(std::min(std::abs(first_step), 1e-6),
                                                        first_step)) == CV_SUCCESS);
}

StepStatus CvodesSolver::Step(double t_limit, double* t, double* y) {
  Memory& m = *memory_;
  HOPLAB_CHECK(CVodeSetStopTime(m.solver, t_limit) == CV_SUCCESS);
  const int flag = CVode(m.solver, t_limit, m.y, t, CV_ONE_STEP);
  if (flag < 0) return StepStatus::kFailed;
  if (m.sensitivities > 0) {
    double at = *t;
    if (CVodeGetSens(m.solver, &at, m.s) < 0) return StepStatus::kFailed;
  }
  m.Gather(y);
  return StepStatus::kOk;
}

StepStatus CvodesSolver::At(double t, double* y) {
  Memory& m = *memory_;
  if (CVodeGetDky(m.solver, t, 0, m.y) < 0) return StepStatus::kFailed;
  if (m.sensitivities > 0 && CVodeGetSensDky(m.solver, t, 0, m.s) < 0) return StepStatus::kFailed;
  m.Gather(y);
  return StepStatus::kOk;
}

}  // namespace hoplab
