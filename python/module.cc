#include <pybind11/stl.h>

#include <exception>
#include <utility>

#include "app/version.h"
#include "base/input_error.h"
#include "base/processor.h"
#include "python/bindings.h"
#include "python/convert.h"

namespace hoplab::python {
namespace {

// The exception's type; kept for the life of the process, as the interpreter keeps its own.
PyObject* input_error = nullptr;

// A place that names a command-line option names the argument here: "--with" is `with_`.
std::string ArgumentOf(const std::string& place) {
  if (!place.starts_with("--")) return place;
  return place == "--with" ? "with_" : place.substr(2);
}

void SetInputError(const InputError& error) {
  InputError::Parts parts = error.parts();
  parts.place = ArgumentOf(parts.place);
  py::object raised = py::reinterpret_borrow<py::object>(input_error)(InputError(parts).what());
  raised.attr("place") = parts.place;
  raised.attr("value") = parts.value;
  raised.attr("rule") = parts.rule;
  raised.attr("remedy") = parts.remedy;
  PyErr_SetObject(input_error, raised.ptr());
}

}  // namespace

void BindErrors(py::module_& m) {
  input_error = PyErr_NewExceptionWithDoc("hoplab.InputError",
                                          "Bad input, told so that it can be mended.\n\n"
                                          "Attributes\n----------\n"
                                          "place : str\n    File and line, or the argument.\n"
                                          "value : str\n    What stands there; may be empty.\n"
                                          "rule : str\n    The rule it breaks.\n"
                                          "remedy : str\n    What to do; may be empty.\n",
                                          PyExc_ValueError, nullptr);
  m.attr("InputError") = py::reinterpret_borrow<py::object>(input_error);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const InputError& error) {
      SetInputError(error);
    }
  });
}

void BindDataset(py::module_& m) {
  py::class_<DatasetSource>(m, "DatasetSource")
      .def(py::init<std::string, std::string,
                    std::map<std::string, std::map<std::string, DoubleArray>>>());
}

}  // namespace hoplab::python

PYBIND11_MODULE(_core, m) {
  if (const char* missing = hoplab::MissingOfProcessor())
    throw pybind11::import_error(std::string("hoplab was built for processors with ") + missing +
                                 ", and this one has none");
  m.attr("__version__") = hoplab::ProjectVersion();
  hoplab::python::BindErrors(m);
  hoplab::python::BindDataset(m);
  hoplab::python::BindSimulate(m);
  hoplab::python::BindFit(m);
  hoplab::python::BindDiagnose(m);
  hoplab::python::BindProblem(m);
}
