#pragma once

#include <optional>
#include <string>

#include "base/transform.h"
#include "engine/io/patient_axes.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// How far a screw lies to the patient's left (+x) of its bone's midline.
struct OffMidline {
  double entry_m = 0.0;
  double target_m = 0.0;

  /// The target lies on the other side than the entry, and farther off: a translaminar screw, which
  /// is named after the lamina that it ends in.
  [[nodiscard]] bool crosses() const;
  /// The side of the entry. None if it lies within 5 mm of the midline, or the screw crosses.
  [[nodiscard]] std::optional<nav::Side> side() const;
};

/// The entry's distance from the midline from which the side is certain. The middle of the box,
/// which is used as the midline, is off by up to 3.5 mm if the transverse processes differ in
/// length; entries into lumbar pedicles lie 16 mm or more from it.
inline constexpr double kLeastOffMidline_m = 0.005;

/// The midline is the middle of the box around the bone.
[[nodiscard]] OffMidline off_midline(const nav::TriangleMesh& bone, Point<Vertebra> entry,
                                     Point<Vertebra> target);

/// "20.9 mm to the left".
[[nodiscard]] std::string to_the_side(double left_m);

/// Why it can't be a pedicle screw, such as "has radius 8.0 mm, must be 1.0 mm to 6.0 mm"; none if
/// it can. A radius of 0: not stated.
[[nodiscard]] std::optional<std::string> ill_sized(Point<Vertebra> entry, Point<Vertebra> target,
                                                   double radius_m);

/// Why a screw can't belong to this bone, or is written in other axes (+y is posterior), such as
/// "entry lies 15.0 mm off the bone, limit 10.0 mm"; none if it can.
[[nodiscard]] std::optional<std::string> misplaced(const nav::SurfaceIndex& bone,
                                                   Point<Vertebra> entry, Point<Vertebra> target,
                                                   double radius_m);

/// The same for a screw from a file that states its axes; the problem also says so if the screw
/// would fit in the other axes, and asks for the level where the entry is off the bone in both.
[[nodiscard]] std::optional<std::string> misplaced(const nav::SurfaceIndex& bone,
                                                   Point<Vertebra> entry, Point<Vertebra> target,
                                                   double radius_m, Axes stated);

}  // namespace orthonav::engine
