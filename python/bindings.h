#pragma once

#include <pybind11/pybind11.h>

namespace hoplab::python {

// What python/hoplab/*.py calls; the documentation for users stands there.
void BindErrors(pybind11::module_& m);
void BindDataset(pybind11::module_& m);
void BindSimulate(pybind11::module_& m);
void BindFit(pybind11::module_& m);
void BindDiagnose(pybind11::module_& m);
void BindProblem(pybind11::module_& m);

}  // namespace hoplab::python
