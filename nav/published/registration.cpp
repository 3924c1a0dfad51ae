#include "nav/published/registration.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/reason.h"
#include "base/translation.h"
#include "nav/geometry/absolute_orientation.h"
#include "nav/geometry/principal_axes.h"

namespace orthonav::nav::published {

ExtremePoints extreme_points(std::span<const Vec3> points_m) {
  const PrincipalAxes axes = principal_axes(points_m);
  const auto along = [&axes](std::size_t axis, Vec3 p) {
    return axes.axes[axis].dot(p - axes.centre_m);
  };
  const auto by_first = [&along](Vec3 a, Vec3 b) { return along(0, a) < along(0, b); };
  const auto by_second = [&along](Vec3 a, Vec3 b) {
    return std::abs(along(1, a)) < std::abs(along(1, b));
  };
  return {*std::max_element(points_m.begin(), points_m.end(), by_first),
          *std::min_element(points_m.begin(), points_m.end(), by_first),
          *std::max_element(points_m.begin(), points_m.end(), by_second)};
}

Result<std::array<Transform<World, Vertebra>, 2>> coarse_poses(const ExtremePoints& of_model,
                                                               const ExtremePoints& digitized) {
  const std::array<Vec3, 3> model_m{of_model.e1, of_model.e2, of_model.e3};
  const auto as_named =
      absolute_orientation(model_m, std::array<Vec3, 3>{digitized.e1, digitized.e2, digitized.e3});
  const auto exchanged =
      absolute_orientation(model_m, std::array<Vec3, 3>{digitized.e2, digitized.e1, digitized.e3});
  if (!as_named || !exchanged) {
    return refused(
        {translatable("registration finds no pose: the extreme points of the strokes, "
                      "or of the model, lie on a line")});
  }
  return std::array<Transform<World, Vertebra>, 2>{
      {{as_named->rotation, as_named->translation_m},
       {exchanged->rotation, exchanged->translation_m}}};
}

Result<std::array<IcpResult, 2>> register_points(const TriangleMesh& trimmed,
                                                 const SurfaceIndex& surface,
                                                 std::span<const Point<World>> digitized) {
  std::vector<Vec3> digitized_m(digitized.size());
  std::transform(digitized.begin(), digitized.end(), digitized_m.begin(),
                 [](const Point<World>& p) { return p.v; });
  const auto coarse = coarse_poses(extreme_points(trimmed.vertices_m), extreme_points(digitized_m));
  if (!coarse) {
    return coarse.error();
  }
  std::array<IcpResult, 2> refined;
  for (std::size_t i = 0; i < refined.size(); ++i) {
    const auto icp = refine_icp(surface, digitized, (*coarse)[i]);
    if (!icp) {
      return icp.error();
    }
    refined[i] = *icp;
  }
  if (refined[1].rmse_m < refined[0].rmse_m) {
    std::swap(refined[0], refined[1]);
  }
  return refined;
}

}  // namespace orthonav::nav::published
