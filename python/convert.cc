#include "python/convert.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/read_dataset.h"
#include "datasets/trace.h"

namespace hoplab::python {
namespace {

// What `find` makes of a word, or an InputError that lists the words there are.
template <class Find>
auto Word(const py::dict& options, const char* name, const Find& find,
          const std::vector<std::string>& known) {
  const auto word = Option<std::string>(options, name);
  const auto found = find(word);
  if (!found)
    throw InputError(
        {name, Printable(word), "must be one of " + Join(known), DidYouMean(word, known)});
  return *found;
}

std::string CsvOf(const std::map<std::string, DoubleArray>& columns, const std::string& file) {
  Trace trace;
  for (const auto& [name, values] : columns) {
    if (name == "time_s")
      trace.time_s = VectorOf(values);
    else
      trace.columns.push_back({name, VectorOf(values)});
  }
  if (trace.time_s.empty())
    throw InputError({file, "trace", "has no time_s", "Give the times of its samples [s]."});
  for (const TraceColumn& column : trace.columns) {
    if (column.values.size() != trace.time_s.size()) {
      throw InputError({file,
                        column.name + " has " + std::to_string(column.values.size()) + " samples",
                        "must have as many as time_s, " + std::to_string(trace.time_s.size()), ""});
    }
  }
  return FormatTraceCsv(trace);
}

}  // namespace

void RefuseKind(const char* name, const py::object& value) {
  throw py::type_error(std::string(name) + " cannot be a " +
                       std::string(py::str(py::type::of(value).attr("__name__"))));
}

void RefuseRange(const char* name, const py::object& value, const std::string& least,
                 const std::string& most) {
  throw InputError({name, std::string(py::str(value)), "must be in " + least + " .. " + most, ""});
}

py::object PythonOf(const Json& json) {
  switch (json.type()) {
    case Json::value_t::object: {
      py::dict out;
      for (const auto& [key, value] : json.items()) out[py::str(key)] = PythonOf(value);
      return out;
    }
    case Json::value_t::array: {
      py::list out;
      for (const Json& value : json) out.append(PythonOf(value));
      return out;
    }
    case Json::value_t::string:
      return py::str(json.get_ref<const std::string&>());
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

py::array_t<double> ArrayOf(const std::vector<double>& values,
                            const std::vector<py::ssize_t>& shape) {
  py::array_t<double> out(shape);
  std::copy(values.begin(), values.end(), out.mutable_data());
  return out;
}

py::array_t<double> ArrayOf(const Eigen::VectorXd& values) {
  return ArrayOf(std::vector<double>(values.begin(), values.end()), {values.size()});
}

py::array_t<double> ArrayOf(const Eigen::MatrixXd& values) {
  py::array_t<double> out({values.rows(), values.cols()});
  auto cells = out.mutable_unchecked<2>();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) cells(i, j) = values(i, j);
  }
  return out;
}

std::vector<double> VectorOf(const DoubleArray& values) {
  if (values.ndim() != 1) throw py::value_error("an array of one dimension is needed");
  return {values.data(), values.data() + values.size()};
}

Dataset DatasetOf(const DatasetSource& source) {
  if (!source.folder.empty()) return ReadDataset(source.folder);
  std::map<std::string, std::string> texts;
  for (const auto& [file, columns] : source.traces) texts[file] = CsvOf(columns, file);
  return ReadDatasetText(source.text, texts, "dataset");
}

int JobsOf(const py::dict& options) {
  const int jobs = Option<int>(options, "jobs");
  if (jobs < 1)
    throw InputError({"jobs", std::to_string(jobs), "must be at least 1", "None is all cores."});
  return jobs;
}

IntegratorOptions IntegratorOf(const py::dict& options) {
  const auto tolerance = Option<double>(options, "tolerance");
  if (!(tolerance >= 1e-14 && tolerance <= 1e-3))
    throw InputError({"tolerance", FormatDouble(tolerance), "must be in [1e-14, 1e-3]", ""});
  return {Word(options, "integrator", FindIntegrator, {"dop853", "erkstep", "cvodes"}), tolerance,
          0.1 * tolerance};
}

ProblemOptions ProblemOptionsOf(const py::dict& options) {
  ProblemOptions out;
  out.law = Option<std::string>(options, "law");
  out.free = Option<std::vector<std::string>>(options, "free");
  out.fix = Option<std::map<std::string, double>>(options, "fix");
  out.with_effects = Option<std::vector<std::string>>(options, "with_");
  out.keep_stray = Option<bool>(options, "keep_stray");
  out.integrator = IntegratorOf(options);
  return out;
}

FitOptions FitOptionsOf(const py::dict& options) {
  FitOptions out;
  out.strategy =
      Word(options, "strategy", FindStrategy, {"apex_shooting", "growing_horizon", "raw"});
  out.restarts = Option<int>(options, "starts");
  if (out.restarts < 1)
    throw InputError({"starts", std::to_string(out.restarts), "must be at least 1", ""});
  out.seed = Option<std::uint64_t>(options, "seed");
  const auto find_loss = [](const std::string& word) -> std::optional<LossKind> {
    if (word == "squared") return LossKind::kSquared;
    if (word == "pseudo_huber") return LossKind::kPseudoHuber;
    return std::nullopt;
  };
  out.loss.kind = Word(options, "loss", find_loss, {"squared", "pseudo_huber"});
  out.loss.scale = Option<double>(options, "loss_scale");
  if (!(out.loss.scale > 0.0 && std::isfinite(out.loss.scale)))
    throw InputError(
        {"loss_scale", FormatDouble(out.loss.scale), "must be positive and finite", ""});
  out.discrepancy = Word(options, "discrepancy", FindDiscrepancy, {"matern", "none"});
  out.jobs = JobsOf(options);
  return out;
}

Segmentation SpanOf(const py::dict& options) {
  return Word(options, "span", FindSpan, {"whole_else_hops", "whole", "hops"});
}

}  // namespace hoplab::python
