// Every way of tracking on the same rendered pairs, one thread each: time, what was seen, errors
// against the truth, honesty of the covariance, and the Cramér-Rao bound.
//   bench_trackers [PAIRS]     pairs a sequence, 300 by default
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <Eigen/Dense>
#include <functional>
#include <memory>

#include "bench/tag_sequences.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tag_matching.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::bench {
namespace {

using WallClock = std::chrono::steady_clock;
/// A tag counts as visible when so much of it is free in both images.
constexpr double kVisible = 0.9;
/// And as one that may be seen, so that seeing it is no ghost, from here on.
constexpr double kGlimpsed = 0.02;
/// Acquisition is not part of the accuracy.
constexpr std::size_t kWarmUp = 5;

struct Seen {
  bool seen = false;
  Transform<Rig, Marker> rig_from_marker;
  PoseCovariance covariance_in_rig{};
  bool has_covariance = false;
};

/// Tracks a pair, filling one entry a tool.
using Method = std::function<void(const StereoFrame&, std::vector<Seen>&)>;

struct Figures {
  std::vector<double> ms;
  double visible = 0, seen = 0, ghosts = 0, count = 0;
  double position = 0, rotation = 0, tip = 0, nees = 0, jitter = 0, jitters = 0;
};

double quantile(std::vector<double> v, double q) {
  if (v.empty()) return 0.0;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))];
}

double nees_of(const Transform<Rig, Marker>& truth, const Seen& seen) {
  const Vec3 shift = seen.rig_from_marker.translation() - truth.translation();
  const Vec3 turn =
      vector_from_rotation(seen.rig_from_marker.rotation() * truth.rotation().transposed());
  Eigen::Matrix<double, 6, 1> e;
  e << shift.x, shift.y, shift.z, turn.x, turn.y, turn.z;
  const Eigen::Map<const Eigen::Matrix<double, 6, 6>> c(seen.covariance_in_rig.data());
  return e.dot(c.ldlt().solve(e));
}

Figures measure(const Sequence& sequence, const Method& method) {
  Figures f;
  std::vector<Seen> seen(sequence.tools.size());
  std::vector<std::vector<Vec3>> tips(sequence.tools.size());
  for (std::size_t k = 0; k < sequence.frames.size(); ++k) {
    for (Seen& s : seen) s = {};
    const auto begin = WallClock::now();
    method(sequence.frames[k], seen);
    const auto end = WallClock::now();
    if (k >= kWarmUp)
      f.ms.push_back(std::chrono::duration<double, std::milli>(end - begin).count());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto& share = sequence.visible[k][i];
      const bool visible = std::min(share[0], share[1]) >= kVisible;
      f.visible += visible ? 1 : 0;
      f.seen += visible && seen[i].seen ? 1 : 0;
      if (!seen[i].seen) continue;
      if (std::max(share[0], share[1]) < kGlimpsed) f.ghosts += 1;
      if (k < kWarmUp) continue;
      const auto& truth = sequence.rig_from_marker[k][i];
      const auto& pose = seen[i].rig_from_marker;
      const Point<Marker> tip = sequence.tools[i].tip_in_marker;
      f.count += 1;
      f.position += (pose.translation() - truth.translation()).squared_norm();
      f.rotation += std::pow(rotation_angle_rad(pose.rotation(), truth.rotation()), 2);
      f.tip += (pose * tip - truth * tip).squared_norm();
      if (seen[i].has_covariance) f.nees += nees_of(truth, seen[i]);
      if (k >= 60) tips[i].push_back((*sequence.frames[k].world_from_rig * pose * tip).v);
    }
  }
  for (const auto& path : tips) {
    Vec3 mean{};
    for (const Vec3 p : path) mean += p / static_cast<double>(path.size());
    for (const Vec3 p : path) f.jitter += (p - mean).squared_norm();
    f.jitters += static_cast<double>(path.size());
  }
  return f;
}

Method tracker(const Sequence& sequence, auto create) {
  nav::TrackerOptions options;
  options.parallel = false;
  auto made = create(sequence.calibration, sequence.tools, options);
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().message.c_str());
    std::exit(2);
  }
  const std::shared_ptr<nav::ToolTracker> tracker = std::move(*made);
  return [tracker](const StereoFrame& frame, std::vector<Seen>& out) {
    for (const nav::ToolState& state : tracker->track(frame)) {
      if (state.world_from_marker.origin != Origin::kMeasured) continue;
      const auto rig_from_world = frame.world_from_rig->inverse();
      out[state.tool] = {true, rig_from_world * state.world_from_marker.value,
                         nav::turned(state.world_from_marker.covariance, rig_from_world.rotation()),
                         true};
    }
  };
}

/// AprilTag's corners, triangulated, absolute orientation, no filter.
Method apriltag(const Sequence& sequence, double decimate) {
  nav::DetectorOptions options;
  options.decimate = decimate;
  const auto detector =
      std::make_shared<nav::MarkerDetector>(nav::MarkerDetector::create(options).value());
  const auto geometry = std::make_shared<nav::TagGeometry>(sequence.calibration);
  const auto tools = sequence.tools;
  return [=](const StereoFrame& frame, std::vector<Seen>& out) {
    std::vector<nav::MarkerCorners> left;
    std::vector<nav::MarkerCorners> right;
    if (!detector->detect(frame.left, left) || !detector->detect(frame.right, right)) return;
    for (std::size_t i = 0; i < tools.size(); ++i) {
      const auto& marker = tools[i].marker;
      const nav::TagMatch match = nav::matched(left, right, marker.family, marker.id, marker.size_m,
                                               *geometry, std::nullopt);
      if (!match.both()) continue;
      const auto pose =
          geometry->pose({match.left->corners_px, match.right->corners_px}, marker.size_m);
      if (pose) out[i] = {true, pose->rig_from_marker, {}, false};
    }
  };
}

void print(const char* name, const Figures& f) {
  std::printf("  %-12s %8.3f %8.3f %7.2f %6.0f %9.4f %9.4f %9.4f", name, quantile(f.ms, 0.5),
              quantile(f.ms, 0.99), 100.0 * f.seen / std::max(f.visible, 1.0), f.ghosts,
              1e3 * std::sqrt(f.position / f.count), 180.0 / M_PI * std::sqrt(f.rotation / f.count),
              1e3 * std::sqrt(f.tip / f.count));
  if (f.nees > 0.0)
    std::printf(" %7.2f", f.nees / f.count);
  else
    std::printf("       -");
  std::printf(" %9.4f\n", 1e3 * std::sqrt(f.jitter / std::max(f.jitters, 1.0)));
}

void print_bound(const Sequence& sequence) {
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t k = 0; k < sequence.frames.size(); k += 30)
    for (std::size_t i = 0; i < sequence.tools.size(); ++i) {
      const auto bound = cramer_rao_bound(sequence, k, i);
      const Eigen::Map<const Eigen::Matrix<double, 6, 6>> c(bound.data());
      const Vec3 tip = sequence.tools[i].tip_in_marker.v;
      Eigen::Matrix<double, 3, 6> j = Eigen::Matrix<double, 3, 6>::Zero();
      j.leftCols<3>().setIdentity();
      j.rightCols<3>() << 0, tip.z, -tip.y, -tip.z, 0, tip.x, tip.y, -tip.x, 0;
      sums += Eigen::Vector3d(c.topLeftCorner<3, 3>().trace(), c.bottomRightCorner<3, 3>().trace(),
                              (j * c * j.transpose()).trace());
      ++count;
    }
  sums /= count;
  std::printf("  %-12s %8s %8s %7s %6s %9.4f %9.4f %9.4f\n", "bound", "", "", "", "",
              1e3 * std::sqrt(sums(0)), 180.0 / M_PI * std::sqrt(sums(1)),
              1e3 * std::sqrt(sums(2)));
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  using namespace orthonav;
  using namespace orthonav::bench;
  const int pairs = argc > 1 ? std::max(std::atoi(argv[1]), 70) : 300;
  for (const std::string& name : sequence_names()) {
    const Sequence sequence = make_sequence(name, pairs, 7);
    std::printf("%s, %d pairs of two tools\n", name.c_str(), pairs);
    std::printf("  %-12s %8s %8s %7s %6s %9s %9s %9s %7s %9s\n", "method", "ms", "p99 ms", "seen %",
                "ghosts", "pos mm", "rot deg", "tip mm", "nees", "jitter mm");
    print("best", measure(sequence, tracker(sequence, nav::create_best_tracker)));
    print("paper", measure(sequence, tracker(sequence, nav::create_paper_tracker)));
    print("apriltag", measure(sequence, apriltag(sequence, 1.0)));
    print("apriltag /2", measure(sequence, apriltag(sequence, 2.0)));
    print_bound(sequence);
    std::fflush(stdout);
  }
  return 0;
}
