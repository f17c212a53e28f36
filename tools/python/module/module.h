// The parts of the Python module _voussoir. Users call it through the package voussoir (tools/python/voussoir).
#pragma once
#include <pybind11/pybind11.h>

namespace voussoir::python {

void bind_assembly(pybind11::module_& m);
void bind_case(pybind11::module_& m);
void bind_simulation(pybind11::module_& m);
void bind_run(pybind11::module_& m);
void bind_modal(pybind11::module_& m);
void bind_analyses(pybind11::module_& m);

}  // namespace voussoir::python
