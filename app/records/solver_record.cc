#include "app/records/solver_record.h"

namespace hoplab {

void RecordSolver(const SolverSettings& settings, Json& options) {
  const IntegratorOptions resolved = IntegratorOptionsOf(settings);
  options["integrator"] = settings.integrator;
  options["relative_tolerance"] = resolved.relative_tolerance;
  options["absolute_tolerance"] = resolved.absolute_tolerance;
}

}  // namespace hoplab
