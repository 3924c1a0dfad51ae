#include "engine/case/likely_mistakes.h"

#include <algorithm>
#include <cmath>

#include "base/printed.h"
#include "engine/io/patient_axes.h"
#include "nav/planning/canal.h"

namespace orthonav::engine {
namespace {

bool shows_canal(const nav::TriangleMesh& mesh) {
  return nav::find_canal(mesh, nav::SurfaceIndex(mesh)).has_value();
}

}  // namespace

Result<bool> has_canal(const nav::TriangleMesh& vertebra) {
  if (shows_canal(vertebra)) {
    return true;
  }
  nav::TriangleMesh turned = vertebra;
  for (Vec3& v : turned.vertices_m) {
    v = to_lps(v, Axes::kRas);
  }
  if (shows_canal(turned)) {
    return Error{
        "faces backward: its axes are RAS and not LPS, or LPS and not RAS (--frame, or SPACE= in "
        "the file)"};
  }
  return false;
}

Status check_scale(std::span<const Vec3> points_m, bool unit_stated) {
  constexpr double kLeast_m = 0.001, kMost_m = 10.0;
  if (points_m.size() < 2) {
    return {};
  }
  Vec3 low = points_m[0], high = points_m[0];
  for (const Vec3& p : points_m) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const double across_m = (high - low).norm();
  if (across_m >= kLeast_m && across_m <= kMost_m) {
    return {};
  }
  const bool small = across_m < kLeast_m;
  return Error{printed("its points are %.3g mm across, must be 1 mm to 10 m: are they in %s? ",
                       across_m * 1e3, small ? "metres" : "millimetres") +
               (unit_stated ? "Its unit is stated in the file"
                            : std::string("State it with --units ") + (small ? "m" : "mm"))};
}

}  // namespace orthonav::engine
