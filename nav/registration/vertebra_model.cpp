#include <utility>

#include "nav/registration/registration.h"
#include "nav/registration/trimming.h"

namespace orthonav::nav {

Result<std::shared_ptr<const VertebraModel>> VertebraModel::prepare(TriangleMesh mesh) {
  auto checked = checked_vertebra(std::move(mesh));
  if (!checked) return checked.error();
  SurfaceIndex surface(*checked);
  TriangleMesh reachable = reachable_from_behind(*checked, surface);
  if (reachable.triangles.empty())
    return Error{"model has no surface that a pointer can reach from behind (+y): its axes must be "
                 "LPS"};
  return std::shared_ptr<const VertebraModel>(
      new VertebraModel(std::move(*checked), std::move(reachable), std::move(surface)));
}

VertebraModel::VertebraModel(TriangleMesh mesh, TriangleMesh reachable, SurfaceIndex surface)
    : mesh_(std::move(mesh)),
      reachable_(std::move(reachable)),
      surface_(std::move(surface)),
      reachable_surface_(reachable_) {}

}  // namespace orthonav::nav
