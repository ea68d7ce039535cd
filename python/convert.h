#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "app/records/run_record.h"
#include "datasets/dataset.h"
#include "fitting/fit_dataset.h"

namespace hoplab::python {

namespace py = pybind11;

/// Arrays of doubles of one dimension, whatever sequence of numbers they were.
using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A record as dict, list, float, int, str, bool and None.
py::object PythonOf(const Json& json);

/// A copy of `values` in C order; their number is the product of `shape`.
py::array_t<double> ArrayOf(const std::vector<double>& values,
                            const std::vector<py::ssize_t>& shape);
py::array_t<double> ArrayOf(const Eigen::VectorXd& values);
py::array_t<double> ArrayOf(const Eigen::MatrixXd& values);
std::vector<double> VectorOf(const DoubleArray& values);

/// A dataset as the Python side hands it over: a folder, or the text of a dataset.yaml (JSON, which
/// is YAML) with the columns of each trial's trace by the trial's file.
struct DatasetSource {
  std::string folder;
  std::string text;
  std::map<std::string, std::map<std::string, DoubleArray>> traces;
  std::string name() const { return folder.empty() ? "in memory" : folder; }
};

/// Reads and checks it; throws InputError as ReadDataset does.
Dataset DatasetOf(const DatasetSource& source);

/// Throws TypeError that the option is of a kind it cannot be.
[[noreturn]] void RefuseKind(const char* name, const py::object& value);
/// Throws InputError that the option, a whole number, is not in `least` .. `most`.
[[noreturn]] void RefuseRange(const char* name, const py::object& value, const std::string& least,
                              const std::string& most);

/// The named option as T; the Python side gives every one of them. Throws InputError for a whole
/// number out of T's range, TypeError for what is no T.
template <class T>
T Option(const py::dict& options, const char* name) {
  const py::object value = options[name];
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    if constexpr (std::is_integral_v<T>) {
      if (py::isinstance<py::int_>(value))
        RefuseRange(name, value, std::to_string(std::numeric_limits<T>::min()),
                    std::to_string(std::numeric_limits<T>::max()));
    }
    RefuseKind(name, value);
  }
}

/// Option jobs, at least 1.
int JobsOf(const py::dict& options);
IntegratorOptions IntegratorOf(const py::dict& options);
/// Options law, free, fix, with_, integrator and tolerance.
ProblemOptions ProblemOptionsOf(const py::dict& options);
/// Options strategy, starts, seed, loss, loss_scale and jobs.
FitOptions FitOptionsOf(const py::dict& options);
Segmentation SpanOf(const py::dict& options);

}  // namespace hoplab::python
