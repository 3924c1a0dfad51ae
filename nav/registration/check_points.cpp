#include "nav/registration/check_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

namespace orthonav::nav {
namespace {

/// A touch this near to a proposed place counts for it.
constexpr double kTouchedWithin_m = 0.008;
/// This many places reveal every motion of a rigid body except along the surface.
constexpr std::size_t kPlacesApart = 3;

double height_m(Vec3 a, Vec3 b, Vec3 c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
}

/// How far the points are spread: the largest number that lie apart from each other, up to three,
/// and whether three of them also lie off a line.
struct Spread {
  std::size_t apart = 0;
  bool off_line = false;
};

Spread spread_of(std::span<const CheckPoint> points, const CheckPointRules& rules) {
  Spread spread;
  spread.apart = points.empty() ? 0 : 1;
  const auto apart = [&](std::size_t i, std::size_t j) {
    return (points[i].place - points[j].place).norm() >= rules.apart_m;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!apart(i, j)) {
        continue;
      }
      spread.apart = std::max<std::size_t>(spread.apart, 2);
      for (std::size_t k = 0; k < j; ++k) {
        if (!apart(i, k) || !apart(j, k)) {
          continue;
        }
        spread.apart = 3;
        if (height_m(points[i].place.v, points[j].place.v, points[k].place.v) >= rules.off_line_m) {
          spread.off_line = true;
        }
      }
    }
  }
  return spread;
}

/// The places on the bone that the strokes passed, in World.
std::vector<Vec3> stroked_bone(const VertebraModel& model,
                               const Transform<World, Vertebra>& world_from_vertebra,
                               std::span<const Point<World>> stroked,
                               const CheckPointRules& rules) {
  const auto vertebra_from_world = world_from_vertebra.inverse();
  std::vector<Vec3> on_bone;
  for (const Point<World>& point : stroked) {
    const auto nearest = model.reachable_surface().nearest((vertebra_from_world * point).v);
    if (nearest && nearest->distance_m <= rules.within_m) {
      on_bone.push_back((world_from_vertebra * Point<Vertebra>{nearest->point_m}).v);
    }
  }
  return on_bone;
}

CheckAdvice advice_on(const Spread& spread, const CheckPointRules& rules) {
  if (spread.apart < kPlacesApart) {
    return {CheckAdvice::Kind::kTouchApart, kPlacesApart - spread.apart, rules.apart_m, 0.0};
  }
  return {CheckAdvice::Kind::kTouchOffLine, 1, rules.off_line_m, 0.0};
}

}  // namespace

std::vector<std::string> CheckPointRules::check() const {
  std::vector<std::string> problems;
  if (!(apart_m >= 0.005 && apart_m <= 0.05)) {
    problems.push_back("check_points.apart_m must lie in [0.005, 0.05]");
  }
  if (!(within_m > 0.0 && within_m <= 0.005)) {
    problems.push_back("check_points.within_m must lie in (0, 0.005]");
  }
  if (!(off_line_m >= 0.0 && off_line_m <= 0.5 * apart_m)) {
    problems.push_back("check_points.off_line_m must lie in [0, half of apart_m]");
  }
  if (enough > kMaxCheckPoints) {
    problems.push_back("check_points.enough must be at most " + std::to_string(kMaxCheckPoints));
  }
  if (!(wanted_tre_99_m > 0.0 && wanted_tre_99_m <= 0.01)) {
    problems.push_back("check_points.wanted_tre_99_m must lie in (0, 0.01]");
  }
  if (!(least_gain >= 0.0 && least_gain <= 1.0)) {
    problems.push_back("check_points.least_gain must lie in [0, 1]");
  }
  return problems;
}

CheckPoint check_point(const VertebraModel& model,
                       const Transform<World, Vertebra>& world_from_vertebra, Point<World> touched,
                       const CheckPointRules& rules) {
  CheckPoint point;
  point.place = touched;
  point.limit_m = rules.within_m;
  point.distance_m = std::numeric_limits<double>::infinity();
  const Vec3 in_vertebra = (world_from_vertebra.inverse() * touched).v;
  if (!in_vertebra.is_finite()) {
    return point;
  }
  const auto nearest = model.reachable_surface().nearest(in_vertebra);
  if (!nearest) {
    return point;
  }
  // The whole bone decides between inside and outside; at an edge the nearest triangle's normal may
  // be wrong.
  const double sign = model.surface().contains(in_vertebra) ? -1.0 : 1.0;
  point.distance_m = sign * nearest->distance_m;
  point.within = nearest->distance_m <= rules.within_m;
  return point;
}

std::vector<Point<World>> places_to_check(const VertebraModel& model,
                                          const Transform<World, Vertebra>& world_from_vertebra,
                                          std::span<const Point<World>> stroked,
                                          const CheckPointRules& rules) {
  const auto on_bone = stroked_bone(model, world_from_vertebra, stroked, rules);
  std::vector<Point<World>> places;
  if (on_bone.empty()) {
    return places;
  }
  const Vec3 middle =
      std::accumulate(on_bone.begin(), on_bone.end(), Vec3{}) / static_cast<double>(on_bone.size());
  // Each as far as possible: from the middle, from the first, from the line through the first two.
  const auto take = [&](const auto& distance, double at_least_m) {
    const Vec3 best = *std::max_element(on_bone.begin(), on_bone.end(),
                                        [&](Vec3 a, Vec3 b) { return distance(a) < distance(b); });
    if (!(distance(best) >= at_least_m)) {
      return false;
    }
    places.push_back(Point<World>{best});
    return true;
  };
  if (!take([&](Vec3 p) { return (p - middle).norm(); }, 0.0)) {
    return places;
  }
  const Vec3 first = places[0].v;
  if (!take([&](Vec3 p) { return (p - first).norm(); }, rules.apart_m)) {
    return places;
  }
  const Vec3 second = places[1].v;
  const auto off_line = [&](Vec3 p) {
    const bool apart = (p - first).norm() >= rules.apart_m && (p - second).norm() >= rules.apart_m;
    return apart ? height_m(first, second, p) : -1.0;
  };
  take(off_line, rules.off_line_m);
  return places;
}

std::vector<Point<World>> still_to_check(std::span<const Point<World>> places,
                                         std::span<const CheckPoint> touched) {
  std::vector<Point<World>> open;
  for (const Point<World>& place : places) {
    if (std::none_of(touched.begin(), touched.end(), [&](const CheckPoint& point) {
          return (point.place - place).norm() < kTouchedWithin_m;
        })) {
      open.push_back(place);
    }
  }
  return open;
}

CheckVerdict verdict_on(std::span<const CheckPoint> points, const CheckPointRules& rules) {
  CheckVerdict verdict;
  for (const CheckPoint& point : points) {
    verdict.worst_m = std::max(verdict.worst_m, std::abs(point.distance_m));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].within) {
      continue;
    }
    verdict.advice = {CheckAdvice::Kind::kReject, i + 1, std::abs(points[i].distance_m),
                      points[i].limit_m};
    return verdict;
  }
  const Spread spread = spread_of(points, rules);
  verdict.passed = spread.off_line;
  if (!verdict.passed) {
    verdict.advice = advice_on(spread, rules);
  }
  return verdict;
}

void weigh(const PressFit& fit, std::span<CheckPoint> points) {
  // Deviations within this many SDs may be chance and are never held against a touch.
  constexpr double kMaxSds = 4.0;
  constexpr double kTouch_m = 0.001;
  constexpr std::size_t kMany = 8;
  constexpr double kMaxWithin = 2.0;
  const std::size_t before = fit.off_m.size() - points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off_m = fit.off_m[before + i];
    const double limit_m = std::max(kTouch_m, kMaxSds * fit.off_sd_m[before + i]);
    const bool fits = std::abs(off_m) <= limit_m;
    // Among many places, some lie beyond a fixed limit because of model error and the map's drift;
    // comparing each with the prediction from the others is the better test.
    if (fits && fit.off_m.size() >= kMany &&
        std::abs(points[i].distance_m) <= kMaxWithin * points[i].limit_m) {
      points[i].limit_m = std::max(points[i].limit_m, std::abs(points[i].distance_m));
      points[i].within = true;
    }
    if (points[i].within && !fits) {
      points[i].within = false;
      points[i].distance_m = off_m;
      points[i].limit_m = limit_m;
    }
  }
}

CheckVerdict verdict_on(std::span<const CheckPoint> points, const CheckPointRules& rules,
                        const Registration& with_them, const std::optional<NextPlace>& next) {
  CheckVerdict verdict = verdict_on(points, rules);
  const bool worth = next && next->tre_then_m <= (1.0 - rules.least_gain) * next->tre_m;
  if (verdict.passed && !with_them.accepted) {
    verdict.passed = false;
    const bool more = points.size() < kMaxCheckPoints;
    verdict.advice = {more ? CheckAdvice::Kind::kTouchMore : CheckAdvice::Kind::kUncertain, 1,
                      with_them.tre_99_m, PoseSearchRegistrationOptions{}.max_tre_99_m};
  } else if (verdict.passed && points.size() < rules.enough && worth &&
             !(with_them.tre_99_m <= rules.wanted_tre_99_m)) {
    verdict.passed = false;
    verdict.advice = {CheckAdvice::Kind::kTouchMore, 1, with_them.tre_99_m, rules.wanted_tre_99_m};
  }
  return verdict;
}

// ---------------------------------------------------------------------------------------------
// What the strokes left out.

namespace {

constexpr double kStroked_m = 0.004;
constexpr double kUnstroked_m = 0.006;
/// Only one of several points closer together than this is used; the limits move by no more than
/// that.
constexpr double kThinned_m = 0.0005;

std::vector<Vec3> thinned(const Transform<Vertebra, World>& vertebra_from_world,
                          std::span<const Point<World>> points) {
  std::map<std::array<int, 3>, Vec3> cells;
  const auto cell = [](double x) { return static_cast<int>(std::floor(x / kThinned_m)); };
  for (const Point<World>& point : points) {
    const Vec3 at = (vertebra_from_world * point).v;
    if (!std::isfinite(at.x + at.y + at.z)) {
      continue;
    }
    cells.try_emplace({cell(at.x), cell(at.y), cell(at.z)}, at);
  }
  std::vector<Vec3> kept;
  for (const auto& [key, at] : cells) {
    kept.push_back(at);
  }
  return kept;
}

float unstroked_fraction(Vec3 place_m, const std::vector<Vec3>& points_m) {
  double least_m2 = kUnstroked_m * kUnstroked_m;
  for (const Vec3 point : points_m) {
    least_m2 = std::min(least_m2, (point - place_m).squared_norm());
    if (least_m2 <= kStroked_m * kStroked_m) {
      return 0.0f;
    }
  }
  return static_cast<float>((std::sqrt(least_m2) - kStroked_m) / (kUnstroked_m - kStroked_m));
}

}  // namespace

std::vector<float> unstroked_surface(const VertebraModel& model,
                                     const Transform<World, Vertebra>& world_from_vertebra,
                                     std::span<const Point<World>> points) {
  const std::vector<Vec3> stroked_m = thinned(world_from_vertebra.inverse(), points);
  const TriangleMesh& mesh = model.mesh();
  constexpr float kNotAsked = -1.0f;
  std::vector<float> unstroked(mesh.vertices_m.size(), kNotAsked);
  for (const std::uint32_t face : model.reachable_faces()) {
    for (const std::uint32_t vertex : mesh.triangles[face]) {
      if (unstroked[vertex] == kNotAsked) {
        unstroked[vertex] = unstroked_fraction(mesh.vertices_m[vertex], stroked_m);
      }
    }
  }
  std::replace(unstroked.begin(), unstroked.end(), kNotAsked, 0.0f);
  return unstroked;
}

}  // namespace orthonav::nav
