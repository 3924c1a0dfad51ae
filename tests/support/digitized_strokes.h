#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/geometry/mesh.h"
#include "tests/support/stroke_lanes.h"

namespace orthonav::test {

/// Good and bad strokes of a surgeon for a registration.
enum class StrokeVariant {
  kFull,      ///< all that can be reached from behind
  kPartial,   ///< only a part of it, which one the seed decides
  kNoisy,     ///< as full, the tracker errs by 0.9 mm along an axis and wanders
  kOutliers,  ///< as full, 12 % of the samples off the bone by up to 10 mm
  kSparse,    ///< 300 samples in a few short strokes
};
inline constexpr StrokeVariant kStrokeVariants[] = {StrokeVariant::kFull, StrokeVariant::kPartial,
                                                    StrokeVariant::kNoisy, StrokeVariant::kOutliers,
                                                    StrokeVariant::kSparse};
[[nodiscard]] const char* name_of(StrokeVariant variant);

/// The number of samples and their errors.
struct StrokeErrorModel {
  int fewest_samples = 1800;
  int most_samples = 2200;
  double white_noise_m = 0.0003;    ///< standard deviation along each axis, every sample anew
  double correlated_noise_m = 0.0;  ///< a further one, which wanders along a stroke
  double correlation_s = 0.3;       ///< time after which the correlation is 1/e
  double outlier_fraction = 0.0;    ///< of the samples
  double least_outlier_m = 0.001;   ///< distance from the bone
  double largest_outlier_m = 0.010;
  double tip_radius_m = 0.0;  ///< of a ball at the pointer's end, whose centre is tracked
  /// How deep beside the canal the tip goes, as a share of the canal's depth. From about 1 on the
  /// strokes go over the body's hind edge as well, which no registration from behind counts on.
  double deepest_aside = 1.1;
  double farthest_m = 1.0;  ///< the vertebra's origin lies in such a ball of the world
};
[[nodiscard]] StrokeErrorModel error_model_of(StrokeVariant variant);

/// One tracked place of the pointer's tip.
struct DigitizedSample {
  Point<World> tip;          ///< as tracked
  Point<Vertebra> true_tip;  ///< where the tip was
  Vec3 normal;               ///< of the bone there, outward, in the vertebra's frame
  BoneRegion region;         ///< that was stroked
  int stroke = 0;            ///< which movement, from 0
  bool off_bone = false;     ///< the pointer was lifted or in soft tissue
};

struct DigitizedStrokes {
  Transform<World, Vertebra> world_from_vertebra;
  std::vector<DigitizedSample> samples;  ///< in the order of time, 1/30 s apart within a stroke
  std::string coverage;                  ///< in words: "laminae only"

  [[nodiscard]] std::vector<Point<World>> tips() const;
  /// When each was measured, with a second between strokes; empty where they are in any order.
  [[nodiscard]] std::vector<double> times_s() const;
};

/// Time between samples of a stroke.
inline constexpr double kSamplePeriod_s = 1.0 / 30.0;

/// Strokes of a straight pointer over the posterior surface of a vertebra (axes LPS), tracked in
/// an unknown frame: any orientation with the same density. Which places are touched follows from
/// rays from outside alone. The same seed gives the same samples; the frame and the noise don't
/// depend on how many places are touched. An Error when the mesh has no canal or no place to touch.
Result<DigitizedStrokes> digitize_strokes(const nav::TriangleMesh& mesh, StrokeVariant variant,
                                          std::uint64_t seed, const StrokeErrorModel& error_model);
Result<DigitizedStrokes> digitize_strokes(const nav::TriangleMesh& mesh, StrokeVariant variant,
                                          std::uint64_t seed);

}  // namespace orthonav::test
