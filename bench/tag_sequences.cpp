#include "bench/tag_sequences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "hal/sim/hololens2.h"
#include "hal/sim/room_renderer.h"

namespace orthonav::bench {
namespace {

constexpr double kTagM = 0.040;
constexpr double kTipM = 0.150;
constexpr double kDistanceM = 0.45;
constexpr double kPairS = 1.0 / 30.0;
constexpr double kExposureS = 0.004;
constexpr int kMoments = 5;

struct Kind {
  double speed = 1.0;  ///< of the hand; 1: about 0.15 m/s and 0.9 rad/s RMS
  double light = 1.0;
  double shot = 0.1;
  double read = 1.0;
  bool hand = false;
};

Kind kind_of(const std::string& name) {
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

/// A smooth motion without a noticeable period: three sines per axis.
struct Wander {
  std::array<std::array<double, 3>, 6> phase{};
  explicit Wander(Random random) {
    for (auto& axis : phase) {
      for (double& p : axis) {
        p = random.uniform(0.0, 2.0 * std::numbers::pi);
      }
    }
  }
  [[nodiscard]] double at(std::size_t axis, double t) const {
    constexpr std::array<double, 3> kHz{0.31, 0.57, 0.93};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += std::sin(2.0 * std::numbers::pi * kHz[i] * t + phase[axis][i]);
    }
    return sum / 3.0;
  }
};

sim::RoomDescription room() {
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

class Stage {
 public:
  Stage(const Kind& kind, std::uint64_t seed)
      : kind_(kind),
        head_(Random(seed).fork("head")),
        hands_{Wander(Random(seed).fork("pointer")), Wander(Random(seed).fork("guide"))} {
    sim::ErrorModel error_model = sim::ErrorModel::perfect();
    error_model.blur_sigma_px = 0.7;
    error_model.vignetting = 0.3;
    renderer_ = sim::RoomRenderer::create(room(), error_model);
  }

  [[nodiscard]] sim::RoomState at(double t) const {
    sim::RoomState state;
    state.time = Timestamp(from_seconds(t + 1.0));
    // The rig looks down at 45°; its z axis points backwards.
    const double down = -0.8 + 0.03 * head_.at(3, 0.4 * t);
    const Mat3 rotation = rotation_from_vector({0.0, 0.03 * head_.at(4, 0.4 * t), 0.0}) *
                          rotation_from_vector({down, 0.0, 0.0});
    state.room_from_rig = {
        rotation, Vec3{0.0, 0.60, 0.33} + 0.012 * Vec3{head_.at(0, 0.4 * t), head_.at(1, 0.4 * t),
                                                       head_.at(2, 0.4 * t)}};
    const Transform<sim::Room, Rig> middle(rotation_from_vector({-0.8, 0.0, 0.0}),
                                           {0.0, 0.60, 0.33});
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

  void render(std::span<const sim::RoomState> states, StereoFrame& frame) {
    renderer_->render(states, calibration_.left, calibration_.left_from_rig, 1, frame.left);
    renderer_->render(states, calibration_.right, as_camera(calibration_.right_from_rig), 2,
                      frame.right);
  }

  [[nodiscard]] std::vector<sim::RoomState> exposure(double t) const {
    std::vector<sim::RoomState> states;
    for (int i = 0; i < kMoments; ++i) {
      states.push_back(at(t + kExposureS * ((i + 0.5) / kMoments - 0.5)));
    }
    return states;
  }
  [[nodiscard]] const StereoCalibration& calibration() const { return calibration_; }
  [[nodiscard]] const Kind& kind() const { return kind_; }

 private:
  Kind kind_;
  Wander head_;
  std::array<Wander, 2> hands_;
  StereoCalibration calibration_ = sim::hololens2_calibration();
  std::unique_ptr<sim::RoomRenderer> renderer_;
};

void expose(const GreyImage& clean, const Kind& kind, Random& random, GreyImage& out) {
  out = clean;
  for (std::uint8_t& grey : out.pixels) {
    const double light = kind.light * grey;
    const double noisy =
        light + std::sqrt(kind.shot * light + kind.read * kind.read) * random.normal();
    grey = static_cast<std::uint8_t>(std::clamp(noisy + 0.5, 0.0, 255.0));
  }
}

/// Pixels of a tag's square in an image, by a callback.
template <class CameraFrame, class Visit>
void each_pixel(const CameraModel& camera, const Transform<CameraFrame, Rig>& camera_from_rig,
                const Transform<Rig, Marker>& rig_from_marker, double half_m, const Visit& visit) {
  const auto eye = (camera_from_rig * rig_from_marker).inverse();
  for (int y = 0; y < camera.height_px(); ++y) {
    for (int x = 0; x < camera.width_px(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y * camera.width_px() + x);
      const Vec2 ray = camera.lookup()[i];
      if (std::isnan(ray.x)) {
        continue;
      }
      const Vec3 d = eye.rotation() * Vec3{ray.x, ray.y, 1.0};
      const double along = -eye.translation().z / d.z;
      const Vec3 p = eye.translation() + along * d;
      if (along > 0.0 && std::abs(p.x) < half_m && std::abs(p.y) < half_m) {
        visit(i);
      }
    }
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

std::array<double, 2> visible_fractions(Stage& stage, double t, const StereoFrame& clean,
                                        const Transform<Rig, Marker>& pose) {
  if (!stage.kind().hand) {
    return {1.0, 1.0};
  }
  std::vector<sim::RoomState> states = stage.exposure(t);
  for (sim::RoomState& state : states) {
    state.hand.reset();
  }
  StereoFrame unstroked;
  stage.render(states, unstroked);
  const StereoCalibration& c = stage.calibration();
  return {1.0 - hidden_fraction(clean.left, unstroked.left, c.left, c.left_from_rig, pose),
          1.0 - hidden_fraction(clean.right, unstroked.right, c.right, c.right_from_rig, pose)};
}

std::array<double, 36> cramer_rao_bound(const Kind& kind, const StereoCalibration& calibration,
                                        const Transform<Rig, Marker>& pose, std::size_t tool) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  sim::ErrorModel error_model = sim::ErrorModel::perfect();
  error_model.blur_sigma_px = 0.7;
  const auto renderer = sim::RoomRenderer::create(room(), error_model);
  sim::RoomState state;
  state.room_from_marker.assign(2, {});
  state.tool_present = {tool == 0, tool == 1};
  // About half a pixel: greys are whole numbers.
  constexpr double kStep = 0.0006;
  const auto drawn = [&](std::size_t axis, double sign) {
    std::array<double, 6> step{};
    step[axis] = sign * (axis < 3 ? kStep : kStep / 0.02);
    const Transform<Marker, Marker> moved(rotation_from_vector({step[3], step[4], step[5]}),
                                          {step[0], step[1], step[2]});
    const Transform<Rig, Marker> there = pose * moved;
    state.room_from_marker[tool] = {there.rotation(), there.translation()};
    StereoFrame frame;
    const std::vector<sim::RoomState> states(1, state);
    const StereoCalibration& c = calibration;
    renderer->render(states, c.left, c.left_from_rig, 1, frame.left);
    renderer->render(states, c.right, as_camera(c.right_from_rig), 1, frame.right);
    return frame;
  };
  std::array<StereoFrame, 6> ahead;
  std::array<StereoFrame, 6> behind;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    ahead[axis] = drawn(axis, 1.0);
    behind[axis] = drawn(axis, -1.0);
  }
  Matrix6 information = Matrix6::Zero();
  const auto gather = [&](const GreyImage StereoFrame::*side, const CameraModel& camera,
                          const auto& camera_from_rig) {
    each_pixel(camera, camera_from_rig, pose, 0.5 * kTagM * 10.0 / 8.0, [&](std::size_t i) {
      Eigen::Matrix<double, 6, 1> slope;
      double light = 0.0;
      for (std::size_t axis = 0; axis < 6; ++axis) {
        const double a = (ahead[axis].*side).pixels[i];
        const double b = (behind[axis].*side).pixels[i];
        slope(static_cast<Eigen::Index>(axis)) =
            kind.light * (a - b) / (2.0 * (axis < 3 ? kStep : kStep / 0.02));
        light += kind.light * (a + b) / 12.0;
      }
      const double variance = kind.shot * light + kind.read * kind.read + 1.0 / 12.0;
      information += slope * slope.transpose() / variance;
    });
  };
  gather(&StereoFrame::left, calibration.left, calibration.left_from_rig);
  gather(&StereoFrame::right, calibration.right, calibration.right_from_rig);
  const Matrix6 bound = information.inverse();
  std::array<double, 36> out;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) {
      out[static_cast<std::size_t>(6 * r + c)] = bound(r, c);
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> sequence_names() { return {"moving", "still", "fast", "dim", "occluded"}; }

Sequence make_sequence(const std::string& name, int pairs, std::uint64_t seed) {
  const Kind kind = kind_of(name);
  Stage stage(kind, seed);
  Sequence out;
  out.name = name;
  out.calibration = stage.calibration();
  for (const sim::RoomTool& tool : room().tools) {
    nav::ToolGeometry geometry;
    geometry.name = tool.name;
    geometry.role = tool.id == 3 ? nav::ToolRole::kPointer : nav::ToolRole::kGuide;
    geometry.marker = {"tag36h11", tool.id, kTagM};
    geometry.tip_in_marker = tool.tip_in_marker;
    out.tools.push_back(geometry);
  }
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
