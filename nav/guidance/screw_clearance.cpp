#include "nav/guidance/screw_clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nav/geometry/surface_depth.h"

namespace orthonav::nav {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
/// Length of the first slices, and of the parts into which open ones are cut: so thin that the
/// depth at the middle bounds that of the whole circumference to 0.04 mm for a radius of 3 mm.
constexpr double kSlice_m = 0.002;
constexpr int kSliceParts = 2;
constexpr std::size_t kMostSlices = 128;
/// Width of the first patches of a rim.
constexpr double kPatch_m = 0.0012;
/// First and last step of the descent from the shallowest place.
constexpr double kFirstStep_m = 0.0005;
constexpr double kLastStep_m = 0.000004;

/// A rectangle of the unrolled surface: its middle and half its sides.
struct Patch {
  double along_m = 0.0;
  double around_rad = 0.0;
  double half_along_m = 0.0;
  double half_around_rad = 0.0;
};

/// A length of the unrolled surface, all around.
struct Slice {
  double along_m = 0.0;
  double half_m = 0.0;
  double least_m = 0.0;  ///< no place in it is shallower
};

class LeastDepth {
 public:
  LeastDepth(const SurfaceIndex& bone, const CylinderSurface& screw, double tolerance_m)
      : depths_(bone), screw_(screw), tolerance_m_(tolerance_m) {}

  bool search();
  [[nodiscard]] Clearance found() const {
    return {best_m_, screw_.arc_length_m(best_along_m_), screw_.outward(best_around_rad_),
            screw_.on_tip(best_along_m_), screw_.at(best_along_m_, best_around_rad_)};
  }

 private:
  /// Whether a region with this lower bound may hide a place shallower than the best by more than
  /// the tolerance.
  [[nodiscard]] bool open(double least_m) const { return least_m < best_m_ - tolerance_m_; }
  /// An upper bound on the distance of the patch's places from its middle: the path along the
  /// surface is longer.
  [[nodiscard]] double radius_m(const Patch& p) const {
    return std::hypot(p.half_along_m, screw_.radius_m() * p.half_around_rad);
  }
  /// Lower bound on the depth in the slice; `half_m` is 0 for the whole tip.
  [[nodiscard]] double least_in(double middle_depth_m, double half_m) const {
    return middle_depth_m - std::hypot(half_m, screw_.radius_m());
  }
  std::optional<SurfaceDepth> take(double along_m, double around_rad);
  void descend();
  void close_steps();
  void examine(const Slice& slice);
  void examine_rim(double along_m, double half_m);
  void refine(const Patch& patch, double depth_m);

  DepthProbe depths_;
  const CylinderSurface& screw_;
  double tolerance_m_;
  double best_m_ = 1e9;
  double best_along_m_ = 0.0;
  double best_around_rad_ = 0.0;
};

/// The depth there, which becomes the best if it is smaller.
std::optional<SurfaceDepth> LeastDepth::take(double along_m, double around_rad) {
  const auto depth = depths_.at(screw_.at(along_m, around_rad).v);
  if (depth && depth->depth_m < best_m_) {
    best_m_ = depth->depth_m, best_along_m_ = along_m, best_around_rad_ = around_rad;
  }
  return depth;
}

bool LeastDepth::search() {
  const double side_m = screw_.side_m();
  const auto sides = std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(side_m / kSlice_m)),
                                             1, kMostSlices - 1);
  const double half_m = 0.5 * side_m / static_cast<double>(sides);
  std::array<Slice, kMostSlices> slices;
  for (std::size_t i = 0; i <= sides; ++i) {
    const bool tip = i == sides;
    const double along_m =
        tip ? 0.5 * (side_m + screw_.length_m()) : (2.0 * static_cast<double>(i) + 1.0) * half_m;
    const auto depth = depths_.at(screw_.middle(along_m));
    if (!depth) {
      return false;
    }
    slices[i] = {along_m, tip ? 0.5 * screw_.radius_m() : half_m,
                 least_in(depth->depth_m, tip ? 0.0 : half_m)};
    // The wall nearest to the axis is usually also nearest to the screw.
    if (open(slices[i].least_m)) {
      take(along_m, screw_.around_rad(-depth->deeper));
    }
  }
  descend();
  std::sort(slices.begin(), slices.begin() + static_cast<std::ptrdiff_t>(sides) + 1,
            [](const Slice& a, const Slice& b) {
              return a.least_m < b.least_m || (a.least_m == b.least_m && a.along_m < b.along_m);
            });
  for (std::size_t i = 0; i <= sides; ++i) {
    examine(slices[i]);
  }
  descend();
  close_steps();
  return true;
}

/// Descends along the surface while the depth decreases.
void LeastDepth::descend() {
  double step_m = kFirstStep_m;
  auto here = take(best_along_m_, best_around_rad_);
  while (here && step_m > kLastStep_m) {
    const double before_m = best_m_;
    const double along = -here->deeper.dot(screw_.along(best_along_m_, best_around_rad_));
    const double around = -here->deeper.dot(screw_.round(best_around_rad_));
    const double slope = std::hypot(along, around);
    if (!(slope > 0.0)) {
      return;
    }
    const double to_m = std::clamp(best_along_m_ + step_m * along / slope, 0.0, screw_.length_m());
    const auto there = take(to_m, best_around_rad_ + step_m * around / slope / screw_.radius_m());
    if (best_m_ < before_m) {
      here = there;
    } else {
      step_m *= 0.5;
    }
  }
}

/// Finds what the descent misses where two walls meet or at the rim of the tip.
void LeastDepth::close_steps() {
  for (double step_m = 0.1 * kFirstStep_m; step_m > kLastStep_m; step_m *= 0.5) {
    const double along_m = best_along_m_;
    const double around_rad = best_around_rad_;
    const double step_rad = step_m / screw_.radius_m();
    take(std::max(along_m - step_m, 0.0), around_rad);
    take(std::min(along_m + step_m, screw_.length_m()), around_rad);
    take(along_m, around_rad - step_rad);
    take(along_m, around_rad + step_rad);
  }
}

void LeastDepth::examine(const Slice& slice) {
  if (!open(slice.least_m)) {
    return;
  }
  const double half_m = slice.half_m / kSliceParts;
  for (int i = 0; i < kSliceParts; ++i) {
    const double along_m = slice.along_m + (2.0 * i + 1.0 - kSliceParts) * half_m;
    if (screw_.on_tip(slice.along_m)) {
      examine_rim(along_m, half_m);
      continue;
    }
    const auto depth = depths_.at(screw_.middle(along_m));
    if (depth && open(least_in(depth->depth_m, half_m))) {
      examine_rim(along_m, half_m);
    }
  }
}

void LeastDepth::examine_rim(double along_m, double half_m) {
  const double around_m = kTurn_rad * screw_.radius_m();
  const auto columns = static_cast<int>(std::ceil(around_m / kPatch_m));
  const double half_rad = 0.5 * kTurn_rad / columns;
  for (int k = 0; k < columns; ++k) {
    const Patch patch{along_m, (2.0 * k + 1.0) * half_rad, half_m, half_rad};
    if (const auto depth = take(patch.along_m, patch.around_rad)) {
      refine(patch, depth->depth_m);
    }
  }
}

void LeastDepth::refine(const Patch& patch, double depth_m) {
  if (!open(depth_m - radius_m(patch))) {
    return;
  }
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Patch part{patch.along_m + x * patch.half_along_m,
                       patch.around_rad + y * patch.half_around_rad, 0.5 * patch.half_along_m,
                       0.5 * patch.half_around_rad};
      if (const auto depth = take(part.along_m, part.around_rad)) {
        refine(part, depth->depth_m);
      }
    }
  }
}

}  // namespace

PedicleGrade grade_of(double clearance_m) {
  const double breach_m = -clearance_m;
  if (breach_m <= 0.0) {
    return PedicleGrade::kA;
  }
  if (breach_m < 0.002) {
    return PedicleGrade::kB;
  }
  if (breach_m < 0.004) {
    return PedicleGrade::kC;
  }
  return breach_m < 0.006 ? PedicleGrade::kD : PedicleGrade::kE;
}

const char* name_of(PedicleGrade grade) {
  constexpr std::array<const char*, kPedicleGrades> kNames = {"A", "B", "C", "D", "E"};
  return kNames[static_cast<std::size_t>(grade)];
}

std::optional<Clearance> least_clearance(const SurfaceIndex& bone, const ScrewCylinder& screw,
                                         double tolerance_m) {
  const auto surface = CylinderSurface::of(screw);
  if (!surface) {
    return std::nullopt;
  }
  LeastDepth least(bone, *surface, tolerance_m);
  if (!least.search()) {
    return std::nullopt;
  }
  return least.found();
}

bool clearance_profile(const SurfaceIndex& bone, const ScrewCylinder& screw,
                       std::span<double> least_m) {
  constexpr int kRimPlaces = 36;
  const auto surface = CylinderSurface::of(screw);
  DepthProbe depths(bone);
  if (!surface || least_m.empty() || !depths.at(screw.entry.v)) {
    return false;
  }
  const double steps = std::max(1.0, static_cast<double>(least_m.size()) - 1.0);
  for (std::size_t i = 0; i < least_m.size(); ++i) {
    const double along_m = surface->side_m() * (static_cast<double>(i) / steps);
    least_m[i] = 1e9;
    for (int k = 0; k < kRimPlaces; ++k) {
      const auto depth = depths.at(surface->at(along_m, kTurn_rad * k / kRimPlaces).v);
      least_m[i] = depth ? std::min(least_m[i], depth->depth_m) : least_m[i];
    }
  }
  return true;
}

const char* direction_of(const Clearance& clearance, Side side) {
  if (clearance.on_tip) {
    return "tip";
  }
  const Vec3 v = clearance.outward;
  if (std::abs(v.x) >= std::max(std::abs(v.y), std::abs(v.z))) {
    return (v.x > 0.0) == (side == Side::kLeft) ? "lateral" : "medial";
  }
  if (std::abs(v.z) >= std::abs(v.y)) {
    return v.z > 0.0 ? "cranial" : "caudal";
  }
  return v.y > 0.0 ? "posterior" : "anterior";
}

}  // namespace orthonav::nav
