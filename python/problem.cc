#include <pybind11/stl.h>

#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"
#include "fitting/objective.h"
#include "python/bindings.h"
#include "python/convert.h"

namespace hoplab::python {
namespace {

/// The train trials of a dataset as a least-squares problem.
struct TrainProblem {
  FitProblem problem;
  std::vector<TrialProblem> trials;
  int jobs;
};

TrainProblem MakeTrainProblem(const DatasetSource& source, const py::dict& options) {
  TrainProblem out;
  out.problem = MakeProblem(DatasetOf(source), ProblemOptionsOf(options));
  out.trials = TrialsOf(out.problem, TrialRole::kTrain);
  out.jobs = JobsOf(options);
  for (const TrialProblem& trial : out.trials)
    if (trial.start.size() != 4)
      throw InputError({trial.file, std::to_string(trial.start.size()) + " values of its own",
                        "must be 4, those of the start", "leave angles free hop by hop to fit()"});
  return out;
}

// One row a trial: x, y, vx, vy.
py::array_t<double> InitialStatesOf(const TrainProblem& p) {
  std::vector<double> out;
  for (const TrialProblem& trial : p.trials)
    out.insert(out.end(), trial.start.begin(), trial.start.end());
  return ArrayOf(out, {static_cast<py::ssize_t>(p.trials.size()), 4});
}

std::vector<std::string> FilesOf(const TrainProblem& p) {
  std::vector<std::string> files;
  for (const TrialProblem& trial : p.trials) files.push_back(trial.file);
  return files;
}

py::list ParametersOfProblem(const TrainProblem& p) {
  const Eigen::VectorXd initial = InitialShared(p.problem);
  py::list out;
  for (int i = 0; i < p.problem.shared_count(); ++i) {
    const SharedParameter& s = p.problem.shared[i];
    out.append(py::make_tuple(s.name, s.unit, initial[i], s.lower, s.upper, s.scale));
  }
  return out;
}

Eigen::VectorXd CheckedValues(const TrainProblem& p, const DoubleArray& values) {
  const std::vector<double> given = VectorOf(values);
  const int count = p.problem.shared_count();
  if (static_cast<int>(given.size()) != count)
    throw InputError({"values", std::to_string(given.size()) + " numbers",
                      "must be " + std::to_string(count) + ", one a parameter", ""});
  for (int i = 0; i < count; ++i) {
    const SharedParameter& s = p.problem.shared[i];
    const Range range = {s.lower, s.upper, false, false, s.unit.c_str()};
    if (!range.Contains(given[i]))
      throw InputError({"values", s.name + " = " + FormatDouble(given[i]),
                        "must be in " + range.Text(), RangeRemedy(given[i], range)});
  }
  return Eigen::Map<const Eigen::VectorXd>(given.data(), count);
}

std::vector<OwnValues> CheckedInitialStates(const TrainProblem& p,
                                            const DoubleArray& initial_states) {
  const auto trials = static_cast<py::ssize_t>(p.trials.size());
  if (initial_states.ndim() != 2 || initial_states.shape(0) != trials ||
      initial_states.shape(1) != 4)
    throw InputError({"starts", "an array of another shape",
                      "must be of shape (" + std::to_string(trials) + ", 4)", ""});
  std::vector<OwnValues> rows;
  for (std::size_t i = 0; i < p.trials.size(); ++i)
    rows.push_back(Eigen::Map<const Eigen::Vector4d>(initial_states.data() + 4 * i));
  return rows;
}

py::dict Evaluate(const TrainProblem& p, const DoubleArray& values,
                  const DoubleArray& initial_states) {
  const Eigen::VectorXd shared = CheckedValues(p, values);
  const std::vector<OwnValues> rows = CheckedInitialStates(p, initial_states);
  const Objective o = [&] {
    const py::gil_scoped_release unlocked;
    return EvaluateObjective(p.problem, p.trials, shared, rows, {}, p.jobs);
  }();
  std::vector<std::string> outcomes;
  for (const Outcome outcome : o.outcomes) outcomes.emplace_back(NameOf(outcome));
  py::dict out;
  out["complete"] = o.complete;
  out["cost"] = o.cost;
  out["outcomes"] = outcomes;
  for (const char* name : {"residuals", "jacobian", "gradient"}) out[name] = py::none();
  if (o.complete) {
    out["residuals"] = ArrayOf(o.residuals);
    out["jacobian"] = ArrayOf(o.jacobian);
    out["gradient"] = ArrayOf(o.gradient);
  }
  return out;
}

}  // namespace

void BindProblem(py::module_& m) {
  py::class_<TrainProblem>(m, "TrainProblem")
      .def(py::init(&MakeTrainProblem))
      .def_property_readonly("parameters", &ParametersOfProblem)
      .def_property_readonly("starts", &InitialStatesOf)
      .def_property_readonly("files", &FilesOf)
      .def("evaluate", &Evaluate);
}

}  // namespace hoplab::python
