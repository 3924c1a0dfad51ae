#include "bench/tracking_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <Eigen/Dense>

#include "base/stopwatch.h"
#include "bench/quantile.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::bench {
namespace {

/// A tag counts as visible when at least this fraction of it is free in both images.
constexpr double kVisible = 0.9;
/// From this visible fraction on, seeing the tag does not count as a ghost.
constexpr double kGlimpsed = 0.02;
/// Acquisition is not part of the accuracy.
constexpr std::size_t kWarmUp = 5;
/// By then a tool at rest has been averaged.
constexpr std::size_t kSettled = 60;
/// Fewer poses are not enough to measure jitter.
constexpr std::size_t kFewestAtRest = 10;
/// A tip that stays within this of one place in World is at rest.
constexpr double kRestM = 1e-6;

double nees_of(const Transform<Rig, Marker>& truth, const Seen& seen) {
  const Vec3 translation = seen.rig_from_marker.translation() - truth.translation();
  const Vec3 rotation =
      vector_from_rotation(seen.rig_from_marker.rotation() * truth.rotation().transposed());
  Eigen::Matrix<double, 6, 1> e;
  e << translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z;
  const Eigen::Map<const Eigen::Matrix<double, 6, 6>> c(seen.covariance_in_rig.data());
  return e.dot(c.ldlt().solve(e));
}

bool is_elsewhere(const Transform<Rig, Marker>& pose, const Transform<Rig, Marker>& truth,
                  double size_m) {
  for (const Vec3 corner : nav::corners_in_marker(size_m)) {
    if ((pose * Point<Marker>{corner} - truth * Point<Marker>{corner}).norm() > 0.5 * size_m) {
      return true;
    }
  }
  return false;
}

template <class CameraFrame>
bool is_there(const Sighting& sighting, const CameraModel& camera,
              const Transform<CameraFrame, Rig>& camera_from_rig,
              const Transform<Rig, Marker>& truth, double size_m) {
  const auto camera_from_marker = camera_from_rig * truth;
  const auto centre = camera.project(camera_from_marker.translation());
  if (!centre) {
    return false;
  }
  double farthest = 0.0;
  for (const Vec3 corner : nav::corners_in_marker(0.5 * size_m)) {
    const auto seen = camera.project((camera_from_marker * Point<Marker>{corner}).v);
    if (seen) {
      farthest = std::max(farthest, (*seen - *centre).norm());
    }
  }
  return (sighting.centre_px - *centre).norm() <= farthest;
}

bool is_ghost(const Sequence& sequence, std::size_t pair, const Sighting& sighting) {
  const StereoCalibration& c = sequence.calibration;
  for (std::size_t i = 0; i < sequence.tools.size(); ++i) {
    const nav::MarkerDefinition& marker = sequence.tools[i].marker;
    if (sighting.id != marker.id || sequence.visible[pair][i][sighting.right ? 1 : 0] < kGlimpsed) {
      continue;
    }
    const auto& truth = sequence.rig_from_marker[pair][i];
    if (sighting.right ? is_there(sighting, c.right, c.right_from_rig, truth, marker.size_m)
                       : is_there(sighting, c.left, c.left_from_rig, truth, marker.size_m)) {
      return false;
    }
  }
  return true;
}

void add_errors(const Transform<Rig, Marker>& truth, const Seen& seen, Point<Marker> tip,
                Figures& f) {
  const Transform<Rig, Marker>& pose = seen.rig_from_marker;
  f.count += 1;
  f.position += (pose.translation() - truth.translation()).squared_norm();
  f.rotation += std::pow(rotation_angle_rad(pose.rotation(), truth.rotation()), 2);
  f.tip += (pose * tip - truth * tip).squared_norm();
  if (!seen.has_covariance) {
    return;
  }
  f.nees += nees_of(truth, seen);
  f.nees_count += 1;
}

/// Where a tool's tip was in World, and where the method put it.
struct TipPath {
  std::vector<Vec3> truth;
  std::vector<Vec3> found;
};

void add_jitter(const std::vector<TipPath>& paths, Figures& f) {
  for (const TipPath& path : paths) {
    if (path.truth.size() < kFewestAtRest) {
      continue;
    }
    Vec3 mean{};
    for (const Vec3 p : path.found) {
      mean += p / static_cast<double>(path.found.size());
    }
    for (std::size_t i = 0; i < path.truth.size(); ++i) {
      if ((path.truth[i] - path.truth[0]).norm() > kRestM) {
        return;
      }
    }
    for (const Vec3 p : path.found) {
      f.jitter += (p - mean).squared_norm();
    }
    f.jitters += static_cast<double>(path.found.size());
  }
}

}  // namespace

Figures measure(const Sequence& sequence, const Track& track) {
  Figures f;
  Claims claims;
  const std::size_t tools = sequence.tools.size();
  std::vector<TipPath> tips(tools);
  std::vector<int> unseen(tools, 0);
  for (std::size_t k = 0; k < sequence.frames.size(); ++k) {
    claims.tools.assign(tools, {});
    claims.sightings.clear();
    const Stopwatch watch;
    track(sequence.frames[k], claims);
    const double took_ms = watch.elapsed_ms();
    if (k >= kWarmUp) {
      f.ms.push_back(took_ms);
    }
    for (const Sighting& sighting : claims.sightings) {
      f.ghosts += is_ghost(sequence, k, sighting);
    }
    for (std::size_t i = 0; i < tools; ++i) {
      const auto& fraction = sequence.visible[k][i];
      const Seen& seen = claims.tools[i];
      const bool visible = std::min(fraction[0], fraction[1]) >= kVisible;
      f.visible += visible ? 1 : 0;
      f.seen += visible && seen.seen ? 1 : 0;
      unseen[i] = visible && !seen.seen ? unseen[i] + 1 : 0;
      f.gap = std::max(f.gap, unseen[i]);
      if (!seen.seen) {
        continue;
      }
      const auto& truth = sequence.rig_from_marker[k][i];
      if (std::max(fraction[0], fraction[1]) < kGlimpsed ||
          is_elsewhere(seen.rig_from_marker, truth, sequence.tools[i].marker.size_m)) {
        f.ghosts += 1;
        continue;
      }
      const Point<Marker> tip = sequence.tools[i].tip_in_marker;
      if (k >= kWarmUp) {
        add_errors(truth, seen, tip, f);
      }
      if (k < kSettled) {
        continue;
      }
      const auto& world_from_rig = *sequence.frames[k].world_from_rig;
      tips[i].truth.push_back((world_from_rig * truth * tip).v);
      tips[i].found.push_back((world_from_rig * seen.rig_from_marker * tip).v);
    }
  }
  add_jitter(tips, f);
  return f;
}

void print_head() {
  std::printf(
      "| sequence   | method               | ms a pair, median (p99) |    seen | gap | ghosts | "
      "position mm | rotation ° |  tip mm | error² by covariance | tip's jitter mm |\n"
      "|------------|----------------------|-------------------------|---------|-----|--------|-"
      "------------|------------|---------|----------------------|-----------------|\n");
}

void print_row(const Sequence& sequence, const std::string& method, const Figures& f) {
  char time[32];
  std::snprintf(time, sizeof time, "%.1f (%.1f)", quantile(f.ms, 0.5), quantile(f.ms, 0.99));
  std::printf("| %-10s | %-20s | %23s | %5.1f %% | %3d | %6d |", sequence.name.c_str(),
              method.c_str(), time, 100.0 * f.seen / std::max(f.visible, 1.0), f.gap, f.ghosts);
  if (f.count > 0) {
    std::printf(" %11.3f | %10.3f | %7.3f |", 1e3 * std::sqrt(f.position / f.count),
                180.0 / M_PI * std::sqrt(f.rotation / f.count), 1e3 * std::sqrt(f.tip / f.count));
  } else {
    std::printf("             |            |         |");
  }
  if (f.nees_count > 0) {
    std::printf(" %20.2f |", f.nees / f.nees_count);
  } else {
    std::printf("                      |");
  }
  if (f.jitters > 0) {
    std::printf(" %15.3f |\n", 1e3 * std::sqrt(f.jitter / f.jitters));
  } else {
    std::printf("                 |\n");
  }
  std::fflush(stdout);
}

void print_bound(const Sequence& sequence) {
  if (!sequence.bound) {
    return;
  }
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  int count = 0;
  const std::size_t every = std::max<std::size_t>(sequence.frames.size() / 10, 1);
  for (std::size_t k = 0; k < sequence.frames.size(); k += every) {
    for (std::size_t i = 0; i < sequence.tools.size(); ++i) {
      const auto& fraction = sequence.visible[k][i];
      if (std::min(fraction[0], fraction[1]) < kVisible) {
        continue;
      }
      const auto bound = sequence.bound(k, i);
      const Eigen::Map<const Eigen::Matrix<double, 6, 6>> c(bound.data());
      const Vec3 tip = sequence.tools[i].tip_in_marker.v;
      Eigen::Matrix<double, 3, 6> j = Eigen::Matrix<double, 3, 6>::Zero();
      j.leftCols<3>().setIdentity();
      j.rightCols<3>() << 0, tip.z, -tip.y, -tip.z, 0, tip.x, tip.y, -tip.x, 0;
      sums += Eigen::Vector3d(c.topLeftCorner<3, 3>().trace(), c.bottomRightCorner<3, 3>().trace(),
                              (j * c * j.transpose()).trace());
      ++count;
    }
  }
  if (count == 0) {
    return;
  }
  sums /= count;
  std::printf(
      "| %-10s | %-20s | %23s | %7s | %3s | %6s | %11.3f | %10.3f | %7.3f | %20s | %15s |\n",
      sequence.name.c_str(), "bound", "", "", "", "", 1e3 * std::sqrt(sums(0)),
      180.0 / M_PI * std::sqrt(sums(1)), 1e3 * std::sqrt(sums(2)), "", "");
  std::fflush(stdout);
}

}  // namespace orthonav::bench
