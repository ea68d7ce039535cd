#include <pybind11/stl.h>

#include "app/records/fit_record.h"
#include "python/bindings.h"
#include "python/convert.h"
#include "python/long_work.h"

namespace hoplab::python {
namespace {

// Rows of one channel out of a row-major [row][channel] table.
py::array_t<double> Column(const std::vector<double>& table, std::size_t channel,
                           std::size_t channels) {
  std::vector<double> out;
  for (std::size_t at = channel; at < table.size(); at += channels) out.push_back(table[at]);
  const auto rows = static_cast<py::ssize_t>(out.size());
  return ArrayOf(out, {rows});
}

py::dict TraceOf(const FitProblem& problem, const TrialProblem& trial, const TrialErrors& errors) {
  py::dict measured, simulated;
  const std::size_t channels = problem.channels.size();
  for (std::size_t c = 0; c < channels; ++c) {
    const py::str name(std::string(NameOf(problem.channels[c].channel)));
    measured[name] = Column(trial.data, c, channels);
    simulated[name] = Column(errors.trajectory.samples, c, channels);
  }
  std::vector<double> times = trial.row_times;
  for (double& t : times) t += trial.begin_s;
  py::dict out;
  out["file"] = trial.file;
  out["time_s"] = ArrayOf(times, {static_cast<py::ssize_t>(times.size())});
  out["measured"] = measured;
  out["simulated"] = simulated;
  return out;
}

py::dict FitOf(const DatasetSource& source, const py::dict& options) {
  const Dataset dataset = DatasetOf(source);
  FitRunOptions run_options;
  run_options.problem = ProblemOptionsOf(options);
  run_options.fit = FitOptionsOf(options);
  run_options.span = SpanOf(options);
  run_options.profile = Option<std::vector<std::string>>(options, "profile");
  const FitRun run = RunInterruptibly([&](const std::atomic<bool>* stop) {
    FitRunOptions with_stop = run_options;
    with_stop.fit.stop = stop;
    return RunFit(dataset, with_stop);
  });
  py::dict out;
  out["record"] = PythonOf(FitRecord(dataset, source.name(), run_options, run));
  for (const char* matrix : {"covariance", "correlation"}) out[matrix] = py::none();
  if (run.uncertainty) {
    out["covariance"] = ArrayOf(run.uncertainty->covariance);
    out["correlation"] = ArrayOf(run.uncertainty->correlation);
  }
  py::list traces;
  for (std::size_t i = 0; i < run.trials.size(); ++i)
    traces.append(TraceOf(run.problem, run.problem.trials[i], run.trials[i]));
  out["traces"] = traces;
  return out;
}

}  // namespace

void BindFit(py::module_& m) { m.def("fit", &FitOf); }

}  // namespace hoplab::python
