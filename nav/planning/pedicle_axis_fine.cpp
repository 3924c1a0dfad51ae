#include <algorithm>
#include <array>
#include <cmath>

#include "nav/geometry/surface_depth.h"
#include "nav/planning/pedicle_axis.h"

namespace orthonav::nav {
namespace {

/// Moves along each of the four degrees of freedom, and shift and turn in one plane combined: where
/// two walls limit the clearance, only the combination improves it.
constexpr std::array<std::array<double, 4>, 16> kMoves = {{{1, 0, 0, 0},
                                                           {-1, 0, 0, 0},
                                                           {0, 1, 0, 0},
                                                           {0, -1, 0, 0},
                                                           {0, 0, 1, 0},
                                                           {0, 0, -1, 0},
                                                           {0, 0, 0, 1},
                                                           {0, 0, 0, -1},
                                                           {0.5, 0, 1, 0},
                                                           {-0.5, 0, -1, 0},
                                                           {0.5, 0, -1, 0},
                                                           {-0.5, 0, 1, 0},
                                                           {0, 0.5, 0, 1},
                                                           {0, -0.5, 0, -1},
                                                           {0, 0.5, 0, -1},
                                                           {0, -0.5, 0, 1}}};

/// A place on a screw's surface, in the screw's own coordinates.
struct ScrewPlace {
  double arc_m = 0.0;
  Vec3 radial_m;
};

/// Judges one axis after another.
class FineSearch {
 public:
  FineSearch(const PedicleSearch& search, const SurfaceIndex& bone, Side side,
             const PedicleSearch::Wanted& wanted)
      : search_(search), bone_(bone), side_(side), wanted_(wanted), depths_(bone) {}

  /// Whether this axis is better than the best so far; if so, it becomes the best.
  bool take(const PedicleAxis& axis);
  [[nodiscard]] const std::optional<PedicleSearch::Found>& best() const { return best_; }

 private:
  [[nodiscard]] bool shallow(const PedicleSearch::Way& way, double lost_m);
  void remember(const PedicleSearch::Way& way, const Clearance& clearance);

  const PedicleSearch& search_;
  const SurfaceIndex& bone_;
  Side side_;
  const PedicleSearch::Wanted& wanted_;
  DepthProbe depths_;
  std::optional<PedicleSearch::Found> best_;
  double best_m_ = -1e9;
  std::array<ScrewPlace, 12> tight_;
  std::size_t known_ = 0;
};

/// This screw is usually nearest to the cortex where earlier ones were: checking that place first
/// often shows that it is no better, without the rest of its surface.
bool FineSearch::shallow(const PedicleSearch::Way& way, double lost_m) {
  for (std::size_t i = std::min(known_, tight_.size()); i-- > 0;) {
    const ScrewPlace& tight = tight_[i];
    const Vec3 across_m = tight.radial_m - tight.radial_m.dot(way.direction) * way.direction;
    const auto depth = depths_.at(way.entry.v + tight.arc_m * way.direction + across_m);
    if (depth && depth->depth_m - lost_m <= best_m_) {
      return true;
    }
  }
  return false;
}

void FineSearch::remember(const PedicleSearch::Way& way, const Clearance& clearance) {
  const Vec3 from_entry_m = clearance.place - way.entry;
  const double arc_m = from_entry_m.dot(way.direction);
  tight_[known_++ % tight_.size()] = {arc_m, from_entry_m - arc_m * way.direction};
}

bool FineSearch::take(const PedicleAxis& axis) {
  const auto way = search_.way(side_, axis);
  if (!way) {
    return false;
  }
  const double off_rad = std::hypot(axis.convergence_rad - wanted_.convergence_rad,
                                    axis.cranial_rad - wanted_.cranial_rad);
  const double too_long_m = std::max(0.0, wanted_.length_m - PedicleSearch::safe_length_m(*way));
  const double lost_m = wanted_.per_degree_m * off_rad * kDegreesPerRadian + too_long_m;
  if (shallow(*way, lost_m)) {
    return false;
  }
  const auto clearance =
      least_clearance(bone_, {way->entry, way->direction, wanted_.length_m, wanted_.radius_m});
  if (!clearance) {
    return false;
  }
  remember(*way, *clearance);
  if (clearance->clearance_m - lost_m <= best_m_) {
    return false;
  }
  best_ = PedicleSearch::Found{axis, *way, *clearance};
  best_m_ = clearance->clearance_m - lost_m;
  return true;
}

}  // namespace

std::optional<PedicleSearch::Found> PedicleSearch::fine(Side side,
                                                        std::span<const PedicleAxis> starts,
                                                        const Wanted& wanted) const {
  constexpr double kWidestStep_m = 0.0016;
  constexpr double kFinestStep_m = 0.00005;
  constexpr double kRadPerMetre = 35.0;  // 1 mm and 2 degrees move the ends of a screw equally
  FineSearch search(*this, bone_, side, wanted);
  for (const PedicleAxis& start : starts) {
    search.take(start);
  }
  for (double step_m = kWidestStep_m; search.best() && step_m > kFinestStep_m;) {
    const PedicleAxis here = search.best()->axis;
    const double step_rad = step_m * kRadPerMetre;
    bool better = false;
    for (const auto& move : kMoves) {
      better |= search.take({here.lateral_m + step_m * move[0], here.up_m + step_m * move[1],
                             here.convergence_rad + step_rad * move[2],
                             here.cranial_rad + step_rad * move[3]});
    }
    step_m = better ? step_m : 0.5 * step_m;
  }
  return search.best();
}

}  // namespace orthonav::nav
