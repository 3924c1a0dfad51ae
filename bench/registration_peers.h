#pragma once

#include <span>
#include <vector>

#include "bench/registration_methods.h"

namespace orthonav::bench {

/// PCL's ICP and GICP, each from both published starts; the smaller RMSE counts. Only where PCL was
/// found (ORTHONAV_BENCH_PCL).
[[nodiscard]] std::vector<RegistrationMethod> pcl_methods();

/// Open3D's FPFH, RANSAC over matched features, then ICP. Only where Open3D was found
/// (ORTHONAV_BENCH_OPEN3D).
[[nodiscard]] std::vector<RegistrationMethod> open3d_methods();

struct SurfaceSample {
  Vec3 point_m;
  Vec3 normal;
};
/// Points on a surface with uniform density, which peers that take points use as the model. The
/// same in every call.
[[nodiscard]] std::vector<SurfaceSample> surface_samples(const nav::TriangleMesh& mesh,
                                                         std::size_t count);
/// The part of these points that such an operation exposes, out to a little beyond the entry
/// points: the published method trims its model to it by hand.
[[nodiscard]] std::vector<SurfaceSample> exposed(const std::vector<SurfaceSample>& samples,
                                                 const std::vector<nav::ScrewPlan>& screws);

/// The two published starts (Liebmann et al. 2019, eq. 1 and 2), with the sampled surface as the
/// model's points. Empty for strokes on a line.
[[nodiscard]] std::vector<Transform<Vertebra, World>> published_starts(
    std::span<const SurfaceSample> model, std::span<const Point<World>> points);

/// The number of points per model: about one per square millimetre.
inline constexpr std::size_t kPeerModelPoints = 8000;

}  // namespace orthonav::bench
