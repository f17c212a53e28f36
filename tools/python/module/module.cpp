#include "tools/python/module/module.h"

#include <filesystem>

#include "solver/base/build_info.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/model/kernels.h"
#include "tools/python/module/arrays.h"

namespace voussoir::python {

Vec3 vector_of(const py::handle& three, const char* what) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(three);
  if (!array || array.size() != 3) {
    PyErr_Clear();
    throw InputError("{} must be three numbers (x, y, z)", what);
  }
  return {array.data()[0], array.data()[1], array.data()[2]};
}

namespace {

/// InputError is a ValueError, RunError a RuntimeError: the package defines both and hands them over.
struct Errors {
  py::object input, run;
};

void translate_errors(py::module_& m) {
  static Errors errors;
  m.def("_set_errors", [](py::object input, py::object run) { errors = {std::move(input), std::move(run)}; });
  m.def("_forget_errors", [] { errors = {}; });
  py::register_exception_translator(
      [](std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): as pybind11 declares it
        const auto raise = [](const py::object& type, PyObject* otherwise, const char* text) {
          PyErr_SetString(type ? type.ptr() : otherwise, text);
        };
        try {
          if (thrown) std::rethrow_exception(thrown);
        } catch (const InputError& error) {
          raise(errors.input, PyExc_ValueError, error.what());
        } catch (const RunError& error) {
          raise(errors.run, PyExc_RuntimeError, error.what());
        } catch (const std::filesystem::filesystem_error& error) {
          raise({}, PyExc_OSError, error.what());
        }
      });
}

}  // namespace

PYBIND11_MODULE(_voussoir, m) {
  m.doc() = "The voussoir libraries; use the package voussoir.";
  kernels();  // a wish that cannot be met (VOUSSOIR_KERNELS) is said when the module is imported
  m.attr("version") = program_version();
  m.def(
      "build_info",
      [] {
        py::dict info;
        info["version"] = program_version();
        info["commit"] = build_commit();
        info["kernels"] = kernels().instructions;
        info["compiler"] = build_compiler();
        info["libraries"] = build_libraries();
        return info;
      },
      "Version, commit, instruction set of the kernels, compiler and libraries of this build: {name: text}.");
  m.def("available_threads", &available_threads, "Number of threads that the machine offers.");
  translate_errors(m);
  bind_assembly(m);
  bind_case(m);
  bind_simulation(m);
  bind_run(m);
  bind_modal(m);
  bind_analyses(m);
}

}  // namespace voussoir::python
