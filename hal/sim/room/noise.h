#pragma once

#include <array>
#include <vector>

#include "base/random.h"
#include "base/transform.h"

namespace orthonav::sim {

/// A smooth random function of one variable (seconds, metres) that can be read anywhere, in any
/// order: a sum of sines with random phases, one in each slice of the band (Shinozuka 1971).
/// Stationary, with the given SD over its length.
class SmoothNoise {
 public:
  SmoothNoise() = default;  ///< zero everywhere
  /// The band is in cycles per unit of the variable.
  SmoothNoise(Random random, double sd, double lowest, double highest);
  [[nodiscard]] double at(double x) const;

 private:
  static constexpr std::size_t kWaves = 12;
  double amplitude_ = 0.0;
  std::array<double, kWaves> rate_{};
  std::array<double, kWaves> phase_{};
};

/// Three independent ones.
class SmoothNoise3 {
 public:
  SmoothNoise3() = default;
  SmoothNoise3(const Random& random, double sd, double lowest, double highest);
  [[nodiscard]] Vec3 at(double x) const;

 private:
  std::array<SmoothNoise, 3> axes_;
};

/// Three independent standard normals times `sd`.
[[nodiscard]] Vec3 normal_vector(Random& random, double sd);

/// Corrections of a map, each within a second.
struct MapSteps {
  double sd_m = 0.0;
  double per_min = 0.0;
};

/// The drift of a headset's map: a random walk in position and rotation with a node every second,
/// linear in between, and an occasional step within a second. Starts at zero.
class MapDrift {
 public:
  MapDrift(Random random, double m_per_sqrt_s, double rad_per_sqrt_s, double length_s,
           const MapSteps& steps = {});
  struct Offset {
    Vec3 translation_m;
    Vec3 rotation_rad;
  };
  [[nodiscard]] Offset at(double time_s) const;

 private:
  std::vector<Offset> nodes_;
};

}  // namespace orthonav::sim
