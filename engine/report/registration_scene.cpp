#include "engine/report/registration_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthonav::engine {
namespace {

constexpr std::size_t kMostPoints = 4000;
/// The same limit with which the registration separates points on the bone from others.
constexpr double kOffBoneSd = 3.5;
constexpr double kLeastFullColour_m = 0.0005;
/// Predicted errors are drawn on a scale up to this, unless they are larger.
constexpr double kLargestDrawn_m = 0.006;

std::vector<PlacedPoint> placed(const RegisteredLevel& level) {
  const nav::VertebraModel& model = *level.model;
  const Transform<Vertebra, World> to_model = level.registration.world_from_vertebra.inverse();
  const std::size_t step = (level.points.size() + kMostPoints - 1) / kMostPoints;
  std::vector<PlacedPoint> points;
  for (std::size_t i = 0; i < level.points.size(); i += step) {
    const Vec3 place = (to_model * level.points[i]).v;
    const auto surface = model.reachable_surface().nearest(place);
    if (!surface) {
      continue;
    }
    const double distance = surface->distance_m * (model.surface().contains(place) ? -1.0 : 1.0);
    points.push_back({place, distance - level.tip_radius_m - level.registration.standoff_m, false});
  }
  return points;
}

/// Scatter of the points about the surface: as registered, or else by the median, which outliers
/// don't move.
double scatter_m(const std::vector<PlacedPoint>& points, const nav::Registration& r) {
  if (is_judged(r) || points.empty()) {
    return r.noise_m;
  }
  std::vector<double> sizes;
  for (const PlacedPoint& p : points) {
    sizes.push_back(std::abs(p.residual_m));
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * (*middle);
}

std::vector<double> distances_from_strokes_m(const nav::TriangleMesh& mesh,
                                             const std::vector<PlacedPoint>& points) {
  std::vector<double> out;
  out.reserve(mesh.vertices_m.size());
  for (const Vec3& vertex : mesh.vertices_m) {
    double least = std::numeric_limits<double>::infinity();
    for (const PlacedPoint& p : points) {
      if (!p.off_bone) {
        least = std::min(least, (p.place_m - vertex).squared_norm());
      }
    }
    // Larger distances are drawn alike, and infinity can't be interpolated.
    out.push_back(std::min(std::sqrt(least), 4.0 * kStroked_m));
  }
  return out;
}

bool shows_tissue(const nav::Registration& r) {
  constexpr double kTissue_m = 0.0003;
  return std::max(r.standoff_m, r.field_sd_m) > kTissue_m;
}

/// Refused because of soft tissue; "press here" is then the most helpful advice.
bool asks_to_scrape(const nav::Registration& r) {
  return !r.accepted && r.stroke_next && shows_tissue(r);
}

/// The heights that the registration estimated from the strokes, or else those that the points
/// show. `paper` has neither.
std::vector<nav::EstimatedHeight> heights_of(const RegisteredLevel& level,
                                             const std::vector<PlacedPoint>& points) {
  const nav::Registration& r = level.registration;
  if (!r.heights.empty()) {
    return r.heights;
  }
  std::vector<nav::EstimatedHeight> out;
  if (is_judged(r) && shows_tissue(r)) {
    for (const PlacedPoint& p : points) {
      if (!p.off_bone) {
        out.push_back({{p.place_m}, p.residual_m + r.standoff_m});
      }
    }
  }
  return out;
}

/// The mean over places nearby, those next to a vertex first.
std::vector<double> tissue_over(const nav::TriangleMesh& mesh,
                                const std::vector<nav::EstimatedHeight>& heights) {
  constexpr double kNear_m = 0.003;
  constexpr double kFarthest_m = 0.008;
  std::vector<double> out;
  if (heights.empty()) {
    return out;
  }
  out.reserve(mesh.vertices_m.size());
  for (const Vec3& vertex : mesh.vertices_m) {
    double weights = 0.0;
    double sum_m = 0.0;
    for (const nav::EstimatedHeight& height : heights) {
      const double apart_m2 = (height.at.v - vertex).squared_norm();
      if (apart_m2 < kFarthest_m * kFarthest_m) {
        const double weight = std::exp(-0.5 * apart_m2 / (kNear_m * kNear_m));
        weights += weight;
        sum_m += weight * height.height_m;
      }
    }
    out.push_back(weights > 0.0 ? std::max(0.0, sum_m / weights)
                                : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

}  // namespace

double ellipsoid_scale() {
  // Root of the 95 % quantile of the chi-square distribution with three degrees of freedom.
  return std::sqrt(7.814727903251179);
}

double common_magnification(std::span<const RegisteredLevel> levels) {
  double largest_m = 0.0;
  for (const RegisteredLevel& level : levels) {
    for (const ScrewErrors& screw : errors_at_screws(level)) {
      for (const PlaceError* error : {&screw.entry, &screw.target}) {
        // An unknown error is not drawn, and must not shrink the others.
        const double drawn_m = std::isfinite(error->rms_m) ? ellipsoid_scale() * error->rms_m : 0.0;
        largest_m = std::max(largest_m, drawn_m);
      }
    }
  }
  // A whole number that makes errors readable and never larger than the bone's details.
  for (const double times : {20.0, 10.0, 5.0, 2.0}) {
    if (times * largest_m <= kLargestDrawn_m) {
      return times;
    }
  }
  return 1.0;
}

RegistrationScene registration_scene(const RegisteredLevel& level) {
  RegistrationScene scene;
  scene.points = placed(level);
  const double scatter = scatter_m(scene.points, level.registration);
  for (PlacedPoint& p : scene.points) {
    p.off_bone = std::abs(p.residual_m) > kOffBoneSd * scatter;
    scene.off_bone += p.off_bone ? 1 : 0;
  }
  scene.from_strokes_m = distances_from_strokes_m(level.model->reachable(), scene.points);
  scene.tissue_m = tissue_over(level.model->reachable(), heights_of(level, scene.points));
  const nav::Registration& r = level.registration;
  if (!scene.tissue_m.empty() && asks_to_scrape(r)) {
    scene.scrape_m = r.stroke_next_at.v;
  }
  for (const nav::CheckPoint& check : level.check_points) {
    scene.checks.push_back({(level.registration.world_from_vertebra.inverse() * check.place).v,
                            check.distance_m, !check.within});
  }
  // A scale of readable numbers: rounded up to the next half millimetre.
  scene.full_colour_m = std::max(kLeastFullColour_m, std::ceil(3.0 * scatter / 0.0005) * 0.0005);
  scene.magnified = common_magnification({&level, 1});
  return scene;
}

}  // namespace orthonav::engine
