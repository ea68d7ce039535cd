#include "app/runs/diagnosis_run.h"

namespace hoplab {

std::string DiagnosisRun::Failure() const {
  if (diagnosis.interrupted) return "interrupted before there was a verdict";
  return diagnosis.refusal;
}

bool DiagnosisRun::WantsFormula() const {
  const bool left = diagnosis.left.material && diagnosis.verdict != Verdict::kAdequate;
  return Failure().empty() && (diagnosis.CausesMayStandIn() || left);
}

DiagnosisRun RunDiagnosis(const Dataset& dataset, const DiagnosisOptions& options) {
  DiagnosisRun run;
  run.diagnosis = Diagnose(dataset, options);
  if (run.diagnosis.before.trials.empty()) return run;
  const auto& extension = run.diagnosis.extension;
  run.energy =
      LedgerOf(run.diagnosis.null, run.diagnosis.before, extension ? &extension->after : nullptr);
  return run;
}

}  // namespace hoplab
