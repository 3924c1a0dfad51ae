#include "engine/case/screw_place.h"

#include <algorithm>
#include <cmath>

#include "base/length_text.h"
#include "base/printed.h"

namespace orthonav::engine {
namespace {

constexpr double kMaxEntryOffBone_m = 0.010;
/// A tip may stick out of the front by its radius, or by this if the radius is smaller.
constexpr double kMinTargetOutside_m = 0.003;
constexpr double kMinScrewLength_m = 0.010;
constexpr double kMaxScrewLength_m = 0.120;
constexpr double kMinRadius_m = 0.001;
constexpr double kMaxRadius_m = 0.006;

double off_bone_m(const nav::SurfaceIndex& bone, Point<Vertebra> entry) {
  const auto nearest = bone.nearest(entry.v);
  return nearest ? nearest->distance_m : 1e3;
}

}  // namespace

bool OffMidline::crosses() const {
  return entry_m * target_m < 0.0 && std::abs(target_m) > std::abs(entry_m);
}

std::optional<nav::Side> OffMidline::side() const {
  if (!(std::abs(entry_m) >= kLeastOffMidline_m) || crosses()) {
    return std::nullopt;
  }
  return entry_m > 0.0 ? nav::Side::kLeft : nav::Side::kRight;
}

OffMidline off_midline(const nav::TriangleMesh& bone, Point<Vertebra> entry,
                       Point<Vertebra> target) {
  const double midline_x_m = nav::bounds_of(bone).centre().x;
  return {entry.v.x - midline_x_m, target.v.x - midline_x_m};
}

std::string to_the_side(double left_m) {
  return in_mm(std::abs(left_m)) + " to the " + name_of(left_m > 0.0 ? Side::kLeft : Side::kRight);
}

std::optional<std::string> ill_sized(Point<Vertebra> entry, Point<Vertebra> target,
                                     double radius_m) {
  const double length_m = (target - entry).norm();
  if (!(length_m >= kMinScrewLength_m && length_m <= kMaxScrewLength_m)) {
    return "is " + in_mm_outside(length_m, kMinScrewLength_m, kMaxScrewLength_m) +
           " from entry to target, must be " + in_mm(kMinScrewLength_m) + " to " +
           in_mm(kMaxScrewLength_m);
  }
  if (radius_m != 0.0 && !(radius_m >= kMinRadius_m && radius_m <= kMaxRadius_m)) {
    return "has radius " + in_mm_outside(radius_m, kMinRadius_m, kMaxRadius_m) + ", must be " +
           in_mm(kMinRadius_m) + " to " + in_mm(kMaxRadius_m);
  }
  return std::nullopt;
}

std::optional<std::string> misplaced(const nav::SurfaceIndex& bone, Point<Vertebra> entry,
                                     Point<Vertebra> target, double radius_m) {
  const double off_m = off_bone_m(bone, entry);
  if (off_m > kMaxEntryOffBone_m) {
    return "entry lies " + beside_limit("%.1f mm off the bone, limit %.1f mm", off_m * 1e3,
                                        kMaxEntryOffBone_m * 1e3);
  }
  const double behind_m = entry.v.y - target.v.y;
  if (!(behind_m > 0.0)) {
    return "entry lies " + in_mm(-behind_m) +
           " in front of its target, must lie behind it (posterior)";
  }
  const auto at_target = bone.nearest(target.v);
  const double outside_m = bone.contains(target.v) || !at_target ? 0.0 : at_target->distance_m;
  const double limit_m = std::max(radius_m, kMinTargetOutside_m);
  if (outside_m > limit_m) {
    return "target lies " +
           beside_limit("%.1f mm outside the bone, limit %.1f mm", outside_m * 1e3, limit_m * 1e3);
  }
  return std::nullopt;
}

std::optional<std::string> misplaced(const nav::SurfaceIndex& bone, Point<Vertebra> entry,
                                     Point<Vertebra> target, double radius_m, Axes stated) {
  const auto problem = misplaced(bone, entry, target, radius_m);
  const auto rotated = [](Point<Vertebra> p) { return Point<Vertebra>{to_lps(p.v, Axes::kRas)}; };
  if (!problem) {
    return problem;
  }
  if (misplaced(bone, rotated(entry), rotated(target), radius_m)) {
    return *problem +
           (off_bone_m(bone, entry) > kMaxEntryOffBone_m ? ": is it of another level?" : "");
  }
  const bool lps = stated == Axes::kLps;
  return *problem + " (its axes are stated as " + (lps ? "LPS" : "RAS") + "; as " +
         (lps ? "RAS" : "LPS") + " it would fit)";
}

}  // namespace orthonav::engine
