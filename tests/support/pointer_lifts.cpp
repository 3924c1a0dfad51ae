#include "tests/support/pointer_lifts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace orthonav::test {
namespace {

constexpr double kBurstFraction = 0.7;
constexpr int kShortestBurst = 6;
constexpr int kLongestBurst = 20;
/// Fraction of the single lifts that go sideways instead of back along the pointer.
constexpr double kBesideFraction = 0.4;

class Lifter {
 public:
  Lifter(const nav::SurfaceIndex& surface, const LiftOptions& options, Random& random,
         std::vector<TipPlace>& places)
      : surface_(surface), options_(options), random_(random), places_(places) {}

  void lift() {
    const auto wanted = static_cast<std::size_t>(
        std::lround(options_.fraction * static_cast<double>(places_.size())));
    const auto in_bursts =
        static_cast<std::size_t>(std::lround(kBurstFraction * static_cast<double>(wanted)));
    // Strokes may be too short for bursts; single lifts then make up the number.
    for (int tries = 0; lifted_ < in_bursts && tries < 10'000; ++tries) {
      burst(in_bursts - lifted_);
    }
    while (lifted_ < wanted) {
      single();
    }
  }

 private:
  [[nodiscard]] std::size_t any_place() {
    return std::min(
        places_.size() - 1,
        static_cast<std::size_t>(random_.uniform() * static_cast<double>(places_.size())));
  }

  /// Consecutive samples of one stroke, at its start, its end or in between.
  void burst(std::size_t most) {
    const auto length =
        static_cast<std::size_t>(random_.uniform(kShortestBurst, kLongestBurst + 1));
    const std::size_t chosen = any_place();
    const double where = random_.uniform();
    const double peak_m = random_.uniform(0.4, 1.0) * options_.largest_m;
    const Vec3 aside = 0.3 * random_direction();
    const auto [first, end] = stroke_of(chosen);
    const std::size_t n = std::min({length, most, end - first});
    std::size_t begin = std::clamp(chosen, first, end - n);
    if (where < 0.3) {
      begin = first;
    }
    if (where > 0.6) {
      begin = end - n;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (places_[begin + i].off_bone) {
        return;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      const double height = where < 0.3   ? 1.0 - t
                            : where > 0.6 ? t
                                          : std::sin(std::numbers::pi * t);
      const Vec3 away = places_[begin + i].touch.approach + aside;
      move(places_[begin + i], std::max(options_.least_m, height * peak_m), away);
    }
  }

  void single() {
    TipPlace& place = places_[any_place()];
    const double distance_m = random_.uniform(options_.least_m, options_.largest_m);
    const bool beside = random_.uniform() < kBesideFraction;
    Vec3 away = random_direction();
    if (away.dot(place.touch.normal) < 0.0) {
      away = -away;
    }
    if (place.off_bone) {
      return;
    }
    move(place, distance_m, beside ? away : place.touch.approach);
  }

  /// The samples of a place's stroke, as a range.
  [[nodiscard]] std::pair<std::size_t, std::size_t> stroke_of(std::size_t place) const {
    std::size_t first = place;
    std::size_t end = place + 1;
    while (first > 0 && places_[first - 1].stroke == places_[place].stroke) {
      --first;
    }
    while (end < places_.size() && places_[end].stroke == places_[place].stroke) {
      ++end;
    }
    return {first, end};
  }

  void move(TipPlace& place, double distance_m, Vec3 away) {
    auto moved = away_from_bone(place.touch, distance_m, away.normalized());
    // Back along the pointer there is no obstacle.
    if (!moved) {
      moved = away_from_bone(place.touch, distance_m, place.touch.approach);
    }
    if (!moved) {
      return;
    }
    place.touch.tip_m = *moved;
    place.off_bone = true;
    ++lifted_;
  }

  /// The point along a direction at `distance_m` from the bone; nothing if bone is in the way.
  [[nodiscard]] std::optional<Vec3> away_from_bone(const Touch& touch, double distance_m,
                                                   Vec3 away) const {
    constexpr double kLift_m = 1e-5;
    constexpr double kNear_m = 1e-7;
    constexpr double kFarthest_m = 0.1;
    const Vec3 start_m = touch.tip_m + kLift_m * touch.normal;
    double gone_m = 0.0;
    while (gone_m < kFarthest_m) {
      const auto near = surface_.nearest(start_m + gone_m * away);
      const double missing_m = distance_m + options_.tip_radius_m - near->distance_m;
      if (missing_m < kNear_m) {
        break;
      }
      gone_m += missing_m;  // the distance to the bone can't grow faster than the path
    }
    const auto blocked = surface_.first_hit(start_m, away);
    if (gone_m >= kFarthest_m || (blocked && blocked->distance_m < gone_m)) {
      return std::nullopt;
    }
    return start_m + gone_m * away;
  }

  [[nodiscard]] Vec3 random_direction() {
    const double x = random_.normal();
    const double y = random_.normal();
    const double z = random_.normal();
    return Vec3{x, y, z + 1e-12}.normalized();
  }

  const nav::SurfaceIndex& surface_;
  const LiftOptions& options_;
  Random& random_;
  std::vector<TipPlace>& places_;
  std::size_t lifted_ = 0;
};

}  // namespace

void lift_some(const nav::SurfaceIndex& surface, const LiftOptions& options, Random& random,
               std::vector<TipPlace>& places) {
  if (places.empty() || !(options.fraction > 0.0)) {
    return;
  }
  Lifter(surface, options, random, places).lift();
}

}  // namespace orthonav::test
