#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::nav {

/// The tool that makes the bends.
struct RodBender {
  /// Length of the rod's axis that one bend curves, evenly; also the least distance between the
  /// middles of two bends. Estimate for a French bender.
  double width_m = 0.020;
  /// Radius of the rod's axis over the die: it can't be bent more tightly. Estimate.
  double die_radius_m = 0.020;
};

/// One bend of a trial: the angle to which the bender was set and the angle that remained.
struct SpringBackTrial {
  double set_rad = 0.0;
  double kept_rad = 0.0;
};

struct RodMaterial {
  std::string name = "Ti-6Al-4V";
  double yield_pa = 758e6;
  double modulus_pa = 114e9;
  /// Strain at which a bar may break in tension (ASTM F136: at least 10 %); no outer fibre is
  /// strained further.
  double elongation = 0.10;
  /// If not empty, used instead of yield and modulus: trials with this bender and this kind of rod,
  /// both angles rising from one to the next; interpolated linearly from zero to the first and
  /// between them.
  std::vector<SpringBackTrial> trials;
};

/// A diameter with its bender and its material, checked.
class RodSpringBack {
 public:
  /// Refuses, with value and limit: widths outside 2-100 mm, die radii outside 1-500 mm, diameters
  /// that no rod has, material values that are not those of a metal, trials that do not rise, keep
  /// more than was set, or go beyond 120°.
  static Result<RodSpringBack> of(const RodBender& bender, const RodMaterial& material,
                                  double diameter_m);

  /// The angle that remains of a bend after the bender is released; 0 if the bend was only elastic.
  /// Without trials, the model is a round bar of a material that yields at a constant stress: the
  /// curvature M/(EI) springs back, with the moment M from the stress over the section. It tends to
  /// 1.70 · 2σ_y / (E d) for wide angles, the formula of `study rods`, and is less for small ones.
  [[nodiscard]] double kept_rad(double set_rad) const;
  /// The angle to set so that the given angle remains. Refuses, in one line, negative angles, a
  /// curve below the smallest radius on the bender, and an angle beyond the last trial.
  [[nodiscard]] Result<double> set_rad(double kept_rad) const;
  /// The largest angle that `set_rad` takes.
  [[nodiscard]] double most_kept_rad() const;
  /// Smallest radius of the rod's axis on the bender: the die's, or the one at which the outer
  /// fibre reaches `elongation`.
  [[nodiscard]] double smallest_radius_m() const;
  [[nodiscard]] double width_m() const { return bender_.width_m; }
  [[nodiscard]] double diameter_m() const { return diameter_m_; }

 private:
  RodSpringBack(RodBender bender, RodMaterial material, double diameter_m);

  RodBender bender_;
  RodMaterial material_;
  double diameter_m_ = 0.0;
};

}  // namespace orthonav::nav
