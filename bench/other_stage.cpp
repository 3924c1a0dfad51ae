#include "bench/other_stage.h"

#include <cmath>
#include <numbers>

namespace orthonav::bench {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kBaselineM = 0.10;
constexpr double kDegree = std::numbers::pi / 180.0;

Lens lens(bool large, bool right) {
  const double scale = large ? 1.0 : 0.5;
  Lens lens{static_cast<int>(1280 * scale), static_cast<int>(960 * scale)};
  lens.f_px = scale * (right ? 893.0 : 900.0);
  lens.centre_px = scale * (right ? Vec2{628.6, 490.3} : Vec2{651.2, 471.8});
  lens.k1 = right ? -0.115 : -0.130;
  lens.k2 = right ? 0.035 : 0.050;
  lens.p1 = right ? -0.0006 : 0.0008;
  lens.p2 = right ? 0.0009 : -0.0005;
  return lens;
}

/// The rig's x points right, y up, z back, its origin lies between the cameras.
Transform<LeftCamera, Rig> placed(bool right) {
  const Mat3 axes{{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
  const Mat3 rotation =
      rotation_from_vector(right ? Vec3{-0.012, -0.035, 0.021} : Vec3{0.008, 0.028, -0.013}) * axes;
  const Vec3 place{right ? 0.5 * kBaselineM : -0.5 * kBaselineM, right ? 0.0012 : 0.0, 0.0};
  return {rotation, -(rotation * place)};
}

std::vector<OtherKind> kinds() {
  std::vector<OtherKind> kinds(11);
  std::size_t i = 0;
  const auto next = [&](const char* name) -> OtherKind& {
    kinds[i].name = name;
    return kinds[i++];
  };
  OtherKind& sharp = next("sharp");
  sharp.optics = {Blur::kNone, 0.0, 0.1};
  sharp.exposure_s = 0.001;
  OtherKind& defocus = next("defocus");
  defocus.optics = {Blur::kDisk, 1.5, 0.25};
  defocus.distance_m = 0.50;
  OtherKind& gamma = next("gamma");
  gamma.large = false;
  gamma.tag_m = 0.050;
  gamma.optics = {Blur::kGaussian, 0.6, 0.3};
  gamma.sensor.response = Response::kGamma;
  OtherKind& far = next("far");
  far.large = false;
  far.tag_m = 0.080;
  far.distance_m = 0.80;
  far.sensor = {Response::kS, 5000.0, 15.0, 0};
  OtherKind& oblique = next("oblique");
  oblique.optics = {Blur::kDisk, 1.0, 0.25};
  oblique.exposure_s = 0.002;
  oblique.least_tilt_rad = 15.0 * kDegree;
  oblique.largest_tilt_rad = 65.0 * kDegree;
  OtherKind& small = next("small");
  small.tag_m = 0.020;
  small.sensor = {Response::kLinear, 3000.0, 15.0, 0};
  OtherKind& motion = next("motion");
  motion.large = false;
  motion.tag_m = 0.060;
  motion.distance_m = 0.50;
  motion.optics = {Blur::kGaussian, 0.5, 0.25};
  motion.exposure_s = 0.010;
  motion.speed = 3.0;
  OtherKind& finger = next("finger");
  finger.finger_m = 0.008;
  finger.sensor.response = Response::kS;
  OtherKind& hidden = next("hidden");
  hidden.large = false;
  hidden.tag_m = 0.050;
  hidden.finger_m = 0.040;
  OtherKind& highlight = next("highlight");
  highlight.large = false;
  highlight.tag_m = 0.060;
  highlight.optics = {Blur::kGaussian, 0.7, 0.3};
  highlight.lighting.lamp = {{0.10, 0.25, 0.20}};
  highlight.lighting.highlight = 0.8;
  highlight.lighting.gloss_rad = 0.03;
  highlight.sensor.response = Response::kGamma;
  OtherKind& jpeg = next("jpeg");
  jpeg.large = false;
  jpeg.tag_m = 0.050;
  jpeg.sensor.jpeg_quality = 85;
  return kinds;
}

}  // namespace

const std::vector<OtherKind>& other_kinds() {
  static const std::vector<OtherKind> all = kinds();
  return all;
}

OtherStage::OtherStage(const OtherKind& kind, std::uint64_t seed)
    : kind_(kind),
      rays_{RayGrid(lens(kind.large, false)), RayGrid(lens(kind.large, true))},
      camera_from_rig_{placed(false), placed(true)},
      tags_{PrintedTag{3, kind.tag_m, 1.25}, PrintedTag{5, kind.tag_m, 1.6}} {
  Random random = Random(seed).fork(kind.name);
  for (auto& axis : phases_) {
    for (double& phase : axis) {
      phase = random.uniform(0.0, kTurn);
    }
  }
}

double OtherStage::wander(std::size_t axis, double t) const {
  constexpr std::array<double, 3> kHz{0.19, 0.43, 0.83};
  constexpr std::array<double, 3> kFraction{0.45, 0.35, 0.20};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += kFraction[i] * std::sin(kTurn * kHz[i] * t + phases_[axis][i]);
  }
  return sum;
}

Transform<World, Marker> OtherStage::tool_at(std::size_t tool, double t) const {
  const double time = kind_.speed * t;
  const auto w = [&](std::size_t axis) { return wander(6 + 7 * tool + axis, time); };
  const double side = tool == 0 ? -1.0 : 1.0;
  const double apart = std::max(0.06, 1.1 * kind_.tag_m);
  const Vec3 place{apart * side + 0.025 * w(0), 0.03 * w(1), -kind_.distance_m + 0.04 * w(2)};
  // Upright and facing the rig, then tilted about an axis in its own plane, then rotated in that
  // plane.
  const Vec3 z = (-place).normalized();
  const Vec3 x = Vec3{0, 1, 0}.cross(z).normalized();
  const Mat3 facing = Mat3::from_columns(x, z.cross(x), z);
  const double middle = 0.5 * (kind_.least_tilt_rad + kind_.largest_tilt_rad);
  const double swing = 0.5 * (kind_.largest_tilt_rad - kind_.least_tilt_rad);
  const double lean = middle + swing * std::sin(kTurn * (0.21 * time + 0.3 * side) + w(3));
  const double axis = side + 2.5 * w(4) + 0.3 * time;
  const Mat3 leaning = rotation_from_vector(lean * Vec3{std::cos(axis), std::sin(axis), 0.0});
  const Mat3 rotated = rotation_from_vector({0.0, 0.0, 0.5 * side + 0.4 * w(5)});
  return {facing * leaning * rotated, place};
}

Moment OtherStage::at(double t) const {
  Moment moment;
  moment.world_from_rig = {
      rotation_from_vector(0.02 * Vec3{wander(0, t), wander(1, t), wander(2, t)}),
      0.012 * Vec3{wander(3, t), wander(4, t), wander(5, t)}};
  for (std::size_t tool = 0; tool < 2; ++tool) {
    moment.world_from_marker.push_back(tool_at(tool, t));
  }
  if (kind_.finger_m > 0.0) {
    // Moves in from the side to the tag's far edge and back, a finger's thickness in front of it.
    const double reach = 0.9 * (kind_.tag_m + kind_.finger_m) * std::sin(kTurn * 0.7 * t);
    const auto& tag = moment.world_from_marker[0];
    const Vec3 tip{-0.2 * kind_.tag_m + reach, 0.1 * kind_.tag_m, 1.5 * kind_.finger_m};
    moment.finger = Finger{tag * Point<Marker>{tip},
                           tag * Point<Marker>{tip + Vec3{-0.10, -0.05, 0.03}}, kind_.finger_m};
  }
  return moment;
}

std::vector<Moment> OtherStage::exposure(double t) const {
  const int count = 1 + 2 * static_cast<int>(std::lround(500.0 * kind_.exposure_s));
  std::vector<Moment> moments;
  for (int i = 0; i < count; ++i) {
    moments.push_back(at(t + kind_.exposure_s * ((i + 0.5) / count - 0.5)));
  }
  return moments;
}

StereoCalibration OtherStage::calibration() const {
  return {reported(rays_[0].lens()), reported(rays_[1].lens()), camera_from_rig_[0],
          Transform<RightCamera, Rig>(camera_from_rig_[1].rotation(),
                                      camera_from_rig_[1].translation())};
}

}  // namespace orthonav::bench
