#include <pybind11/stl.h>

#include "app/records/diagnosis_record.h"
#include "base/input_error.h"
#include "python/bindings.h"
#include "python/convert.h"
#include "python/long_work.h"

namespace hoplab::python {
namespace {

py::object DiagnosisOf(const DatasetSource& source, const py::dict& options) {
  const Dataset dataset = DatasetOf(source);
  DiagnosisOptions resolved;
  resolved.problem = ProblemOptionsOf(options);
  resolved.fit = FitOptionsOf(options);
  resolved.span = SpanOf(options);
  resolved.candidates = {Option<std::vector<std::string>>(options, "effects"),
                         Option<std::vector<std::string>>(options, "without")};
  resolved.max_effects = Option<int>(options, "max_effects");
  if (resolved.max_effects < 1 || resolved.max_effects > 10)
    throw InputError(
        {"max_effects", std::to_string(resolved.max_effects), "must be in 1 .. 10", ""});
  const DiagnosisRun run = RunInterruptibly([&](const std::atomic<bool>* stop) {
    DiagnosisOptions with_stop = resolved;
    with_stop.fit.stop = stop;
    return RunDiagnosis(dataset, with_stop);
  });
  return PythonOf(DiagnosisRecord(dataset, source.name(), resolved, run));
}

}  // namespace

void BindDiagnose(py::module_& m) { m.def("diagnose", &DiagnosisOf); }

}  // namespace hoplab::python
