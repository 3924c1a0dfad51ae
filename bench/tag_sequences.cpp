#include "bench/tag_sequences.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "bench/tag_bound.h"
#include "bench/tag_pixels.h"
#include "bench/tag_stage.h"

namespace orthonav::bench {
namespace {

constexpr double kPairS = 1.0 / 30.0;

void expose(const GreyImage& clean, const TagKind& kind, Random& random, GreyImage& out) {
  out = clean;
  for (std::uint8_t& grey : out.pixels) {
    const double light = kind.light * grey;
    const double noisy =
        light + std::sqrt(kind.shot * light + kind.read * kind.read) * random.normal();
    grey = static_cast<std::uint8_t>(std::clamp(noisy + 0.5, 0.0, 255.0));
  }
}

double hidden_fraction(const GreyImage& with, const GreyImage& without, const CameraModel& camera,
                       const auto& camera_from_rig, const Transform<Rig, Marker>& pose) {
  double all = 0.0;
  double hidden = 0.0;
  each_pixel(camera, camera_from_rig, pose, 0.5 * kTagM, [&](std::size_t i) {
    all += 1.0;
    hidden += std::abs(int(with.pixels[i]) - int(without.pixels[i])) > 3 ? 1.0 : 0.0;
  });
  return all > 0.0 ? hidden / all : 1.0;
}

std::array<double, 2> visible_fractions(TagStage& stage, double t, const StereoFrame& clean,
                                        const Transform<Rig, Marker>& pose) {
  if (!stage.kind().hand) {
    return {1.0, 1.0};
  }
  std::vector<sim::RoomState> states = stage.exposure(t);
  for (sim::RoomState& state : states) {
    state.hand.reset();
  }
  StereoFrame without_hand;
  stage.render(states, without_hand);
  const StereoCalibration& c = stage.calibration();
  return {1.0 - hidden_fraction(clean.left, without_hand.left, c.left, c.left_from_rig, pose),
          1.0 - hidden_fraction(clean.right, without_hand.right, c.right, c.right_from_rig, pose)};
}

std::vector<nav::ToolGeometry> tools_of(const sim::RoomDescription& room) {
  std::vector<nav::ToolGeometry> tools;
  for (const sim::RoomTool& tool : room.tools) {
    nav::ToolGeometry geometry;
    geometry.name = tool.name;
    geometry.role = tool.id == 3 ? nav::ToolRole::kPointer : nav::ToolRole::kGuide;
    geometry.marker = {"tag36h11", tool.id, kTagM};
    geometry.tip_in_marker = tool.tip_in_marker;
    tools.push_back(geometry);
  }
  return tools;
}

}  // namespace

std::vector<std::string> sequence_names() { return {"moving", "still", "fast", "dim", "occluded"}; }

Sequence make_sequence(const std::string& name, int pairs, std::uint64_t seed) {
  const TagKind kind = tag_kind_of(name);
  TagStage stage(kind, seed);
  Sequence out;
  out.name = name;
  out.calibration = stage.calibration();
  out.tools = tools_of(tag_room());
  Random random(seed);
  for (int k = 0; k < pairs; ++k) {
    const double t = k * kPairS;
    const std::vector<sim::RoomState> states = stage.exposure(t);
    const sim::RoomState middle = stage.at(t);
    StereoFrame clean;
    clean.sequence = k;
    clean.time = middle.time;
    const auto rig_from_room = middle.room_from_rig.inverse();
    clean.world_from_rig =
        Transform<World, Rig>(middle.room_from_rig.rotation(), middle.room_from_rig.translation());
    stage.render(states, clean);
    StereoFrame frame = clean;
    expose(clean.left, kind, random, frame.left);
    expose(clean.right, kind, random, frame.right);
    out.rig_from_marker.emplace_back();
    out.visible.emplace_back();
    for (const auto& room_from_marker : middle.room_from_marker) {
      out.rig_from_marker.back().push_back(rig_from_room * room_from_marker);
      out.visible.back().push_back(
          visible_fractions(stage, t, clean, out.rig_from_marker.back().back()));
    }
    out.frames.push_back(std::move(frame));
  }
  out.bound = [kind, calibration = out.calibration, poses = out.rig_from_marker](std::size_t pair,
                                                                                 std::size_t tool) {
    return cramer_rao_bound(kind, calibration, poses[pair][tool], tool);
  };
  return out;
}

}  // namespace orthonav::bench
