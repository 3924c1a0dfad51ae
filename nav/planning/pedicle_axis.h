#pragma once

#include <optional>
#include <span>

#include "base/angle.h"
#include "nav/geometry/surface_depth.h"
#include "nav/guidance/screw_clearance.h"
#include "nav/planning/canal.h"

namespace orthonav::nav {

/// An axis through a pedicle, in the directions of the vertebra. It is turned about the point where
/// it crosses the coronal plane midway between the canal's middle and the back of the body.
struct PedicleAxis {
  double lateral_m = 0.0;        ///< of that point, off the canal's axis
  double up_m = 0.0;             ///< of that point, from the canal's centre
  double convergence_rad = 0.0;  ///< towards the midline, seen from above
  double cranial_rad = 0.0;      ///< towards the head
};

/// Lumbar pedicles converge by 5-30°, from L1 down (Zindrick et al. 1987).
inline constexpr double kUsualConvergence_rad = 15.0 * kRadiansPerDegree;

/// Searches for axes along which a vertebra may be drilled from behind.
class PedicleSearch {
 public:
  /// Both outlive it. `steepest_rad`: as `kSteepestEntry_rad`.
  PedicleSearch(const SurfaceIndex& bone, const CanalFrame& canal, double steepest_rad)
      : bone_(bone), canal_(canal), steepest_rad_(steepest_rad) {}

  /// Unit, into the bone.
  [[nodiscard]] Vec3 direction(Side side, const PedicleAxis& axis) const;

  /// How an axis runs through bone: from its entry, searched from 60 mm behind, to the front.
  struct Way {
    Point<Vertebra> entry;
    Vec3 direction;           ///< unit
    double to_front_m = 0.0;  ///< from the entry to the far cortex
    double to_body_m = 0.0;   ///< from the entry to abreast of the back of the body
  };
  /// Empty if it enters beside the pedicle or on too steep a slope.
  [[nodiscard]] std::optional<Way> way(Side side, const PedicleAxis& axis) const;

  /// How long a screw there may be: it ends at least 5 mm, and at least 15 % of the way through the
  /// bone, before the far cortex.
  [[nodiscard]] static double safe_length_m(const Way& way);

  /// The axis of a grid (1.5 mm, 5°) that stays deepest below the cortex from 6 mm past the entry
  /// to where a screw of at most `longest_m` ends. Empty if none stays inside.
  [[nodiscard]] std::optional<PedicleAxis> coarse(Side side, double longest_m) const;

  /// What `fine` looks for.
  struct Wanted {
    double radius_m = 0.0;
    double length_m = 0.0;
    /// Among screws with nearly the same clearance the one nearest to these angles is taken: this
    /// much clearance is given up per degree.
    double convergence_rad = kUsualConvergence_rad;
    double cranial_rad = 0.0;
    double per_degree_m = 0.00001;
  };
  struct Found {
    PedicleAxis axis;
    Way way;
    Clearance clearance;
  };
  /// The screw of that size with the largest clearance near the best of the starts, by a compass
  /// search down to 0.05 mm and 0.1° (Kolda, Lewis and Torczon 2003, "Optimization by direct
  /// search", SIAM Review 45:385). Empty if no start leads into the bone.
  [[nodiscard]] std::optional<Found> fine(Side side, std::span<const PedicleAxis> starts,
                                          const Wanted& wanted) const;

 private:
  /// The best of the grid so far, and its depth minus the penalty for its angles and length.
  struct Best {
    std::optional<PedicleAxis> axis;
    double score_m = 0.0;
  };
  void consider(Side side, const PedicleAxis& axis, double longest_m, DepthProbe& depths,
                Best& best) const;
  [[nodiscard]] Vec3 point_m(Side side, const PedicleAxis& axis) const;

  const SurfaceIndex& bone_;
  const CanalFrame& canal_;
  double steepest_rad_;
};

}  // namespace orthonav::nav
