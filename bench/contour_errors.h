#pragma once

#include <memory>
#include <vector>

#include "engine/live/bone_lines.h"

namespace orthonav {

/// How far the lines drawn for a bone lie from their true places as the eyes see them: distances
/// across the line of sight, at the bone's depth.
struct ContourErrors {
  std::vector<double> drawn_mm;   ///< from each millimetre of what is drawn to the true contour
  std::vector<double> missed_mm;  ///< from each millimetre of the true outline to what is drawn
};

/// Measures them for a bone drawn for the point between the eyes and seen by both eyes.
class ContourBench {
 public:
  /// `bone` lies about the origin, metres.
  explicit ContourBench(std::shared_ptr<const render::MeshData> bone);

  /// At rest, from many sides; `on_a_quad` as a picture in the plane through the bone's middle that
  /// faces the head, instead of lines in space.
  [[nodiscard]] ContourErrors at_rest(bool on_a_quad) const;
  /// The head goes around the bone at this speed; the drawing was made for its place
  /// `kShownAfter_s` ago.
  [[nodiscard]] ContourErrors in_motion(double rotation_rad_s, bool on_a_quad) const;
  /// Mean number of pieces from those sides.
  [[nodiscard]] double pieces() const;

 private:
  void judge(const std::vector<engine::StraightPiece>& drawn, render::Float3 head,
             ContourErrors& errors) const;

  render::MeshItem item_;
  engine::SurfaceContours truth_;
};

}  // namespace orthonav
