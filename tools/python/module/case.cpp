// Cases: read from files or made of TOML texts, which the package writes from dictionaries.
#include "io/case/case.h"

#include <memory>

#include "io/case/remarks.h"
#include "tools/python/module/arrays.h"
#include "tools/python/module/module.h"

namespace voussoir::python {

namespace {

CaseUse use(bool geometry) {
  return geometry ? CaseUse::geometry : CaseUse::run;
}

}  // namespace

void bind_case(py::module_& m) {
  using Release = py::call_guard<py::gil_scoped_release>;
  py::class_<Case, std::shared_ptr<Case>>(m, "Case")
      .def_static("_read", [](const std::string& path,
                              bool geometry) { return std::make_shared<Case>(read_case(path, use(geometry))); })
      .def_static("_parse", [](const std::string& text, const std::string& path,
                               bool geometry) { return std::make_shared<Case>(parse_case(text, path, use(geometry))); })
      .def_readonly("path", &Case::path)
      .def_readonly("text", &Case::text)
      .def_readonly("generator", &Case::generator)
      .def("_resolved", &resolved_text)
      .def("_write", &write_self_contained_case)
      .def("_remarks", [](const Case& c, const Assembly& a) { return remarks(c, a); })
      .def(
          "_assembly", [](const Case& c) { return std::make_shared<Assembly>(make_assembly(c)); }, Release());
}

}  // namespace voussoir::python
