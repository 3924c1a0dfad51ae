#include "nav/guidance/screw_clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Cholesky>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "nav/geometry/matrix_as.h"
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
/// A place this much shallower than the best one is not missed.
constexpr double kTolerance_m = 0.00005;
/// More than what rounding changes.
constexpr double kRoundingOfDepth_m = 1e-12;
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
  LeastDepth(double above_m, const SurfaceIndex& bone, const CylinderSurface& screw)
      : above_m_(above_m), depths_(bone), screw_(screw) {}

  /// False as soon as a place is found that is no deeper than `above_m`.
  bool search();
  [[nodiscard]] Clearance found() const {
    return {best_m_, screw_.arc_length_m(best_along_m_), screw_.outward(best_around_rad_),
            screw_.on_tip(best_along_m_), screw_.at(best_along_m_, best_around_rad_)};
  }

 private:
  /// Whether a region with this lower bound may hide a place shallower than the best by more than
  /// the tolerance.
  [[nodiscard]] bool open(double least_m) const { return least_m < best_m_ - kTolerance_m; }
  /// An upper bound on the distance of the patch's places from its middle: the path along the
  /// surface is longer.
  [[nodiscard]] double radius_m(const Patch& p) const {
    return std::hypot(p.half_along_m, screw_.radius_m() * p.half_around_rad);
  }
  /// Lower bound on the depth in the slice; `half_m` is 0 for the whole tip.
  [[nodiscard]] double least_in(double middle_depth_m, double half_m) const {
    return middle_depth_m - std::hypot(half_m, screw_.radius_m());
  }
  std::optional<SurfaceDepth> take(double along_m, double around_rad, double within_m = 1e9);
  void descend();
  void close_steps();
  void examine(const Slice& slice);
  void examine_rim(double along_m, double half_m);
  void look_at(const Patch& patch, bool inside);
  void refine(const Patch& patch, double depth_m);

  double above_m_;
  DepthProbe depths_;
  const CylinderSurface& screw_;
  double best_m_ = 1e9;
  double best_along_m_ = 0.0;
  double best_around_rad_ = 0.0;
};

/// The depth there, which becomes the best if it is smaller; empty if the surface is farther.
std::optional<SurfaceDepth> LeastDepth::take(double along_m, double around_rad, double within_m) {
  const auto depth = depths_.at(screw_.at(along_m, around_rad).v, within_m);
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
    if (best_m_ <= above_m_) {
      return false;
    }
  }
  descend();
  std::sort(slices.begin(), slices.begin() + static_cast<std::ptrdiff_t>(sides) + 1,
            [](const Slice& a, const Slice& b) {
              return a.least_m < b.least_m || (a.least_m == b.least_m && a.along_m < b.along_m);
            });
  for (std::size_t i = 0; i <= sides && best_m_ > above_m_; ++i) {
    examine(slices[i]);
  }
  if (best_m_ > above_m_) {
    descend();
    close_steps();
  }
  return best_m_ > above_m_;
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
    look_at({along_m, (2.0 * k + 1.0) * half_rad, half_m, half_rad}, false);
  }
}

/// `inside`: its middle is known to lie inside. How deep does not matter where it is neither the
/// best nor open.
void LeastDepth::look_at(const Patch& patch, bool inside) {
  const double deep_m =
      best_m_ + std::max(0.0, radius_m(patch) - kTolerance_m) + kRoundingOfDepth_m;
  if (const auto depth = take(patch.along_m, patch.around_rad, inside ? deep_m : 1e9)) {
    refine(patch, depth->depth_m);
  }
}

void LeastDepth::refine(const Patch& patch, double depth_m) {
  if (!open(depth_m - radius_m(patch))) {
    return;
  }
  const bool inside = depth_m > radius_m(patch);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      look_at({patch.along_m + x * patch.half_along_m, patch.around_rad + y * patch.half_around_rad,
               0.5 * patch.half_along_m, 0.5 * patch.half_around_rad},
              inside);
    }
  }
}

constexpr std::size_t kCases = 1024;
/// Plane waves of the model's error. With so few, the correlation of two places is off by some 0.2.
constexpr Eigen::Index kWaves = 8;
/// Largest distance between rows along the screw, and the places in each row: with 30° between
/// them, at most 1 - cos(15°) = 3 % of a motion is missed.
constexpr double kRow_m = 0.003;
constexpr int kPlacesInRow = 12;
/// A place that would have to move by more SDs than this to become nearer to the wall than the
/// nearest place is skipped: it happens in one of 4000 cases.
constexpr double kWorth_sd = 3.5;

/// Standard normal numbers, those of one case in each row: the components of a motion, then the
/// amplitudes of the model's error, a cosine and a sine for each wave.
using Cases = Eigen::Matrix<float, kCases, 6 + 2 * kWaves>;
/// How the depth of a place changes with each of them.
using DepthChange = Eigen::Matrix<float, 6 + 2 * kWaves, 1>;
using Root = Eigen::Matrix<double, 6, 6>;

Cases made_cases() {
  // The positive root of x^7 = x + 1.
  constexpr double kRoot = 1.1127756842787055;
  Cases cases;
  double step = 1.0;
  for (auto component : cases.leftCols<6>().colwise()) {
    step /= kRoot;
    for (Eigen::Index i = 0; i < component.size(); ++i) {
      const double at = 0.5 + step * (static_cast<double>(i) + 1.0);
      component(i) = static_cast<float>(normal_quantile(at - std::floor(at)));
    }
  }
  Random random(2007);
  for (auto amplitude : cases.rightCols<2 * kWaves>().colwise()) {
    for (float& value : amplitude) {
      value = static_cast<float>(random.normal());
    }
  }
  return cases;
}

const Cases& standard_cases() {
  static const Cases kMade = made_cases();
  return kMade;
}

/// Wave vectors (rad per correlation length) of a field with the covariance `shared_error_m2`.
std::array<Vec3, kWaves> made_waves() {
  std::array<Vec3, kWaves> waves;
  Random random(1759);
  for (Vec3& wave : waves) {
    // The spectrum of Matern's correlation of order 3/2 in space is Student's t with three degrees
    // of freedom.
    const Vec3 normal{random.normal(), random.normal(), random.normal()};
    const Vec3 spread{random.normal(), random.normal(), random.normal()};
    wave = (kSmoothScale / spread.norm()) * normal;
  }
  return waves;
}

const std::array<Vec3, kWaves>& unit_waves() {
  static const std::array<Vec3, kWaves> kMade = made_waves();
  return kMade;
}

/// The least depth in each case, over the places so far.
class LeastInEach {
 public:
  LeastInEach(const PoseUncertainty& pose, const ModelError& model, double least_m, Vec3 place_m,
              const SurfaceDepth& there)
      : centre_m_(pose.centre_m()), model_(model), binding_m_(least_m) {
    // A direction without variance, or below zero from rounding, keeps a millionth of its SD or a
    // nanometre: nothing, but it has a root.
    auto covariance = matrix_as<Root>(pose.covariance());
    covariance.diagonal() = (1.0 + 1e-12) * covariance.diagonal().array() + 1e-18;
    root_ = covariance.llt().matrixL();
    by_motion(there, place_m, binding_);
    by_model(there, place_m, binding_);
    least_m_ = static_cast<float>(binding_m_) + (standard_cases() * binding_).array();
  }

  void add(Vec3 place_m, const SurfaceDepth& there) {
    const double deeper_m = there.depth_m - binding_m_;
    DepthChange by;
    by_motion(there, place_m, by);
    const double motion_m = (by - binding_).head<6>().norm();
    if (deeper_m > kWorth_sd * std::hypot(motion_m, 2.0 * model_.sd_m)) {
      return;
    }
    by_model(there, place_m, by);
    if (deeper_m < kWorth_sd * (by - binding_).norm()) {
      least_m_ = least_m_.min(static_cast<float>(there.depth_m) + (standard_cases() * by).array());
    }
  }

  [[nodiscard]] ClearanceSpread spread() {
    ClearanceSpread out;
    for (const double clearance_m : least_m_) {
      out.grade_probability[static_cast<std::size_t>(grade_of(clearance_m))] += 1.0 / kCases;
    }
    constexpr std::size_t kBelow = kCases / 20;
    std::nth_element(least_m_.begin(), least_m_.begin() + kBelow, least_m_.end());
    out.lower_95_m = least_m_[kBelow];
    return out;
  }

 private:
  void by_motion(const SurfaceDepth& there, Vec3 place_m, DepthChange& out) const {
    const Eigen::Matrix<double, 6, 1> change =
        moves_as<Eigen::Matrix<double, 3, 6>>(place_m - centre_m_).transpose() *
        vector_as<Eigen::Vector3d>(there.deeper);
    out.head<6>() = (root_.transpose() * change).cast<float>();
  }

  void by_model(const SurfaceDepth& there, Vec3 place_m, DepthChange& out) const {
    const Vec3 wall = (place_m - there.depth_m * there.deeper) / model_.length_m;
    const double amplitude_m = model_.sd_m / std::sqrt(static_cast<double>(kWaves));
    for (Eigen::Index i = 0; i < kWaves; ++i) {
      const double phase = unit_waves()[static_cast<std::size_t>(i)].dot(wall);
      out(6 + 2 * i) = static_cast<float>(amplitude_m * std::cos(phase));
      out(7 + 2 * i) = static_cast<float>(amplitude_m * std::sin(phase));
    }
  }

  Vec3 centre_m_;
  ModelError model_;
  double binding_m_;
  DepthChange binding_;
  Root root_;  ///< lower triangle: its product with its transpose is the covariance
  Eigen::Array<float, kCases, 1> least_m_;
};

/// Calls `take(around_rad, depth)` for places evenly around the screw.
template <class Take>
void sample_row(DepthProbe& depths, const CylinderSurface& screw, double along_m, int places,
                const Take& take) {
  for (int k = 0; k < places; ++k) {
    const double around_rad = kTurn_rad * k / places;
    if (const auto depth = depths.at(screw.at(along_m, around_rad).v)) {
      take(around_rad, *depth);
    }
  }
}

/// Empty if the covariance is not finite.
std::optional<ClearanceSpread> spread_of(const SurfaceIndex& bone, const CylinderSurface& screw,
                                         const Clearance& clearance, const PoseUncertainty& pose,
                                         const ModelError& model) {
  const auto& c = pose.covariance();
  DepthProbe depths(bone);
  const auto binding = depths.at(clearance.place.v);
  if (!binding || !pose.centre_m().is_finite() ||
      !std::all_of(c.begin(), c.end(), [](double v) { return std::isfinite(v); })) {
    return std::nullopt;
  }
  LeastInEach least(pose, model, clearance.clearance_m, clearance.place.v, *binding);
  const auto add_row = [&](double along_m, int places) {
    const double half_rad = 0.5 * kTurn_rad / places;
    sample_row(depths, screw, along_m, places, [&](double around_rad, SurfaceDepth there) {
      // A sample speaks for its arc: for the place of it nearest to the wall, a plane by its depth
      // and direction. The sample itself may lie a tenth of a millimetre farther from that wall.
      const double to_wall_rad =
          std::remainder(screw.around_rad(-there.deeper) - around_rad, kTurn_rad);
      const Vec3 place_m =
          screw.at(along_m, around_rad + std::clamp(to_wall_rad, -half_rad, half_rad)).v;
      there.depth_m += there.deeper.dot(place_m - screw.at(along_m, around_rad).v);
      least.add(place_m, there);
    });
  };
  // The tip's rim is the last row of the side, the tip's middle the last of the rings.
  const auto rows = static_cast<int>(std::ceil(screw.side_m() / kRow_m));
  const auto rings = static_cast<int>(std::ceil(screw.radius_m() / kRow_m));
  for (int row = 0; row <= rows; ++row) {
    add_row(screw.side_m() * row / rows, kPlacesInRow);
  }
  for (int ring = 1; ring <= rings; ++ring) {
    add_row(screw.side_m() + screw.radius_m() * ring / rings, ring == rings ? 1 : kPlacesInRow);
  }
  return least.spread();
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

std::optional<Clearance> least_clearance(const SurfaceIndex& bone, const ScrewCylinder& screw) {
  return least_clearance_above(-std::numeric_limits<double>::infinity(), bone, screw);
}

std::optional<Clearance> least_clearance_above(double above_m, const SurfaceIndex& bone,
                                               const ScrewCylinder& screw) {
  const auto surface = CylinderSurface::of(screw);
  if (!surface) {
    return std::nullopt;
  }
  LeastDepth least(above_m, bone, *surface);
  return least.search() ? std::optional(least.found()) : std::nullopt;
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
    least_m[i] = 1e9;
    sample_row(depths, *surface, surface->side_m() * (static_cast<double>(i) / steps), kRimPlaces,
               [&](double, const SurfaceDepth& depth) {
                 least_m[i] = std::min(least_m[i], depth.depth_m);
               });
  }
  return true;
}

std::optional<ScrewClearance> screw_clearance(const SurfaceIndex& bone, const ScrewCylinder& screw,
                                              const PoseUncertainty* pose,
                                              const ModelError& model) {
  const auto least = least_clearance(bone, screw);
  if (!least) {
    return std::nullopt;
  }
  ScrewClearance out{*least, std::nullopt};
  if (pose != nullptr) {
    out.spread = spread_of(bone, *CylinderSurface::of(screw), *least, *pose, model);
  }
  return out;
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
