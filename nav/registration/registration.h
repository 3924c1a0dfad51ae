#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/api/result.h"
#include "hal/api/transform.h"
#include "nav/geometry/closest_grid.h"
#include "nav/geometry/mesh.h"
#include "nav/registration/principal_axes.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// The preoperative vertebra, prepared once: its mesh (frame Vertebra: LPS axes, metres), the part
/// a pointer can reach from behind, and their indices.
class VertebraModel {
 public:
  static Result<std::shared_ptr<const VertebraModel>> prepare(TriangleMesh mesh);
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SurfaceIndex& surface() const { return surface_; }
  /// The posterior part: what is left after trimming what a pointer can't reach.
  [[nodiscard]] const TriangleMesh& reachable() const { return reachable_; }
  [[nodiscard]] const SurfaceIndex& reachable_surface() const { return reachable_surface_; }
  /// Its closest points, roughly and fast.
  [[nodiscard]] const ClosestGrid& reachable_grid() const { return reachable_grid_; }
  /// Principal axes of the reachable surface (by area) and its extreme points along them.
  [[nodiscard]] const PrincipalAxes& reachable_axes() const { return reachable_axes_; }
  [[nodiscard]] const std::array<Vec3, 6>& reachable_extremes() const { return extremes_; }

 private:
  VertebraModel(TriangleMesh mesh, TriangleMesh reachable, SurfaceIndex surface);
  TriangleMesh mesh_;
  TriangleMesh reachable_;
  SurfaceIndex surface_;
  SurfaceIndex reachable_surface_;
  ClosestGrid reachable_grid_;
  PrincipalAxes reachable_axes_;
  std::array<Vec3, 6> extremes_;
};

struct RegistrationOptions {
  std::size_t min_points = 100;
  int max_iterations = 200;
  double converged_m = 1e-8;  ///< change of the RMSE that ends ICP; it creeps towards its end
  double max_rmse_m = 0.003;  ///< above: refused
  /// Runner-up RMSE / RMSE that is still taken. With full strokes a wrong pose fits at least twice
  /// as badly; where two fit alike, the strokes don't tell.
  double min_runner_up_ratio = 1.25;
  /// Error to expect at the model's centre (nav/registration/tre.h); above: refused.
  double max_predicted_tre_m = 0.003;
};

/// What registration says. `accepted` false: `reasons` tells why, nothing may be guided on it.
struct Registration {
  bool accepted = false;
  std::vector<std::string> reasons;
  Transform<World, Vertebra> world_from_vertebra;
  double rmse_m = 0.0;
  double runner_up_rmse_m = 0.0;
  Transform<World, Vertebra> runner_up;
  int iterations = 0;
  std::size_t points = 0;
  /// What the points leave open; absent when a whole motion is.
  std::optional<PoseUncertainty> uncertainty;
  /// Root mean square error to expect at the centre of the model; infinite when a motion is open.
  double predicted_tre_m = 0.0;
};

/// The published method: PCA extreme points (paper eq. 1) give the coarse poses, of which the two
/// best configurations remain (nav/registration/coarse.h says where it goes further than eq. 2),
/// ICP (Besl & McKay 1992) refines both on the reachable surface, the smaller RMSE wins. An Error
/// means unusable input (too few, collinear, non-finite points).
Result<Registration> register_paper(const VertebraModel& model,
                                    std::span<const Point<World>> points_in_world,
                                    const RegistrationOptions& options = {});

}  // namespace orthonav::nav
