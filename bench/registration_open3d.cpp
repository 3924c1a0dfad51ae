#include <omp.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/CorrespondenceChecker.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <open3d/utility/Random.h>

#include <mutex>

#include "bench/registration_peers.h"

namespace orthonav::bench {
namespace {

namespace o3d = open3d::pipelines::registration;
using open3d::geometry::KDTreeSearchParamHybrid;
using open3d::geometry::PointCloud;

// As in Open3D's own tutorial on global registration: everything in multiples of the voxel.
constexpr double kVoxel_mm = 2.0;
constexpr double kNormalRadius_mm = 2.0 * kVoxel_mm;
constexpr double kFeatureRadius_mm = 5.0 * kVoxel_mm;
constexpr double kRansacPair_mm = 1.5 * kVoxel_mm;
constexpr double kIcpPair_mm = 2.5 * kVoxel_mm;
constexpr double kMillimetres = 1e3;

Eigen::Vector3d eigen_mm(Vec3 v_m) { return kMillimetres * Eigen::Vector3d(v_m.x, v_m.y, v_m.z); }

struct Described {
  std::shared_ptr<PointCloud> cloud;
  std::shared_ptr<o3d::Feature> features;
};

/// Downsampled, with normals and features. The strokes' frame is unknown: normals point away from
/// the cloud's centre, those of the model too, so that both follow one rule.
Described described(const PointCloud& dense) {
  Described d;
  d.cloud = dense.VoxelDownSample(kVoxel_mm);
  d.cloud->EstimateNormals(KDTreeSearchParamHybrid(kNormalRadius_mm, 30));
  d.cloud->OrientNormalsTowardsCameraLocation(d.cloud->GetCenter());
  for (Eigen::Vector3d& normal : d.cloud->normals_) {
    normal = -normal;
  }
  d.features = o3d::ComputeFPFHFeature(*d.cloud, KDTreeSearchParamHybrid(kFeatureRadius_mm, 100));
  return d;
}

Result<Transform<Vertebra, World>> pose_of(const Eigen::Matrix4d& m) {
  std::array<double, 16> a{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      a[static_cast<std::size_t>(4 * r + c)] = m(r, c) / (c == 3 && r < 3 ? kMillimetres : 1.0);
    }
  }
  return Transform<Vertebra, World>::from_row_major(a);
}

Eigen::Matrix4d aligned(const Described& strokes, const PointCloud& all_strokes,
                        const Described& model, const PointCloud& whole_model) {
  const o3d::CorrespondenceCheckerBasedOnEdgeLength edges(0.9);
  const o3d::CorrespondenceCheckerBasedOnDistance distances(kRansacPair_mm);
  const auto coarse = o3d::RegistrationRANSACBasedOnFeatureMatching(
      *strokes.cloud, *model.cloud, *strokes.features, *model.features, true, kRansacPair_mm,
      o3d::TransformationEstimationPointToPoint(false), 3, {edges, distances},
      o3d::RANSACConvergenceCriteria(100000, 0.999));
  return o3d::RegistrationICP(all_strokes, whole_model, kIcpPair_mm, coarse.transformation_,
                              o3d::TransformationEstimationPointToPlane(),
                              o3d::ICPConvergenceCriteria(1e-8, 1e-8, 100))
      .transformation_;
}

Fit prepared(const BenchLevel& level) {
  const auto whole = std::make_shared<PointCloud>();
  for (const SurfaceSample& s : surface_samples(level.model->reachable(), kPeerModelPoints)) {
    whole->points_.push_back(eigen_mm(s.point_m));
    whole->normals_.emplace_back(s.normal.x, s.normal.y, s.normal.z);
  }
  return [whole, model = described(*whole)](std::span<const Point<World>> points,
                                            std::span<const double>) {
    // Open3D's random generator belongs to the process: one fit at a time, each from the same seed.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    open3d::utility::random::Seed(1);
    omp_set_num_threads(1);  // one core, as for the others, and the same draws every time
    PointCloud strokes;
    for (const Point<World>& point : points) {
      strokes.points_.push_back(eigen_mm(point.v));
    }
    Fitted fitted;
    const auto pose = pose_of(aligned(described(strokes), strokes, model, *whole));
    if (!pose) {
      return fitted;
    }
    fitted.found = true;
    fitted.world_from_vertebra = pose->inverse();
    return fitted;
  };
}

}  // namespace

std::vector<RegistrationMethod> open3d_methods() {
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  return {{"Open3D FPFH", prepared}};
}

}  // namespace orthonav::bench
