#include "tests/support/digitized_strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/pointer_lifts.h"
#include "tests/support/stroke_coverage.h"

namespace orthonav::test {
namespace {

/// 21 mm/s at 30 Hz.
constexpr double kSpacing_m = 0.0007;
constexpr double kSparseStroke_m = 0.018;

StrokeCoverage covered(const TouchableBone& bone, const PosteriorLandmarks& marks,
                       StrokeVariant variant, double length_m, Random& random) {
  if (variant == StrokeVariant::kPartial) {
    return cover_part(bone, marks, length_m, random);
  }
  if (variant != StrokeVariant::kSparse) {
    return cover_all(bone, marks, length_m, random);
  }
  const auto strokes = static_cast<int>(std::lround(length_m / kSparseStroke_m));
  return cover_sparsely(bone, marks, length_m, std::max(strokes, 1), random);
}

/// `count` places along all walks. The speed of the hand varies by a quarter.
std::vector<TipPlace> places_along(const std::vector<Walk>& walks, int count, Random& random) {
  constexpr double kWandering = 0.25;
  constexpr double kKept = 0.9;  // of a deviation, from sample to sample
  double length_m = 0.0;
  for (const Walk& walk : walks) {
    length_m += walk.length_m();
  }
  std::vector<double> at(static_cast<std::size_t>(count));
  double sum = 0.0;
  double deviation = random.normal();
  for (double& a : at) {
    const double step = std::clamp(1.0 + kWandering * deviation, 0.3, 1.7);
    a = sum + 0.5 * step;
    sum += step;
    deviation = kKept * deviation + std::sqrt(1.0 - kKept * kKept) * random.normal();
  }
  std::vector<TipPlace> places;
  places.reserve(at.size());
  std::size_t walk = 0;
  double start_m = 0.0;
  for (const double a : at) {
    const double along_m = a / sum * length_m;
    while (walk + 1 < walks.size() && along_m > start_m + walks[walk].length_m()) {
      start_m += walks[walk++].length_m();
    }
    places.push_back(
        {walks[walk].at(along_m - start_m), walks[walk].region, static_cast<int>(walk), false});
  }
  return places;
}

Vec3 normal_vector(Random& random, double sd_m) {
  const double x = random.normal(0.0, sd_m);
  const double y = random.normal(0.0, sd_m);
  const double z = random.normal(0.0, sd_m);
  return {x, y, z};
}

/// The tracker's error: one part new at every sample, and one that varies slowly along a stroke
/// (AR(1)) and is reset between strokes.
class TrackingNoise {
 public:
  TrackingNoise(const StrokeErrorModel& m, Random random)
      : white_m_(m.white_noise_m),
        correlated_m_(m.correlated_noise_m),
        kept_(m.correlation_s > 0.0 ? std::exp(-kSamplePeriod_s / m.correlation_s) : 0.0),
        random_(random) {}

  Vec3 next(int stroke) {
    const Vec3 fresh = normal_vector(random_, correlated_m_);
    const double fraction = std::sqrt(1.0 - kept_ * kept_);
    wandering_m_ = stroke == stroke_ ? kept_ * wandering_m_ + fraction * fresh : fresh;
    stroke_ = stroke;
    return wandering_m_ + normal_vector(random_, white_m_);
  }

 private:
  double white_m_;
  double correlated_m_;
  double kept_;
  Random random_;
  Vec3 wandering_m_;
  int stroke_ = -1;
};

/// Uniformly distributed orientation, and uniformly distributed place in the ball.
Transform<World, Vertebra> random_frame(double farthest_m, Random random) {
  Quaternion q{random.normal(), random.normal(), random.normal(), random.normal()};
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const Vec3 direction = normal_vector(random, 1.0).normalized();
  const double distance_m = farthest_m * std::cbrt(random.uniform());
  return {rotation_from_quaternion({q.x / n, q.y / n, q.z / n, q.w / n}), distance_m * direction};
}

}  // namespace

const char* name_of(StrokeVariant variant) {
  switch (variant) {
    case StrokeVariant::kFull:
      return "full";
    case StrokeVariant::kPartial:
      return "partial";
    case StrokeVariant::kNoisy:
      return "noisy";
    case StrokeVariant::kOutliers:
      return "outliers";
    case StrokeVariant::kSparse:
      return "sparse";
  }
  return "";
}

StrokeErrorModel error_model_of(StrokeVariant variant) {
  StrokeErrorModel m;
  if (variant == StrokeVariant::kPartial) {
    m.fewest_samples = 800, m.most_samples = 1200;
  }
  if (variant == StrokeVariant::kNoisy) {
    m.white_noise_m = 0.0, m.correlated_noise_m = 0.0009;
  }
  if (variant == StrokeVariant::kOutliers) {
    m.outlier_fraction = 0.12;
  }
  if (variant == StrokeVariant::kSparse) {
    m.fewest_samples = m.most_samples = 300;
  }
  return m;
}

std::vector<Point<World>> DigitizedStrokes::tips() const {
  std::vector<Point<World>> points;
  points.reserve(samples.size());
  for (const DigitizedSample& sample : samples) {
    points.push_back(sample.tip);
  }
  return points;
}

std::vector<double> DigitizedStrokes::times_s() const {
  constexpr double kPause_s = 1.0;
  std::vector<double> times;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const int before = i > 0 ? samples[i - 1].stroke : 0;
    if (samples[i].stroke < before) {
      return {};
    }
    times.push_back(i > 0 ? times.back() + kSamplePeriod_s + kPause_s * (samples[i].stroke - before)
                          : 0.0);
  }
  return times;
}

Result<DigitizedStrokes> digitize_strokes(const nav::TriangleMesh& mesh, StrokeVariant variant,
                                          std::uint64_t seed, const StrokeErrorModel& error_model) {
  const nav::SurfaceIndex surface(mesh);
  const auto marks = find_posterior_landmarks(mesh, surface);
  if (!marks) {
    return marks.error();
  }
  const Random random = Random(seed).fork(name_of(variant));
  Random hand = random.fork("hand");
  const auto count =
      static_cast<int>(hand.uniform(error_model.fewest_samples, error_model.most_samples + 1));
  const TouchableBone bone(surface, *marks, {error_model.tip_radius_m, error_model.deepest_aside});
  const StrokeCoverage coverage = covered(bone, *marks, variant, count * kSpacing_m, hand);
  if (coverage.walks.empty()) {
    return Error{"no place of the vertebra can be touched from behind"};
  }
  std::vector<TipPlace> places = places_along(coverage.walks, count, hand);
  Random lifts = random.fork("lifts");
  lift_some(surface,
            {error_model.outlier_fraction, error_model.least_outlier_m,
             error_model.largest_outlier_m, error_model.tip_radius_m},
            lifts, places);
  DigitizedStrokes strokes{
      random_frame(error_model.farthest_m, random.fork("frame")), {}, coverage.words};
  TrackingNoise noise(error_model, random.fork("noise"));
  for (const TipPlace& place : places) {
    const Point<Vertebra> tip{place.touch.tip_m};
    strokes.samples.push_back({strokes.world_from_vertebra * (tip + noise.next(place.stroke)), tip,
                               place.touch.normal, place.region, place.stroke, place.off_bone});
  }
  return strokes;
}

Result<DigitizedStrokes> digitize_strokes(const nav::TriangleMesh& mesh, StrokeVariant variant,
                                          std::uint64_t seed) {
  return digitize_strokes(mesh, variant, seed, error_model_of(variant));
}

}  // namespace orthonav::test
