#include <utility>

#include "nav/geometry/triangle.h"
#include "nav/registration/registration.h"
#include "nav/registration/trimming.h"

namespace orthonav::nav {
namespace {

// Fine enough to tell crests apart, coarse enough to be made in a fraction of a second.
constexpr double kGridCell_m = 0.003;
constexpr double kGridMargin_m = 0.02;

/// By area, so that a finely meshed corner counts no more than it is large.
PrincipalAxes axes_by_area(const TriangleMesh& mesh) {
  std::vector<Vec3> centres_m;
  std::vector<double> areas_m2;
  for (const auto& t : mesh.triangles) {
    const Triangle corners{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    centres_m.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    areas_m2.push_back(triangle_area_m2(corners));
  }
  return principal_axes(centres_m, areas_m2);
}

}  // namespace

Result<std::shared_ptr<const VertebraModel>> VertebraModel::prepare(TriangleMesh mesh) {
  auto checked = checked_vertebra(std::move(mesh));
  if (!checked) return checked.error();
  SurfaceIndex surface(*checked);
  TriangleMesh reachable = reachable_from_behind(*checked, surface);
  if (reachable.triangles.empty())
    return Error{
        "model has no surface that a pointer can reach from behind (+y): its axes must be "
        "LPS"};
  return std::shared_ptr<const VertebraModel>(
      new VertebraModel(std::move(*checked), std::move(reachable), std::move(surface)));
}

VertebraModel::VertebraModel(TriangleMesh mesh, TriangleMesh reachable, SurfaceIndex surface)
    : mesh_(std::move(mesh)),
      reachable_(std::move(reachable)),
      surface_(std::move(surface)),
      reachable_surface_(reachable_),
      reachable_grid_(reachable_, reachable_surface_, kGridCell_m, kGridMargin_m),
      reachable_axes_(axes_by_area(reachable_)),
      extremes_(extreme_points(reachable_.vertices_m, reachable_axes_)),
      search_field_(reachable_, reachable_surface_, surface_) {}

}  // namespace orthonav::nav
