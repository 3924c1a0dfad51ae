#include "tools/evaluate_spine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "embedded/evaluation_js.h"
#include "engine/report/base64.h"
#include "engine/report/html_text.h"

namespace orthonav::tools {
namespace {

using nlohmann::json;
using ScanFromVertebra = Transform<engine::Scan, Vertebra>;

constexpr std::size_t kMostVertices = 65535;  ///< an index has 16 bits
constexpr double kSteps_per_m = 1e5;          ///< places are whole hundredths of a millimetre

template <class Value>
std::string packed(const std::vector<Value>& values) {
  const auto* const first = reinterpret_cast<const std::uint8_t*>(values.data());
  return engine::base64({first, values.size() * sizeof(Value)});
}

/// Places are relative to `middle`, so that they fit into 16 bits: 0.3 m to either side.
json bone_json(const nav::TriangleMesh& mesh, const ScanFromVertebra& pose,
               Point<engine::Scan> middle) {
  std::vector<std::int16_t> places;
  for (const Vec3& v : mesh.vertices_m) {
    const Vec3 at = kSteps_per_m * ((pose * Point<Vertebra>{v}) - middle);
    for (int a = 0; a < 3; ++a) {
      places.push_back(static_cast<std::int16_t>(std::clamp(std::lround(at[a]), -32767L, 32767L)));
    }
  }
  std::vector<std::uint16_t> faces;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      faces.push_back(static_cast<std::uint16_t>(corner));
    }
  }
  return {{"places", packed(places)}, {"faces", packed(faces)}};
}

json cylinder_json(const nav::ScrewCylinder& cylinder, const ScanFromVertebra& pose,
                   Point<engine::Scan> middle) {
  const Vec3 from = 1e3 * ((pose * cylinder.entry) - middle);
  const Vec3 to =
      1e3 * ((pose * (cylinder.entry + cylinder.length_m * cylinder.direction)) - middle);
  return {from.x, from.y, from.z, to.x, to.y, to.z, cylinder.radius_m * 1e3};
}

Point<engine::Scan> middle_of(const engine::Evaluation& evaluation) {
  Vec3 sum;
  double count = 0.0;
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    if (level.registration) {
      const Point<Vertebra> centre{level.registration->uncertainty.centre_m()};
      sum += (level.registration->scan_from_vertebra * centre).v;
      count += 1.0;
    }
  }
  return {sum / std::max(1.0, count)};
}

json scene_of(const engine::Case& subject, const engine::Evaluation& evaluation) {
  const Point<engine::Scan> middle = middle_of(evaluation);
  json scene = {{"bones", json::array()},
                {"planned", json::array()},
                {"placed", json::array()},
                {"reach", 0.0}};
  double reach_mm = 0.0;
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    const engine::CaseLevel* const model = subject.find(level.label);
    if (!level.registration || model == nullptr || model->mesh.vertices_m.size() > kMostVertices) {
      continue;
    }
    const ScanFromVertebra& pose = level.registration->scan_from_vertebra;
    scene["bones"].push_back(bone_json(model->mesh, pose, middle));
    for (const Vec3& v : model->mesh.vertices_m) {
      reach_mm = std::max(reach_mm, 1e3 * ((pose * Point<Vertebra>{v}) - middle).norm());
    }
    for (const engine::EvaluatedScrew& screw : level.screws) {
      if (const auto plan = nav::cylinder_of(screw.plan)) {
        scene["planned"].push_back(cylinder_json(*plan, pose, middle));
      }
      if (screw.placed) {
        scene["placed"].push_back(cylinder_json(screw.placed->cylinder, pose, middle));
      }
    }
  }
  scene["reach"] = std::round(reach_mm);
  return scene;
}

}  // namespace

std::string rotating_spine(const engine::Case& subject, const engine::Evaluation& evaluation) {
  const json scene = scene_of(subject, evaluation);
  if (scene["bones"].empty()) {
    return "";
  }
  return "<section><h2>As it lies in the scan</h2><canvas id=spine "
         "style=\"width:100%;height:480px;display:block;border-radius:6px;touch-action:none\">"
         "</canvas><p id=spine-note class=notes style=\"margin-top:10px\">Drag to turn, wheel to "
         "zoom. "
         "<button data-turn=behind>from behind</button> <button data-turn=left>from the left"
         "</button> <button data-turn=above>from above</button> <label>bone <input id=spine-bone "
         "type=range min=0 max=1 step=0.05 value=0.35></label></p><script id=spine-data "
         "type=\"application/json\">" +
         scene.dump() + "</script><script>" + std::string(embedded::evaluation_js()) +
         "</script></section>";
}

}  // namespace orthonav::tools
