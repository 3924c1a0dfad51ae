#include "engine/report/spine_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "embedded/spine_view_js.h"
#include "engine/report/base64.h"
#include "engine/report/script_json.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

constexpr double kSteps_per_m = 1e5;  ///< places are whole hundredths of a millimetre

template <class Value>
std::string packed(const std::vector<Value>& values) {
  const auto* const first = reinterpret_cast<const std::uint8_t*>(values.data());
  return base64({first, values.size() * sizeof(Value)});
}

/// Places are relative to `middle_m`, so that they fit into 16 bits: 0.3 m to either side.
json bone_json(const nav::TriangleMesh& mesh, Vec3 middle_m) {
  std::vector<std::int16_t> places;
  places.reserve(3 * mesh.vertices_m.size());
  for (const Vec3& v : mesh.vertices_m) {
    const Vec3 at = kSteps_per_m * (v - middle_m);
    for (int a = 0; a < 3; ++a) {
      places.push_back(static_cast<std::int16_t>(std::clamp(std::lround(at[a]), -32767L, 32767L)));
    }
  }
  std::vector<std::uint16_t> faces;
  faces.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      faces.push_back(static_cast<std::uint16_t>(corner));
    }
  }
  return {{"places", packed(places)}, {"faces", packed(faces)}};
}

/// The middle of the box around everything.
Vec3 middle_of(const std::vector<nav::TriangleMesh>& bones) {
  nav::Bounds all = nav::bounds_of(bones.front());
  for (const nav::TriangleMesh& bone : bones) {
    const nav::Bounds box = nav::bounds_of(bone);
    for (int axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], box.low[axis]);
      all.high[axis] = std::max(all.high[axis], box.high[axis]);
    }
  }
  return all.centre();
}

}  // namespace

std::string SpineView::data() const {
  const Vec3 middle_m = middle_of(bones_);
  const auto cylinders = [&](const std::vector<Cylinder>& screws) {
    json out = json::array();
    for (const Cylinder& screw : screws) {
      const Vec3 from = 1e3 * (screw.from_m - middle_m);
      const Vec3 to = 1e3 * (screw.to_m - middle_m);
      out.push_back({from.x, from.y, from.z, to.x, to.y, to.z, screw.radius_m * 1e3});
    }
    return out;
  };
  json bones = json::array();
  double reach_mm = 0.0;
  for (const nav::TriangleMesh& bone : bones_) {
    bones.push_back(bone_json(bone, middle_m));
    for (const Vec3& v : bone.vertices_m) {
      reach_mm = std::max(reach_mm, 1e3 * (v - middle_m).norm());
    }
  }
  return script_json({{"bones", std::move(bones)},
                      {"planned", cylinders(planned_)},
                      {"placed", cylinders(placed_)},
                      {"reach", std::round(reach_mm)}});
}

std::string SpineView::section(std::string_view heading, std::string_view what) const {
  if (bones_.empty()) {
    return "";
  }
  return std::string("<section><h2>")
      .append(heading)
      .append(
          "</h2><canvas id=spine style=\"width:100%;height:480px;display:block;border-radius:6px;"
          "touch-action:none\"></canvas><p id=spine-note class=notes style=\"margin-top:10px\">")
      .append(what)
      .append(
          "<span class=on-screen> Drag to turn, wheel to zoom. <button data-turn=behind>from "
          "behind</button> "
          "<button data-turn=left>from the left</button> <button data-turn=above>from above"
          "</button> <label>bone <input id=spine-bone type=range min=0 max=1 step=0.05 value=0.35>"
          "</label></span></p><script id=spine-data type=\"application/json\">")
      .append(data())
      .append("</script><script>")
      .append(embedded::spine_view_js())
      .append("</script></section>");
}

}  // namespace orthonav::engine
