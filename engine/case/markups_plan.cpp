#include "engine/case/markups_plan.h"

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "engine/io/json_writer.h"
#include "engine/io/slicer_markups.h"

namespace orthonav::engine {
namespace {

using nlohmann::ordered_json;

/// 3D Slicer refuses a file without it.
constexpr const char* kSchema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#";

ordered_json control_point(const char* id, const char* label, Point<Vertebra> p) {
  return {{"id", id},
          {"label", label},
          {"description", ""},
          {"position", vector_mm(p.v)},
          {"orientation", {-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0}},
          {"selected", true},
          {"locked", false},
          {"visibility", true},
          {"positionStatus", "defined"}};
}

ordered_json line(const std::string& level, const nav::ScrewPlan& screw) {
  std::string name = (level.empty() ? "" : level + " ") + name_of(screw.side);
  if (screw.radius_m > 0.0) {
    name += printed(" diameter=%g", screw.radius_m * 2e3);
  }
  ordered_json out = {
      {"type", "Line"},
      {"name", name},
      {"coordinateSystem", "LPS"},
      {"coordinateUnits", "mm"},
      {"locked", false},
      {"labelFormat", "%N-%d"},
      {"controlPoints",
       {control_point("1", "entry", screw.entry), control_point("2", "target", screw.target)}}};
  if (!screw.accepted_breach.empty()) {
    out["description"] = "accept_breach=" + screw.accepted_breach;
  }
  return out;
}

}  // namespace

Status save_markups_plan(const std::string& path, const std::string& level,
                         std::span<const nav::ScrewPlan> screws) {
  if (!is_markups_name(path)) {
    return Error{path + ": must end in .mrk.json"};
  }
  ordered_json root = {{"@schema", kSchema}, {"markups", ordered_json::array()}};
  for (const nav::ScrewPlan& screw : screws) {
    root["markups"].push_back(line(level, screw));
  }
  return write_json(path, root);
}

}  // namespace orthonav::engine
