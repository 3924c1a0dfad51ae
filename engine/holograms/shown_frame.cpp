#include "engine/holograms/shown_frame.h"

#include <algorithm>
#include <array>

#include "base/translation.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/holograms/shapes/screw_holograms.h"
#include "engine/session/coach.h"
#include "engine/session/placed_wire.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

/// The newest samples of a path are enough to see where the tip is.
constexpr std::size_t kLatestSamples = 8;

/// The four outermost points: behind, to either side, above.
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

ShownHologram& ShownFrameWriter::add(ShownFrame& frame, HologramKind kind) {
  if (used_ == frame.holograms.size()) {
    frame.holograms.emplace_back();
  }
  ShownHologram& hologram = frame.holograms[used_++];
  hologram.kind = kind;
  hologram.level.clear();
  hologram.side.reset();
  hologram.text.clear();
  hologram.reading.reset();
  hologram.points_in_world.clear();
  return hologram;
}

void ShownFrameWriter::write(const Guidance& guidance, const Visibility& visible,
                             ShownFrame& frame) {
  const WearersLanguage language;
  used_ = 0;
  frame.display_time = guidance.display_time;
  frame.pose_time = guidance.pose_time;
  write_status(guidance, visible, frame);
  write_path(guidance, visible, frame);
  if (visible.vertebra) {
    write_verifying(*visible.vertebra, guidance.to_check, frame);
  }
  write_entries(visible, frame);
  if (visible.stroke_next) {
    add(frame, HologramKind::kCheckPoint).points_in_world.push_back(*visible.stroke_next);
  }
  if (visible.landmark) {
    add(frame, HologramKind::kCheckPoint).points_in_world.push_back(*visible.landmark);
  }
  if (visible.trajectory) {
    write_screw(*visible.trajectory, visible, frame);
  }
  if (visible.rods) {
    write_rods(guidance, frame);
  }
  frame.holograms.resize(used_);
}

void ShownFrameWriter::write_path(const Guidance& guidance, const Visibility& visible,
                                  ShownFrame& frame) {
  if (visible.paths && !guidance.regions.empty()) {
    const auto& samples = guidance.regions.back().samples;
    ShownHologram& path = add(frame, HologramKind::kPath);
    const std::size_t first = samples.size() - std::min(samples.size(), kLatestSamples);
    for (std::size_t i = first; i < samples.size(); ++i) {
      path.points_in_world.push_back(samples[i].tip_in_world);
    }
  }
}

void ShownFrameWriter::write_verifying(const PlacedLevel& at,
                                       std::span<const Point<World>> to_check, ShownFrame& frame) {
  ShownHologram& vertebra = add(frame, HologramKind::kVertebra);
  const nav::VertebraModel& model = *at.level->plan.model;
  const auto [known, is_new] = landmarks_m_.try_emplace(&model);
  if (is_new) {
    known->second = landmarks_m(model.mesh());
  }
  for (const Vec3 landmark : known->second) {
    vertebra.points_in_world.push_back(at.world_from_vertebra * Point<Vertebra>{landmark});
  }
  for (const nav::CheckPoint& point : at.level->check_points) {
    ShownHologram& check = add(frame, HologramKind::kCheckPoint);
    if (&point == &at.level->check_points.back()) {
      check.text = distance_text(point.distance_m);
    }
    check.reading = point.distance_m;
    check.points_in_world.push_back(point.place);
  }
  if (!to_check.empty()) {
    add(frame, HologramKind::kCheckPoint).points_in_world.push_back(to_check.front());
  }
}

void ShownFrameWriter::write_entries(const Visibility& visible, ShownFrame& frame) {
  for (const PlacedLevel& at : visible.entries_of) {
    const OperatedLevel& plan = at.level->plan;
    for (const nav::ScrewPlan& screw : plan.screws) {
      ShownHologram& entry = add(frame, HologramKind::kEntry);
      entry.level = plan.label;
      entry.side = screw.side;
      append_entry_name(entry.text, visible, at,
                        static_cast<std::size_t>(&screw - plan.screws.data()));
      entry.points_in_world.push_back(at.world_from_vertebra * screw.entry);
    }
  }
}

void ShownFrameWriter::write_cross(const PlacedScrew& screw, const Visibility& visible,
                                   ShownFrame& frame) {
  const TargetCross cross = cross_of(screw, visible);
  const CrossPlaces places = places_of(cross);
  ShownHologram& shown = add(frame, HologramKind::kCross);
  if (cross.lost) {
    shown.text = translated(words::kToolLost);
  } else {
    append_cross_word(shown.text, visible);
  }
  shown.points_in_world.push_back(to_point(places.middle));
  if (!cross.reading) {
    return;
  }
  for (const render::Float3 dot : places.dots) {
    shown.points_in_world.push_back(to_point(dot));
  }
}

/// A bound is no reading of where the tool is.
void ShownFrameWriter::write_sizes(const Visibility& visible, ShownFrame& frame) {
  ShownHologram& angle = add(frame, HologramKind::kAngle);
  if (visible.sizes == nullptr) {
    angle.text = angle_text(std::nullopt);
    return;
  }
  const auto read = [](const nav::ShownSize& size, double tenth) {
    return size.certainty == nav::Certainty::kSure ? std::optional(size.tenths * tenth)
                                                   : std::nullopt;
  };
  append_angle(angle.text, visible.sizes->angle);
  angle.reading = read(visible.sizes->angle, nav::kTenth_rad);
  ShownHologram& offset = add(frame, HologramKind::kNumbers);
  append_offset(offset.text, visible.sizes->offset);
  offset.reading = read(visible.sizes->offset, nav::kTenth_m);
}

void ShownFrameWriter::write_wire(const PlacedScrew& screw, const Visibility& visible,
                                  ShownFrame& frame) {
  if (!visible.wire) {
    return;
  }
  const TrajectoryLine placed = line_of(*visible.wire, screw);
  ShownHologram& wire = add(frame, HologramKind::kTrajectory);
  append_wire(wire.text, *visible.wire);
  wire.points_in_world = {placed.outside, placed.entry, placed.target};
}

void ShownFrameWriter::write_screw(const PlacedScrew& screw, const Visibility& visible,
                                   ShownFrame& frame) {
  const TrajectoryLine line = trajectory_of(screw);
  add(frame, HologramKind::kTrajectory).points_in_world = {line.outside, line.entry, line.target};
  write_wire(screw, visible, frame);
  if (visible.triangle) {
    const nav::ScrewGuidance& shown = *visible.triangle;
    add(frame, HologramKind::kTriangle).points_in_world = {shown.a, shown.b, shown.c};
  }
  if (visible.approach) {
    ShownHologram& tip = add(frame, HologramKind::kDepth);
    append_rounded_mm(tip.text, visible.approach->distance_m);
    tip.points_in_world.push_back(visible.approach->tip);
  }
  if (visible.twin) {
    const VirtualTwin twin = twin_of(screw);
    ShownHologram& shown = add(frame, HologramKind::kTwin);
    for (const Point<World>& place : {line.entry, line.target}) {
      shown.points_in_world.push_back(to_point(in_twin(twin, to_float3(place.v))));
    }
  }
  if (!visible.cross) {
    if (visible.measurement || visible.angle_lost) {
      const auto angle_rad =
          visible.measurement ? std::optional(visible.measurement->angle_rad) : std::nullopt;
      ShownHologram& angle = add(frame, HologramKind::kAngle);
      angle.text = angle_text(angle_rad);
      angle.reading = read_angle_rad(angle_rad);
    }
    return;
  }
  write_cross(screw, visible, frame);
  if (visible.sizes != nullptr || visible.angle_lost) {
    write_sizes(visible, frame);
  }
  if (visible.depth) {
    append_depth(add(frame, HologramKind::kDepth).text, *visible.depth);
  }
  if (visible.numbers) {
    write_numbers(*visible.numbers, screw.plan().side, frame);
    if (visible.clearance) {
      append_clearance_line(add(frame, HologramKind::kNumbers).text, *visible.clearance,
                            screw.at.level->registration_only());
    }
  }
}

void ShownFrameWriter::write_numbers(const nav::ScrewNumbers& numbers, nav::Side side,
                                     ShownFrame& frame) {
  for (std::size_t i = 0; i < kNumberRows; ++i) {
    const auto row = static_cast<NumberRow>(i);
    ShownHologram& shown = add(frame, HologramKind::kNumbers);
    shown.side = side;
    append_number(shown.text, numbers, row);
  }
}

void ShownFrameWriter::write_rods(const Guidance& guidance, ShownFrame& frame) {
  for (const RodState& rod : guidance.rods) {
    if (!rod.visible()) {
      continue;
    }
    const Vec3 offset = rod_offset_m(guidance, rod);
    ShownHologram& hologram = add(frame, HologramKind::kRod);
    for (const Point<World>& head : rod.heads) {
      hologram.points_in_world.push_back(head + offset);
    }
  }
}

void ShownFrameWriter::write_status(const Guidance& guidance, const Visibility& visible,
                                    ShownFrame& frame) {
  const StatusLine& line = guidance.status;
  if (!frame.status) {
    frame.status.emplace();
  }
  ShownStatus& status = *frame.status;
  status.at = line.at;
  status.notice = line.message ? notice_of(*line.message) : Notice::kNone;
  status.checks = checks_asked(line);
  const auto* strokes = std::get_if<StrokesSoFar>(&line.state);
  status.strokes_enough = strokes != nullptr && strokes->coaching && strokes->coaching->enough;
  status.text.clear();
  append_without_heard(status.text, line);
  constexpr std::string_view kSeparator = " | ";
  if (status.text.find(kSeparator) == std::string::npos) {
    const std::size_t end = status.text.size();
    status.text += kSeparator;
    append_next_act(status.text, guidance, visible);
    if (status.text.size() == end + kSeparator.size()) {
      status.text.resize(end);
    }
  }
  status.heard.clear();
  if (line.heard) {
    append_heard(status.heard, *line.heard);
  }
}

}  // namespace orthonav::engine
