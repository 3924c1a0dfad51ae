#include "hal/sim/cameras/depth_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"

namespace orthonav::sim {
namespace {

/// The light that a material returns, and how far behind its surface it appears: light that enters
/// it returns late, most of all in translucent material.
struct Return {
  double albedo = 0.0;
  double bias_m = 0.0;
};
constexpr std::array<Return, 10> kReturns = {{
    {0.0, 0.0},     // nothing
    {0.40, 0.004},  // floor
    {0.45, 0.005},  // drape
    {0.55, 0.008},  // skin
    {0.25, 0.009},  // tissue, wet
    {0.60, 0.007},  // bone
    {0.80, 0.003},  // paper
    {0.30, 0.004},  // metal
    {0.30, 0.005},  // plastic
    {0.65, 0.006},  // glove
}};
/// Long throw's mean over-estimate is 9.0 mm where AHaT's is 5.7 mm.
constexpr double kLongThrowBias = 9.0 / 5.7;
constexpr double kReferenceM = 0.5;
/// Grazing light: 1/cos is limited to this.
constexpr double kMaxOblique = 3.0;
/// Less light than this gives no measurement.
constexpr double kDarkest = 0.004;
/// Below this much light, the noise grows from its bright to its dim SD.
constexpr double kBright = 0.5;
/// A step of this much between neighbours is an edge.
constexpr double kEdgeM = 0.015;
/// The device's unit of brightness.
constexpr double kBrightnessUnit = 2000.0;
constexpr double kMaxBrightness = 60000.0;

/// The surroundings of a pixel: the normal of its surface, and whether an edge runs through it.
struct Around {
  double cosine = 1.0;
  float across_m = 0.0F;  ///< the range beyond the edge; 0: there is none
};

class Neighbourhood {
 public:
  Neighbourhood(const DepthCalibration& camera, const std::vector<DepthSight>& sights)
      : camera_(camera), sights_(sights) {}

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] Around around(int x, int y) const {
    const float here_m = sights_[index(x, y)].range_m;
    Around found;
    const int left = std::max(x - 1, 0);
    const int right = std::min(x + 1, camera_.width_px - 1);
    const int above = std::max(y - 1, 0);
    const int below = std::min(y + 1, camera_.height_px - 1);
    for (const std::size_t i :
         {index(left, y), index(right, y), index(x, above), index(x, below)}) {
      const float there_m = sights_[i].range_m;
      if (there_m > 0.0F && std::abs(there_m - here_m) > kEdgeM) {
        found.across_m = there_m;
        return found;
      }
    }
    const Vec3 across = point(right, y) - point(left, y);
    const Vec3 down = point(x, below) - point(x, above);
    const Vec3 normal = across.cross(down);
    const double length = normal.norm();
    const auto& ray = camera_.rays[index(x, y)];
    if (length > 0.0) {
      found.cosine = std::abs(normal.dot({ray[0], ray[1], ray[2]})) / length;
    }
    return found;
  }

 private:
  [[nodiscard]] Vec3 point(int x, int y) const {
    const std::size_t i = index(x, y);
    const auto& ray = camera_.rays[i];
    return static_cast<double>(sights_[i].range_m) * Vec3{ray[0], ray[1], ray[2]};
  }
  const DepthCalibration& camera_;
  const std::vector<DepthSight>& sights_;
};

}  // namespace

DepthSensorErrors::Returned DepthSensorErrors::returned(const DepthSight& sight,
                                                        double cosine) const {
  const Return& material = kReturns[static_cast<std::size_t>(sight.material)];
  const double oblique = 1.0 / std::max(cosine, 1.0 / kMaxOblique);
  const double bias_m = errors_.bias * material.bias_m * oblique *
                        (model_.stream == DepthStream::kLongThrow ? kLongThrowBias : 1.0);
  const double range_m = static_cast<double>(sight.range_m);
  const double near = kReferenceM / range_m;
  return {range_m + bias_m, material.albedo / 0.8 * cosine * near * near};
}

void DepthSensorErrors::measure(const DepthCalibration& calibration,
                                const std::vector<DepthSight>& sights, std::uint64_t seed,
                                DepthFrame& frame) const {
  frame.range_mm = DepthImage(calibration.width_px, calibration.height_px);
  frame.brightness = DepthImage(calibration.width_px, calibration.height_px);
  const Neighbourhood neighbourhood(calibration, sights);
  Random random(seed);
  for (int y = 0; y < calibration.height_px; ++y) {
    for (int x = 0; x < calibration.width_px; ++x) {
      const DepthSight& sight = sights[neighbourhood.index(x, y)];
      if (sight.range_m <= 0.0F || static_cast<double>(sight.range_m) > model_.farthest_m) {
        continue;
      }
      const Around around = neighbourhood.around(x, y);
      auto [range_m, light] = returned(sight, around.cosine);
      if (around.across_m > 0.0F && random.uniform() < errors_.flying) {
        range_m += random.uniform() * (static_cast<double>(around.across_m) - range_m);
      }
      const double dim = 1.0 - std::min(light / kBright, 1.0);
      range_m +=
          random.normal(0.0, errors_.sd_bright_m + dim * (errors_.sd_dim_m - errors_.sd_bright_m));
      const bool lost = sight.material == Material::kMetal && random.uniform() < errors_.metal_lost;
      if (model_.wraps_at_m > 0.0) {
        range_m = std::fmod(range_m, model_.wraps_at_m);
      }
      const double mm = std::floor(1e3 * range_m + 0.5);
      if (lost || light < kDarkest || !(mm >= 1.0 && mm <= 65535.0)) {
        continue;
      }
      frame.range_mm.at(x, y) = static_cast<std::uint16_t>(mm);
      frame.brightness.at(x, y) =
          static_cast<std::uint16_t>(std::min(kBrightnessUnit * light, kMaxBrightness));
    }
  }
}

}  // namespace orthonav::sim
