#include "tests/support/accuracy_track.h"

#include <cmath>
#include <numbers>

namespace orthonav::test {
namespace {

using Pose = Transform<World, Marker>;

const Vec3 kDimple{0.10, -0.35, -0.40};
const Vec3 kBoardOrigin{-0.15, -0.36, -0.45};
const Vec3 kAside{0.30, -0.30, -0.30};
constexpr double kMoving_s = 0.6;

/// Writes poses moment by moment.
class Writer {
 public:
  explicit Writer(const AccuracyTrackOptions& options) : options_(options), random_(options.seed) {}

  void pose(Vec3 tip_m, const Mat3& rotation) {
    const double p = options_.position_noise_m;
    const double r = options_.rotation_noise_rad;
    const Vec3 rotation_vector{random_.normal(0, r), random_.normal(0, r), random_.normal(0, r)};
    const Vec3 offset{random_.normal(0, p), random_.normal(0, p), random_.normal(0, p)};
    const Vec3 true_tip_m = options_.tip_m + options_.tip_error_m;
    nav::TrackedPose out;
    // The tracker has errors in the tag's position and rotation.
    out.value = Pose(rotation_from_vector(rotation_vector) * rotation,
                     tip_m - rotation * true_tip_m + offset);
    out.time = Timestamp(from_seconds(10.0 + static_cast<double>(count_++) / options_.rate_hz));
    out.status = PoseStatus::kMeasured;
    for (std::size_t i = 0; i < 3; ++i) {
      out.covariance[7 * i] = p * p;
      out.covariance[7 * (i + 3)] = r * r;
    }
    poses_.push_back(out);
    tip_m_ = tip_m;
  }
  void move_to(Vec3 to_m) {
    const Vec3 from_m = tip_m_;
    const int steps = count_of(kMoving_s);
    for (int i = 1; i <= steps; ++i) {
      // Slow at both ends, and over a little arch.
      const double fraction = 0.5 - 0.5 * std::cos(std::numbers::pi * i / steps);
      const double lift_m = 0.03 * std::sin(std::numbers::pi * i / steps);
      pose(from_m + fraction * (to_m - from_m) + Vec3{0, lift_m, 0}, held(0.02 * i));
    }
  }
  void rest(Vec3 at_m, double duration_s, Vec3 slip_m = {}) {
    const int steps = count_of(duration_s);
    for (int i = 0; i < steps; ++i) {
      pose(2 * i < steps ? at_m : at_m + slip_m, held(0.0));
    }
  }
  void turn(Vec3 at_m, Vec3 slip_m) {
    const int steps = count_of(options_.turning_s);
    for (int i = 0; i < steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const double around = 6.0 * std::numbers::pi * t;
      // Tilts from upright and back again.
      const double tilt = options_.tilt_rad * std::sin(std::numbers::pi * t);
      const Mat3 rotated = rotation_from_vector(
          {tilt * std::cos(around), 0.3 * std::sin(around), tilt * std::sin(around)});
      pose(2 * i < steps ? at_m : at_m + slip_m, rotated * held(0.0));
    }
  }
  [[nodiscard]] std::vector<nav::TrackedPose> take() { return std::move(poses_); }

 private:
  [[nodiscard]] int count_of(double duration_s) const {
    return static_cast<int>(std::lround(duration_s * options_.rate_hz));
  }
  static Mat3 held(double rotated) { return rotation_from_vector({0.2, 0.3 + rotated, -0.1}); }

  AccuracyTrackOptions options_;
  Random random_;
  Vec3 tip_m_{};
  int count_ = 0;
  std::vector<nav::TrackedPose> poses_;
};

}  // namespace

nav::ToolGeometry accuracy_pointer() {
  nav::ToolGeometry pointer;
  pointer.name = "pointer";
  pointer.marker = {"tag36h11", 3, 0.05};
  pointer.tip_in_marker = {AccuracyTrackOptions().tip_m};
  return pointer;
}

std::vector<Vec3> accuracy_board() {
  std::vector<Vec3> points;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      points.push_back({0.06 * column, 0.05 * (2 - row), 0.0});
    }
  }
  return points;
}

std::vector<nav::TrackedPose> accuracy_track(const AccuracyTrackOptions& options,
                                             const std::vector<Vec3>& touched) {
  Writer writer(options);
  writer.pose({0.1, -0.1, -0.3}, rotation_from_vector({0.2, 0.3, -0.1}));
  writer.move_to(kDimple);
  writer.rest(kDimple, options.still_s, options.slip_while_still_m);
  const Vec3 slipped = kDimple + options.slip_while_still_m;
  writer.turn(slipped, options.slip_while_turning_m);
  if (options.lay_aside) {
    writer.move_to(kAside);
    writer.rest(kAside, 2.0);
  }
  // The board lies on the table, turned a little.
  const Mat3 rotated = rotation_from_vector({-std::numbers::pi / 2, 0.0, 0.3});
  for (const Vec3& point : touched) {
    const Vec3 at_m = kBoardOrigin + rotated * (options.board_scale * point);
    writer.move_to(at_m);
    writer.rest(at_m, options.touch_s);
  }
  writer.move_to({0.0, -0.1, -0.3});
  return writer.take();
}

}  // namespace orthonav::test
