#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

#include "bench/registration_peers.h"

namespace orthonav::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// PCL computes in single precision and its thresholds suit numbers near one: millimetres about the
/// cloud's own centre.
constexpr double kMillimetres = 1e3;
/// Farther pairs are left out. The starts are several millimetres off.
constexpr double kFarthestPair_mm = 10.0;
constexpr int kMaxIterations = 200;

pcl::PointXYZ point_mm(Vec3 p_m) {
  return {static_cast<float>(p_m.x * kMillimetres), static_cast<float>(p_m.y * kMillimetres),
          static_cast<float>(p_m.z * kMillimetres)};
}

Eigen::Matrix4f matrix_mm(const Transform<Vertebra, World>& pose) {
  const auto a = pose.row_major();
  Eigen::Matrix4f m;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      m(r, c) = static_cast<float>(a[static_cast<std::size_t>(4 * r + c)] *
                                   (c == 3 && r < 3 ? kMillimetres : 1.0));
    }
  }
  return m;
}

Result<Transform<Vertebra, World>> pose_of(const Eigen::Matrix4f& m) {
  std::array<double, 16> a{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      a[static_cast<std::size_t>(4 * r + c)] =
          static_cast<double>(m(r, c)) / (c == 3 && r < 3 ? kMillimetres : 1.0);
    }
  }
  return Transform<Vertebra, World>::from_row_major(a);
}

/// Refines both starts and takes the one with the smaller mean squared distance.
template <class Icp>
Fitted best_of_starts(Icp& icp, std::span<const SurfaceSample> model,
                      std::span<const Point<World>> points) {
  Vec3 centre{};
  for (const Point<World>& point : points) {
    centre += point.v / static_cast<double>(points.size());
  }
  const auto cloud = pcl::make_shared<Cloud>();
  for (const Point<World>& point : points) {
    cloud->push_back(point_mm(point.v - centre));
  }
  const Transform<World, World> from_centred(Mat3::identity(), centre);
  icp.setInputSource(cloud);
  Fitted best;
  double best_score = 0.0;
  Cloud aligned;
  for (const auto& start : published_starts(model, points)) {
    icp.align(aligned, matrix_mm(start * from_centred));
    const auto pose = pose_of(icp.getFinalTransformation());
    const double score = icp.getFitnessScore();
    if (!pose || (best.found && score >= best_score)) {
      continue;
    }
    best.found = true;
    best_score = score;
    best.world_from_vertebra = from_centred * pose->inverse();
  }
  return best;
}

template <class Icp>
Fit prepared(const BenchLevel& level) {
  const auto target = pcl::make_shared<Cloud>();
  const auto samples = surface_samples(level.model->reachable(), kPeerModelPoints);
  for (const SurfaceSample& s : samples) {
    target->push_back(point_mm(s.point_m));
  }
  const auto icp = std::make_shared<Icp>();
  icp->setInputTarget(target);
  icp->setMaxCorrespondenceDistance(kFarthestPair_mm);
  icp->setMaximumIterations(kMaxIterations);
  icp->setTransformationEpsilon(1e-8);
  // Data that PCL computes from the target alone (its tree, GICP's covariances) is not part of a
  // timed run.
  icp->setInputSource(target);
  Cloud aligned;
  icp->align(aligned);
  return [icp, model = exposed(samples, level.screws)](std::span<const Point<World>> points,
                                                       std::span<const double>) {
    return best_of_starts(*icp, model, points);
  };
}

}  // namespace

std::vector<RegistrationMethod> pcl_methods() {
  using Icp = pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;
  using Gicp = pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;
  return {{"PCL ICP", prepared<Icp>}, {"PCL GICP", prepared<Gicp>}};
}

}  // namespace orthonav::bench
