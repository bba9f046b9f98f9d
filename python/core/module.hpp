// The parts of the module gearlash._core.
#pragma once

#include <pybind11/pybind11.h>

namespace gearlash::python {

void add_drives(pybind11::module_& module);
void add_analysis(pybind11::module_& module);
void add_motions(pybind11::module_& module);
void add_grids(pybind11::module_& module);
void add_design(pybind11::module_& module);
void add_plots(pybind11::module_& module);
void add_thesis(pybind11::module_& module);

}  // namespace gearlash::python
