#pragma once

#include <string>
#include <vector>

#include "base/vec.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// The measures of one lumbar vertebra, metres and radians; data/phantom.json holds them with their
/// sources.
struct VertebraMorphometry {
  std::string label;
  double upper_width_m = 0, lower_width_m = 0;  ///< of the endplates, left to right
  double upper_depth_m = 0, lower_depth_m = 0;  ///< front to back
  double anterior_height_m = 0, posterior_height_m = 0;
  double canal_width_m = 0, canal_depth_m = 0;
  double pedicle_width_m = 0, pedicle_height_m = 0;
  double pedicle_transverse_rad =
      0;                            ///< the axis turns this much towards the middle, going forwards
  double pedicle_sagittal_rad = 0;  ///< and this much upwards
  double transverse_span_m = 0;     ///< tip to tip
  double transverse_height_m = 0, transverse_thickness_m = 0;
  double transverse_back_m = 0, transverse_rise_m = 0;  ///< of the tip from the root
  double spinous_length_m = 0;                          ///< from the back of the canal to the tip
  double spinous_height_m = 0, spinous_thickness_m = 0;
  double spinous_drop_m = 0;       ///< of the tip below the root
  double spinous_deviation_m = 0;  ///< of the tip to the left
  /// Distance between the middles of the left and right facet, their size, and the angle by which
  /// they are turned from facing straight back (0) to facing the middle (π/2).
  double superior_distance_m = 0, superior_height_m = 0, superior_width_m = 0;
  double superior_rotation_rad = 0;
  double inferior_distance_m = 0, inferior_height_m = 0, inferior_width_m = 0;
  double inferior_rotation_rad = 0;
  double inferior_drop_m = 0;  ///< of the lower tips below the middle of the pedicles
  double disc_height_m = 0, disc_wedge_rad = 0;  ///< of the disc below

  [[nodiscard]] double depth_m() const { return 0.5 * (upper_depth_m + lower_depth_m); }
  [[nodiscard]] double height_m() const { return 0.5 * (anterior_height_m + posterior_height_m); }
  /// Angle between the endplates.
  [[nodiscard]] double wedge_rad() const;
};

/// A vertebra as an implicit surface: body, pedicles, laminae, articular, transverse and spinous
/// processes, blended smoothly, minus the canal. Frame Vertebra: LPS, metres, origin at the middle
/// of the body.
class VertebraShape {
 public:
  explicit VertebraShape(const VertebraMorphometry& m);
  /// Negative inside; close to the distance near the surface.
  [[nodiscard]] double value(Vec3 p) const;
  /// A point on a pedicle's axis (at its waist) and the unit direction forwards.
  [[nodiscard]] nav::Axis<Vertebra> pedicle_axis(nav::Side side) const;
  /// A box that holds the shape with 4 mm to spare.
  [[nodiscard]] Vec3 low_m() const;
  [[nodiscard]] Vec3 high_m() const;

 private:
  /// A tapered bar with elliptic section and round ends.
  struct Bar {
    Vec3 from, to;
    Vec3 along, across, normal;  ///< unit; `normal` is the thin direction
    double length = 0;
    double width_from = 0, width_to = 0;          ///< half, across
    double thickness_from = 0, thickness_to = 0;  ///< half, along the normal
    [[nodiscard]] double value(Vec3 p) const;
  };
  static Bar bar(Vec3 from, Vec3 to, Vec3 normal, Vec2 widths, Vec2 thicknesses);
  [[nodiscard]] double body(Vec3 p) const;
  [[nodiscard]] double canal(Vec3 p) const;
  void add_pedicle_and_transverse_process();
  void add_articular_processes();
  void add_lamina();
  void add_spinous_process();
  [[nodiscard]] Vec3 straightened(Vec3 p) const;

  VertebraMorphometry m_;
  double back_of_body_m_ = 0;
  double body_reach_m_ = 0;     ///< from its axis, at most
  Vec3 pedicle_waist_;          ///< of the left one
  std::vector<Bar> left_bars_;  ///< the right ones are their mirror images
  std::vector<Bar> middle_bars_;
};

}  // namespace orthonav::engine
