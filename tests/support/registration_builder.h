#pragma once

#include <memory>
#include <vector>

#include "nav/registration/registration.h"
#include "tests/support/anatomy.h"

namespace orthonav::test {

/// The error of a noisy pointer: 0.9 mm (standard deviation, each axis).
inline constexpr double kPointerNoise_m = 0.0009;

/// A vertebra somewhere in the world, and the points digitized on it.
struct Digitization {
  Transform<World, Vertebra> truth;
  std::vector<Point<World>> points;
};

/// Strokes on a level in any place and orientation, with noise.
inline Digitization digitized(const AnatomyLevel& level, std::uint64_t seed,
                              const StrokeRegions& regions = {}, double noise_m = kPointerNoise_m) {
  Random random(seed);
  Digitization d;
  const std::vector<Vec3> tips = strokes(level, regions, random);
  d.truth = {random_rotation(random),
             {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}};
  for (const Vec3& tip : tips) {
    const Vec3 noise{random.normal(0, noise_m), random.normal(0, noise_m),
                     random.normal(0, noise_m)};
    d.points.push_back(d.truth * Point<Vertebra>{tip + noise});
  }
  return d;
}

/// The largest error at the entries and targets of the plan.
inline double worst_screw_error_m(const AnatomyLevel& level, const Transform<World, Vertebra>& pose,
                                  const Transform<World, Vertebra>& truth) {
  double worst_m = 0.0;
  for (const nav::ScrewPlan& screw : level.screws) {
    for (const Point<Vertebra>& p : {screw.entry, screw.target}) {
      worst_m = std::max(worst_m, (pose * p - truth * p).norm());
    }
  }
  return worst_m;
}

}  // namespace orthonav::test
