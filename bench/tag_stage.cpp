#include "bench/tag_stage.h"

#include <cmath>
#include <numbers>

namespace orthonav::bench {
namespace {

constexpr double kTipM = 0.150;
constexpr double kDistanceM = 0.45;
constexpr double kExposureS = 0.004;
constexpr int kMoments = 5;

}  // namespace

TagKind tag_kind_of(const std::string& name) {
  if (name == "still") {
    return {.speed = 0.0};
  }
  if (name == "fast") {
    return {.speed = 4.0};
  }
  if (name == "dim") {
    return {.light = 0.35, .shot = 0.15, .read = 2.0};
  }
  if (name == "occluded") {
    return {.hand = true};
  }
  return {};
}

Wander::Wander(Random random) {
  for (auto& axis : phase) {
    for (double& p : axis) {
      p = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
  }
}

double Wander::at(std::size_t axis, double t) const {
  constexpr std::array<double, 3> kHz{0.31, 0.57, 0.93};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += std::sin(2.0 * std::numbers::pi * kHz[i] * t + phase[axis][i]);
  }
  return sum / 3.0;
}

sim::RoomDescription tag_room() {
  sim::RoomDescription room;
  for (const int id : {3, 5}) {
    sim::RoomTool tool;
    tool.name = id == 3 ? "pointer" : "guide";
    tool.kind = id == 3 ? sim::ToolKind::kPointer : sim::ToolKind::kGuide;
    tool.id = id;
    tool.size_m = kTagM;
    tool.tip_in_marker = {{0.0, -kTipM, 0.0}};
    room.tools.push_back(tool);
  }
  return room;
}

Transform<LeftCamera, Rig> as_camera(const Transform<RightCamera, Rig>& right) {
  return {right.rotation(), right.translation()};
}

TagStage::TagStage(const TagKind& kind, std::uint64_t seed)
    : kind_(kind),
      head_(Random(seed).fork("head")),
      hands_{Wander(Random(seed).fork("pointer")), Wander(Random(seed).fork("guide"))} {
  sim::ErrorModel error_model = sim::ErrorModel::perfect();
  error_model.blur_sigma_px = 0.7;
  error_model.vignetting = 0.3;
  renderer_ = sim::RoomRenderer::create(tag_room(), error_model);
}

sim::RoomState TagStage::at(double t) const {
  sim::RoomState state;
  state.time = Timestamp(from_seconds(t + 1.0));
  // The rig looks down at 45°; its z axis points backwards.
  const double down = -0.8 + 0.03 * head_.at(3, 0.4 * t);
  const Mat3 rotation = rotation_from_vector({0.0, 0.03 * head_.at(4, 0.4 * t), 0.0}) *
                        rotation_from_vector({down, 0.0, 0.0});
  state.room_from_rig = {
      rotation, Vec3{0.0, 0.60, 0.33} +
                    0.012 * Vec3{head_.at(0, 0.4 * t), head_.at(1, 0.4 * t), head_.at(2, 0.4 * t)}};
  const Transform<sim::Room, Rig> middle(rotation_from_vector({-0.8, 0.0, 0.0}), {0.0, 0.60, 0.33});
  for (std::size_t i = 0; i < 2; ++i) {
    const double time = kind_.speed * t;
    const auto w = [&](std::size_t axis) { return hands_[i].at(axis, time); };
    const double side = i == 0 ? -1.0 : 1.0;
    const Vec3 place{0.07 * side + 0.05 + 0.035 * w(0), 0.02 + 0.035 * w(1),
                     -kDistanceM + 0.03 * w(2)};
    const Mat3 tilt = rotation_from_vector(
        Vec3{-0.25 + 0.2 * w(3), -0.2 * side + 0.2 * w(4), 0.3 * side + 0.25 * w(5)});
    state.room_from_marker.push_back(middle * Transform<Rig, Marker>(tilt, place));
    state.tool_present.push_back(true);
  }
  if (kind_.hand) {
    // A hand that wipes over the pointer's tag now and then.
    const double reach = 0.07 * std::sin(2.0 * std::numbers::pi * 0.45 * t);
    state.hand = state.room_from_marker[0] * Point<Marker>{{-0.045 + reach, 0.0, 0.05}};
    state.hand_axis = Vec3{-1.0, 0.2, 0.4}.normalized();
  }
  return state;
}

void TagStage::render(std::span<const sim::RoomState> states, StereoFrame& frame) {
  renderer_->render(states, calibration_.left, calibration_.left_from_rig, 1, frame.left);
  renderer_->render(states, calibration_.right, as_camera(calibration_.right_from_rig), 2,
                    frame.right);
}

std::vector<sim::RoomState> TagStage::exposure(double t) const {
  std::vector<sim::RoomState> states;
  for (int i = 0; i < kMoments; ++i) {
    states.push_back(at(t + kExposureS * ((i + 0.5) / kMoments - 0.5)));
  }
  return states;
}

}  // namespace orthonav::bench
