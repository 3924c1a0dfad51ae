#include "nav/guidance/other_entry.h"

#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kCoarse_m = 0.001;
constexpr double kFine_m = 0.0002;
/// The surface is searched for this far to either side of the planned entry. Estimate: another
/// process lies beyond.
constexpr double kSought_m = 0.010;

/// Searches for an entry among the places around the planned one, as seen along the planned axis.
class Search {
 public:
  Search(const ScrewPlan& plan, Point<Vertebra> hole, const SurfaceIndex& bone,
         const OtherEntryRules& rules)
      : plan_(plan), hole_(hole), bone_(bone), rules_(rules) {
    inward_ = (plan.target - plan.entry).normalized();
    const Vec3 helper = std::abs(inward_.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    across_ = inward_.cross(helper).normalized();
    athwart_ = inward_.cross(across_);
  }

  /// Tries every place of a square grid around a place.
  void look_around(double across_m, double athwart_m, double step_m, double reach_m) {
    const int steps = static_cast<int>(std::lround(reach_m / step_m));
    for (int i = -steps; i <= steps; ++i) {
      for (int j = -steps; j <= steps; ++j) {
        look_at(across_m + i * step_m, athwart_m + j * step_m);
      }
    }
  }
  [[nodiscard]] const std::optional<OtherEntry>& best() const { return best_; }
  [[nodiscard]] double best_across_m() const { return best_across_m_; }
  [[nodiscard]] double best_athwart_m() const { return best_athwart_m_; }

 private:
  void look_at(double across_m, double athwart_m) {
    if (std::hypot(across_m, athwart_m) > rules_.within_m) {
      return;
    }
    const Vec3 beside = plan_.entry.v + across_m * across_ + athwart_m * athwart_;
    const auto hit = bone_.first_hit(beside - kSought_m * inward_, inward_);
    if (!hit || hit->distance_m > 2.0 * kSought_m) {
      return;
    }
    ScrewPlan plan = plan_;
    plan.entry = {hit->point_m};
    const double from_hole_m = (plan.entry - hole_).norm();
    const Vec3 outward = (plan.entry - plan.target).normalized();
    if (from_hole_m < rules_.from_hole_m ||
        !(hit->normal.normalized().dot(outward) >= std::cos(rules_.steepest_rad))) {
      return;
    }
    const auto cylinder = cylinder_of(plan);
    const double above_m = best_ ? best_->clearance.clearance_m : 0.0;
    const auto better = cylinder ? least_clearance_above(above_m, bone_, *cylinder) : std::nullopt;
    if (better) {
      best_ = OtherEntry{plan.entry, *better, from_hole_m};
      best_across_m_ = across_m;
      best_athwart_m_ = athwart_m;
    }
  }

  const ScrewPlan& plan_;
  Point<Vertebra> hole_;
  const SurfaceIndex& bone_;
  OtherEntryRules rules_;
  Vec3 inward_;
  Vec3 across_;
  Vec3 athwart_;
  std::optional<OtherEntry> best_;
  double best_across_m_ = 0.0;
  double best_athwart_m_ = 0.0;
};

}  // namespace

std::optional<OtherEntry> other_entry(const ScrewPlan& plan, Point<Vertebra> hole,
                                      const SurfaceIndex& bone, const OtherEntryRules& rules) {
  Search search(plan, hole, bone, rules);
  search.look_around(0.0, 0.0, kCoarse_m, rules.within_m);
  if (search.best()) {
    search.look_around(search.best_across_m(), search.best_athwart_m(), kFine_m, kCoarse_m);
  }
  return search.best();
}

}  // namespace orthonav::nav
