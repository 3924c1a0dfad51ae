#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/random.h"
#include "nav/geometry/mesh.h"
#include "nav/registration/search.h"

namespace orthonav::test {

/// A box-like bone of 70 x 20 x 50 mm whose back (+y) is `height_m(x, z)` high. Closed, outward-
/// oriented; as symmetric as its height is.
nav::TriangleMesh slab_bone(const std::function<double(double, double)>& height_m);

/// A back with an oblique crest and two unequal knobs: no motion maps it onto itself.
double crooked_back(double x, double z);
/// A back that is the same after half a turn about y, so two poses fit.
double twofold_back(double x, double z);

/// Places on the surface itself, as strokes from left to right and back pass over them: seen
/// straight from behind, about 0.7 mm apart.
std::vector<Vec3> strokes_over(const nav::SurfaceIndex& surface, std::size_t lanes);

/// Points about their centre, somewhere in the world, and where the bone then is.
struct CentredPoints {
  std::vector<Vec3> points_m;
  nav::CentredPose truth;
};
CentredPoints centred_somewhere(std::span<const Vec3> in_vertebra_m, Random& random);

/// The pose moved by so much along and about random axes.
nav::CentredPose moved(const nav::CentredPose& pose, double translation_m, double rotation_rad,
                       Random& random);

/// The largest distance, over the corners of a box of 60 mm about the points, between their places
/// by the two poses.
double apart_m(const nav::CentredPose& a, const nav::CentredPose& b);

/// A new sequence of correlated noise with SD 1, for points 1/30 s apart.
std::vector<double> wandering(std::size_t count, double correlation_s, Random& random);

}  // namespace orthonav::test
