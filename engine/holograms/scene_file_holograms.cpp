#include "engine/holograms/scene_file_holograms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/printed.h"
#include "engine/holograms/scene_file_values.h"
#include "engine/holograms/shapes/hologram_cross.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "engine/holograms/shapes/hologram_twin.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/io/mesh_file.h"
#include "nav/guidance/rod.h"
#include "render/decimated.h"
#include "render/float3.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::Label;
using render::Scene;

constexpr Label kFree = 99;

void add_path(const JsonNode& node, Label label, Scene& scene) {
  constexpr std::array<const char*, 2> kStates = {"recording", "saved"};
  const std::vector<Float3> samples = places_from(node, "samples_mm");
  if (node.has("distances_mm")) {
    std::vector<float> distances_m;
    for (const double mm : node.numbers("distances_mm", samples.size())) {
      if (!(std::abs(mm) <= kFarthest_mm)) {
        node.refuse("distances_mm", "holds " + printed("%g", mm) + ", must lie within 10000 mm");
      }
      distances_m.push_back(static_cast<float>(mm * 1e-3));
    }
    return add_residual_path(scene, samples, distances_m, label);
  }
  const bool saved = word_from(node, "state", kStates) == 1;
  const double opacity = node.has("opacity") ? node.number("opacity") : 1.0;
  if (!(opacity >= 0.0 && opacity <= 1.0)) {
    node.refuse("opacity", "must lie in [0, 1]");
  }
  add_sampled_path(scene, samples, saved ? PathState::kSaved : PathState::kRecording, label,
                   static_cast<float>(opacity));
}

void add_bone(const JsonNode& node, const std::string& folder, Label label, Scene& scene) {
  constexpr std::array<const char*, 2> kUnits = {"mm", "m"};
  const bool metres = word_from(node, "unit", kUnits) == 1;
  const auto path = std::filesystem::path(folder) / node.text("mesh");
  const auto mesh = load_mesh(path.string(), metres ? 1.0 : 1e-3);
  if (!mesh) {
    return node.refuse("mesh", mesh.error().message);
  }
  render::Matrix4 place = render::kIdentity;
  if (node.has("world_from_vertebra")) {
    std::array<double, 16> rows{};
    std::ranges::copy(node.numbers("world_from_vertebra", rows.size()), rows.begin());
    for (const std::size_t offset : {3U, 7U, 11U}) {
      rows[offset] *= 1e-3;
    }
    const auto rigid = Transform<World, Vertebra>::from_row_major(rows);
    if (!rigid || rows[12] != 0.0 || rows[13] != 0.0 || rows[14] != 0.0 || rows[15] != 1.0) {
      return node.refuse("world_from_vertebra",
                         rigid ? "must end with the row 0, 0, 0, 1" : rigid.error().message);
    }
    place = to_matrix(rigid->row_major());
  }
  add_vertebra(scene, mesh_data(*mesh), place, label);
}

void add_entry_point(const JsonNode& node, Label label, Scene& scene) {
  constexpr std::array<const char*, 2> kSides = {"right", "left"};
  EntryHologram entry;
  entry.position = place_from(node, "position_mm");
  entry.surface_normal = direction_from(node, "normal");
  const std::string text = node.text_or("text", "");
  entry.text = text;
  entry.done = node.flag_or("done", false);
  entry.side = word_from(node, "side", kSides) == 1 ? LabelSide::kLeft : LabelSide::kRight;
  add_entry(scene, entry, label);
}

/// Angle, offset and, where it is given, the depth of a tool whose pose is sure.
void add_numbers_of(const JsonNode& node, const TargetCross& cross, Scene& scene) {
  const double offset_m = static_cast<double>(render::length(cross.reading->tip_offset));
  CrossNumbers numbers;
  numbers.grade = cross.reading->grade;
  numbers.sizes =
      nav::ScrewSizeWriter().write({angle_from(node).value_or(0.0), 0.0}, {offset_m, 0.0});
  if (node.has("depth_mm")) {
    const double depth_mm = number_between(node, "depth_mm", -900.0, 900.0, "mm");
    const double to_target_mm = number_between(node, "to_target_mm", -900.0, 900.0, "mm");
    numbers.depth = nav::DepthWriter().write({depth_mm * 1e-3, 0.0}, to_target_mm * 1e-3);
    const double way = depth_mm / (depth_mm + to_target_mm);
    numbers.way = static_cast<float>(std::clamp(way, 0.0, 1.0));
  }
  add_cross_numbers(scene, cross, numbers,
                    {label_of(HologramKind::kAngle, 1), label_of(HologramKind::kNumbers, 6),
                     label_of(HologramKind::kDepth, 1)});
}

void add_cross(const JsonNode& node, Label label, Scene& scene) {
  TargetCross cross;
  cross.site = place_from(node, "site_mm");
  cross.outward = direction_from(node, "outward");
  cross.viewer.eye = place_from(node, "eye_mm");
  if (node.has("up")) {
    cross.viewer.up = direction_from(node, "up");
  }
  cross.lost = node.flag_or("lost", false);
  if (node.has("tip_offset_mm")) {
    cross.reading = CrossReading{place_from(node, "tip_offset_mm"),
                                 place_from(node, "top_offset_mm"), grade_from(node)};
  }
  add_target_cross(scene, cross, label);
  if (cross.reading) {
    add_numbers_of(node, cross, scene);
  }
}

void add_rod_through(const JsonNode& node, Label label, Scene& scene) {
  const double diameter_m = node.has("diameter_mm")
                                ? number_between(node, "diameter_mm", 1.0, 15.0, "mm") * 1e-3
                                : 0.0055;
  std::vector<Vec3> heads_m;
  for (const Vec3 head_mm : node.vec3s("heads_mm")) {
    heads_m.push_back(head_mm * 1e-3);
  }
  RodHologram hologram;
  const std::vector<Float3> heads = places_from(node, "heads_mm");
  std::vector<RodBendMark> bends;
  if (heads.size() > 1) {
    const auto rod = nav::rod_template(heads_m, diameter_m);
    if (!rod) {
      return node.refuse("heads_mm", rod.error().message);
    }
    std::vector<Float3> path;
    for (const Vec3 p : rod->path_m) {
      path.push_back(to_float3(p));
    }
    hologram.tube =
        render::prepared(render::make_tube(path, static_cast<float>(0.5 * rod->diameter_m)));
    for (const nav::RodBend& bend : rod->bends) {
      bends.push_back({to_float3(bend.position_m), bend.angle_rad, bend.arc_length_m});
    }
    hologram.length_m = rod->length_m;
  }
  hologram.heads = heads;
  hologram.bends = bends;
  if (node.has("shift_mm")) {
    hologram.offset = place_from(node, "shift_mm");
  }
  add_rod(scene, hologram, label);
}

void add_status(const JsonNode& node, Label label, Scene& scene) {
  constexpr std::array<const char*, 3> kStates = {"measured", "predicted", "lost"};
  std::vector<ToolDot> tools;
  if (node.has("tools")) {
    for (const JsonNode& tool : node.list("tools")) {
      tools.push_back({static_cast<ToolState>(word_from(tool, "state", kStates))});
    }
  }
  add_status_line(scene, node.text("text"), tools, label);
}

void add_check(const JsonNode& node, Label label, Scene& scene) {
  const Float3 place = place_from(node, "position_mm");
  if (!node.has("distance_mm")) {
    return add_place_to_check(scene, place, label);
  }
  const double distance_m =
      number_between(node, "distance_mm", -kFarthest_mm, kFarthest_mm, "mm") * 1e-3;
  add_check_point(scene, place, distance_text(distance_m), std::abs(distance_m) <= 0.002, label);
}

void add_free_line(const JsonNode& node, Label label, Scene& scene) {
  add_line(scene, places_from(node, "points_mm"), length_from(node, "width_mm", 0.01, 100.0),
           colour_from(node), label,
           node.has("dash_mm") ? length_from(node, "dash_mm", 0.1, 1000.0) : 0.0f,
           node.flag_or("closed", false));
}

void add_free_text(const JsonNode& node, Label label, Scene& scene) {
  render::TextItem& text = scene.texts.emplace_back();
  text.label = label;
  text.position = place_from(node, "position_mm");
  text.height_m = length_from(node, "height_mm", 0.1, 100.0);
  add_run(text, node.text("text"), colour_from(node));
}

void add_twin_of(const JsonNode& node, const std::string& folder, Label label, Scene& scene) {
  const VirtualTwin twin{place_from(node, "site_mm"), direction_from(node, "beside")};
  Scene parts;
  for (const JsonNode& part : node.list("of")) {
    if (hologram_number(part.text("type")) == 8) {
      return part.refuse("type", "can't be a twin");
    }
    add_hologram(part, folder, 1, parts);
  }
  add_twin(scene, twin, parts, label);
}

struct Kind {
  const char* type;
  Label number;
  void (*add)(const JsonNode&, const std::string& folder, Label, Scene&);
  const char* keys;  ///< besides `type`
};

template <void (*kAdd)(const JsonNode&, Label, Scene&)>
void plain(const JsonNode& node, const std::string& /*folder*/, Label label, Scene& scene) {
  kAdd(node, label, scene);
}

void add_plan(const JsonNode& node, Label label, Scene& scene) {
  add_planned_trajectory(scene, place_from(node, "entry_mm"), place_from(node, "target_mm"), label);
}
void add_triangle(const JsonNode& node, Label label, Scene& scene) {
  add_deviation_triangle(scene, place_from(node, "entry_mm"), place_from(node, "tool_mm"),
                         place_from(node, "plan_mm"), grade_from(node), label);
}
constexpr std::array<Kind, 12> kKinds = {
    {{"path", 1, plain<add_path>, "samples_mm state opacity distances_mm"},
     {"vertebra", 2, add_bone, "mesh unit world_from_vertebra"},
     {"entry", 3, plain<add_entry_point>, "position_mm normal text done side"},
     {"trajectory", 4, plain<add_plan>, "entry_mm target_mm"},
     {"triangle", 5, plain<add_triangle>, "entry_mm tool_mm plan_mm angle_deg"},
     {"cross", 7, plain<add_cross>,
      "site_mm outward eye_mm up tip_offset_mm top_offset_mm angle_deg depth_mm to_target_mm lost"},
     {"twin", 8, add_twin_of, "site_mm beside of"},
     {"rod", 10, plain<add_rod_through>, "heads_mm diameter_mm shift_mm"},
     {"status", 11, plain<add_status>, "text tools"},
     {"check_point", 12, plain<add_check>, "position_mm distance_mm"},
     {"line", kFree, plain<add_free_line>, "points_mm width_mm colour dash_mm closed"},
     {"text", kFree, plain<add_free_text>, "position_mm text height_mm colour"}}};

}  // namespace

Label hologram_number(const std::string& type) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const Kind& kind) { return type == kind.type; });
  return found == kKinds.end() ? 0 : found->number;
}

void add_hologram(const JsonNode& node, const std::string& folder, std::size_t k, Scene& scene) {
  const std::string type = node.text("type");
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const Kind& kind) { return type == kind.type; });
  if (found == kKinds.end()) {
    std::string known;
    for (const Kind& kind : kKinds) {
      known += std::string(known.empty() ? "" : ", ") + kind.type;
    }
    return node.refuse("type", "is \"" + type + "\", must be one of " + known);
  }
  for (const std::string& key : node.keys()) {
    const std::string known = " " + std::string(found->keys) + " ";
    if (key != "type" && known.find(" " + key + " ") == std::string::npos) {
      return node.refuse(key.c_str(), "is unknown; " + type + " has " + found->keys);
    }
  }
  const auto label = 100 * found->number + static_cast<Label>(std::min<std::size_t>(k, 99));
  found->add(node, folder, label, scene);
}

}  // namespace orthonav::engine
