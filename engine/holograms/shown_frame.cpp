#include "engine/holograms/shown_frame.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "engine/holograms/hologram_shapes.h"
#include "engine/holograms/render_values.h"
#include "engine/holograms/screw_holograms.h"

namespace orthonav::engine {
namespace {

/// Of a path the newest samples are enough to see where the pen is.
constexpr std::size_t kLatestSamples = 8;

/// The four that stand out: behind, to either side, above.
std::array<Vec3, 4> landmarks_m(const nav::TriangleMesh& mesh) {
  constexpr std::array<Vec3, 4> kDirections = {{{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}};
  std::array<Vec3, 4> found{};
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    found[d] = *std::max_element(
        mesh.vertices_m.begin(), mesh.vertices_m.end(),
        [&](Vec3 a, Vec3 b) { return a.dot(kDirections[d]) < b.dot(kDirections[d]); });
  }
  return found;
}

Point<World> to_point(render::Float3 p) { return {{p.x, p.y, p.z}}; }

}  // namespace

TrajectoryLine trajectory_of(const LevelState& level, std::size_t screw) {
  const auto& world_from_vertebra = level.registration->world_from_vertebra;
  const nav::ScrewPlan& plan = level.plan.screws[screw];
  const Vec3 out = (plan.entry - plan.target).normalized();
  return {world_from_vertebra * (plan.entry + out * static_cast<double>(kTrajectoryOutside_m)),
          world_from_vertebra * plan.entry, world_from_vertebra * plan.target};
}

ShownHologram& ShownFrameWriter::add(ShownFrame& frame, const char* name) {
  if (used_ == frame.holograms.size()) {
    frame.holograms.emplace_back();
  }
  ShownHologram& hologram = frame.holograms[used_++];
  hologram.name = name;
  hologram.text.clear();
  hologram.points_in_world.clear();
  return hologram;
}

void ShownFrameWriter::write(const Guidance& guidance, const Visibility& visible,
                             const VisibilityRules& rules, ShownFrame& frame) {
  used_ = 0;
  frame.display_time = guidance.display_time;
  frame.pose_time = guidance.pose_time;
  write_status(guidance, frame);
  write_digitizing(guidance, visible, frame);
  write_entries(guidance, visible, frame);
  write_screw(guidance, visible, rules, frame);
  if (visible.rods) {
    write_rods(guidance, rules, frame);
  }
  frame.holograms.resize(used_);
}

void ShownFrameWriter::write_digitizing(const Guidance& guidance, const Visibility& visible,
                                        ShownFrame& frame) {
  if (visible.paths && !guidance.regions.empty()) {
    const auto& samples = guidance.regions.back().samples;
    ShownHologram& path = add(frame, "H1 path");
    const std::size_t first = samples.size() - std::min(samples.size(), kLatestSamples);
    for (std::size_t i = first; i < samples.size(); ++i) {
      path.points_in_world.push_back(samples[i].tip_in_world);
    }
  }
  if (visible.vertebra) {
    const LevelState& level = guidance.levels[guidance.level];
    ShownHologram& vertebra = add(frame, "H2 vertebra");
    const nav::VertebraModel& model = *level.plan.model;
    const auto [known, is_new] = landmarks_m_.try_emplace(&model);
    if (is_new) {
      known->second = landmarks_m(model.mesh());
    }
    for (const Vec3 landmark : known->second) {
      vertebra.points_in_world.push_back(level.registration->world_from_vertebra *
                                         Point<Vertebra>{landmark});
    }
  }
  if (visible.check_points) {
    for (const nav::CheckPoint& point : guidance.levels[guidance.level].check_points) {
      ShownHologram& check = add(frame, "H12 check point");
      check.text = distance_text(point.distance_m);
      check.points_in_world.push_back(point.place);
    }
  }
  if (visible.check_points) {
    for (const Point<World>& place : guidance.to_check) {
      add(frame, "H12 to check").points_in_world.push_back(place);
    }
  }
}

void ShownFrameWriter::write_entries(const Guidance& guidance, const Visibility& visible,
                                     ShownFrame& frame) {
  std::array<char, 64> text{};
  for (const std::size_t i : visible.entries_of) {
    const LevelState& level = guidance.levels[i];
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      std::snprintf(text.data(), text.size(), "H3 entry %s %s", level.plan.label.c_str(),
                    name_of(screw.side));
      ShownHologram& entry = add(frame, text.data());
      std::snprintf(text.data(), text.size(), "%s %s", level.plan.label.c_str(),
                    name_of(screw.side));
      if (visible.entry_labels) {
        entry.text = text.data();
      }
      entry.points_in_world.push_back(level.registration->world_from_vertebra * screw.entry);
    }
  }
}

void ShownFrameWriter::write_cross(const Guidance& guidance, const Visibility& visible,
                                   const VisibilityRules& rules, ShownFrame& frame) {
  const TargetCross cross = cross_of(guidance, visible, rules);
  const CrossPlaces places = places_of(cross);
  ShownHologram& shown = add(frame, "H7 cross");
  if (cross.lost) {
    shown.text = "tool lost";
  }
  shown.points_in_world.push_back(to_point(places.middle));
  if (!cross.reading) {
    return;
  }
  for (const render::Float3 dot : places.dots) {
    shown.points_in_world.push_back(to_point(dot));
  }
}

void ShownFrameWriter::write_screw(const Guidance& guidance, const Visibility& visible,
                                   const VisibilityRules& rules, ShownFrame& frame) {
  if (visible.trajectory) {
    const TrajectoryLine line = trajectory_of(guidance.levels[guidance.level], guidance.screw);
    ShownHologram& trajectory = add(frame, "H4 trajectory");
    trajectory.points_in_world = {line.outside, line.entry, line.target};
  }
  if (visible.triangle) {
    const nav::ScrewGuidance& shown = guidance.tool->shown;
    add(frame, "H5 triangle").points_in_world = {shown.a, shown.b, shown.c};
  }
  if (visible.angle) {
    add(frame, "H6 angle").text = angle_text(guidance.tool->measured->angle_rad);
  }
  if (visible.cross) {
    write_cross(guidance, visible, rules, frame);
  }
  if (visible.twin) {
    const VirtualTwin twin = twin_of(guidance.levels[guidance.level], guidance.screw);
    const TrajectoryLine line = trajectory_of(guidance.levels[guidance.level], guidance.screw);
    ShownHologram& shown = add(frame, "H8 twin");
    for (const Point<World>& place : {line.entry, line.target}) {
      shown.points_in_world.push_back(to_point(in_twin(twin, to_float3(place.v))));
    }
  }
  if (visible.depth) {
    const nav::ScrewGuidance& measured = *guidance.tool->measured;
    if (write_depth_text(measured.depth_m, measured.to_target_m, text_)) {
      add(frame, "H9 depth").text = text_;
    }
  }
  if (visible.angle_lost) {
    add(frame, "H6 angle").text = angle_text(std::nullopt);
  }
}

void ShownFrameWriter::write_rods(const Guidance& guidance, const VisibilityRules& rules,
                                  ShownFrame& frame) {
  for (const RodState& rod : guidance.rods) {
    if (!rod.visible()) {
      continue;
    }
    const Vec3 shift = rod_shift_m(guidance, rod, rules);
    ShownHologram& hologram = add(frame, "H10 rod");
    for (const Point<World>& head : rod.heads) {
      hologram.points_in_world.push_back(head + shift);
    }
  }
}

void ShownFrameWriter::write_status(const Guidance& guidance, ShownFrame& frame) {
  ShownHologram& status = add(frame, "H11 status");
  status.text = guidance.step_text;
  if (!guidance.detail.empty()) {
    status.text += " | ";
    status.text += guidance.detail;
  }
  if (!guidance.heard.empty()) {
    add(frame, "H11 heard").text = guidance.heard;
  }
}

}  // namespace orthonav::engine
