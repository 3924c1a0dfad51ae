#include <pybind11/stl.h>
#include <algorithm>

#include "base/joined.h"
#include "base/printed.h"
#include "engine/case/tool_file.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/values.h"

namespace orthonav::python {
namespace {

nav::ToolRole role_from(const std::string& name) {
  for (std::size_t i = 0; i < nav::kToolRoles; ++i) {
    if (const auto role = static_cast<nav::ToolRole>(i); name == nav::name_of(role)) {
      return role;
    }
  }
  throw Refused("role: is \"" + name + "\", which is none of a tool");
}

nav::ToolGeometry tool_from(const std::string& name, const std::string& role, int tag_id,
                            double tag_size_m, const py::object& tip_in_marker,
                            const py::object& axis_in_marker, const std::string& family) {
  nav::ToolGeometry tool{name, role_from(role), {family, tag_id, tag_size_m}, {}, {}, {}};
  tool.tip_in_marker = {vec3_from(tip_in_marker, "tip_in_marker")};
  tool.axis_in_marker = {vec3_from(axis_in_marker, "axis_in_marker")};
  if (const auto problems = nav::problems_of({tool}); !problems.empty()) {
    throw Refused(joined(problems));
  }
  return tool;
}

std::vector<nav::ToolGeometry> load_tools(const std::string& path) {
  return value_of(engine::load_tools(path));
}

}  // namespace

void bind_tools(py::module_& module) {
  using nav::ToolGeometry;
  py::class_<ToolGeometry>(module, "Tool", "A rigid tool: where its tip and axis lie from its tag.")
      .def(py::init(&tool_from), py::arg("name"), py::arg("role"), py::arg("tag_id"),
           py::arg("tag_size_m"), py::arg("tip_in_marker"),
           py::arg("axis_in_marker") = std::vector<double>{0, 1, 0}, py::arg("family") = "tag36h11",
           "role: \"pointer\", \"guide\", \"reference\" and so on; tag_size_m: outer edge of the "
           "tag's\n"
           "black border; axis_in_marker: unit, from the tip back along the shaft.")
      .def_readonly("name", &ToolGeometry::name)
      .def_property_readonly("role", [](const ToolGeometry& t) { return nav::name_of(t.role); })
      .def_property_readonly("tag_id", [](const ToolGeometry& t) { return t.marker.id; })
      .def_property_readonly("tag_size_m", [](const ToolGeometry& t) { return t.marker.size_m; })
      .def_property_readonly("tip_in_marker",
                             [](const ToolGeometry& t) { return array_of(t.tip_in_marker.v); })
      .def_property_readonly("axis_in_marker",
                             [](const ToolGeometry& t) { return array_of(t.axis_in_marker.v); })
      .def("__repr__", [](const ToolGeometry& t) {
        return printed("<Tool %s: %s, tag %s %d, %.1f mm>", t.name.c_str(), nav::name_of(t.role),
                       t.marker.family.c_str(), t.marker.id, 1e3 * t.marker.size_m);
      });
  module.def("load_tools", &load_tools, py::arg("path"), "The tools of a file (JSON).");
  module.def("built_in_tools", &engine::built_in_tools,
             "The pointer, the drill guide and the patient reference that are printed.");
}

}  // namespace orthonav::python
