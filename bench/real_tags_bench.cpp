// Tags on paper before real cameras of others (shared/real; docs/real-measurements.md): each tag
// alone against its board, by the corners of every method and by `best`, on the same tags. Nothing
// is tuned on these pictures. Prints a table in Markdown for each set that is there.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <Eigen/Dense>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "base/printed.h"
#include "base/random.h"
#include "bench/quantile.h"
#include "bench/real_tag_sets.h"

namespace orthonav::bench {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// From the tag's middle down, as the built-in pointer's.
constexpr Vec3 kTip_m{0.0, -0.130, 0.0};
constexpr int kResamples = 1000;

/// One tag in one frame against where the others put it, in the board's axes.
struct Error {
  int id = 0;
  Vec3 shift_m;  ///< of the tag's middle
  Vec3 turn_rad;
  double range_m = 0.0;  ///< of the shift, along the ray

  [[nodiscard]] double tip_m() const { return (shift_m + turn_rad.cross(kTip_m)).norm(); }
};
using Errors = std::vector<std::vector<Error>>;  ///< by frame

struct References {
  std::vector<std::map<int, Transform<Rig, Board>>> without;  ///< by frame and tag left out
};

References references(const BoardPictures& set, const std::vector<FrameCorners>& corners) {
  References out;
  for (const FrameCorners& frame : corners) {
    auto& poses = out.without.emplace_back();
    for (int id = 0; id < set.board.tags(); ++id) {
      if (const auto pose = board_pose(set, frame, id)) {
        poses.emplace(id, *pose);
      }
    }
  }
  return out;
}

Errors errors_of(const BoardPictures& set, const References& reference,
                 const std::vector<TagPoses>& poses) {
  Errors all(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const auto& [id, pose] : poses[i]) {
      const auto board = reference.without[i].find(id);
      if (board == reference.without[i].end()) {
        continue;
      }
      const Transform<Rig, Marker> expected =
          board->second * Transform<Board, Marker>(Mat3::identity(), set.board.centre_m(id));
      const Vec3 off = pose.translation() - expected.translation();
      const Mat3 to_board = board->second.rotation().transposed();
      all[i].push_back(
          {id, to_board * off,
           to_board * vector_from_rotation(pose.rotation() * expected.rotation().transposed()),
           off.dot(expected.translation()) / expected.translation().norm()});
    }
  }
  return all;
}

/// Only the tags that every method found in that frame.
void keep_common(std::vector<Errors>& methods) {
  for (std::size_t i = 0; i < methods.front().size(); ++i) {
    std::map<int, std::size_t> count;
    for (const Errors& errors : methods) {
      for (const Error& e : errors[i]) {
        ++count[e.id];
      }
    }
    for (Errors& errors : methods) {
      std::erase_if(errors[i], [&](const Error& e) { return count[e.id] < methods.size(); });
    }
  }
}

/// What is left once each tag's own mean (its print, the paper's bow) is taken away.
Errors without_means(const Errors& errors) {
  struct Mean {
    Vec3 shift_m, turn_rad;
    double range_m = 0.0;
    double count = 0.0;
  };
  std::map<int, Mean> means;
  for (const auto& frame : errors) {
    for (const Error& e : frame) {
      Mean& mean = means[e.id];
      mean.shift_m = mean.shift_m + e.shift_m;
      mean.turn_rad = mean.turn_rad + e.turn_rad;
      mean.range_m += e.range_m;
      mean.count += 1.0;
    }
  }
  Errors out = errors;
  for (auto& frame : out) {
    for (Error& e : frame) {
      const Mean& mean = means[e.id];
      e.shift_m = e.shift_m - (1.0 / mean.count) * mean.shift_m;
      e.turn_rad = e.turn_rad - (1.0 / mean.count) * mean.turn_rad;
      e.range_m -= mean.range_m / mean.count;
    }
  }
  return out;
}

template <class Value>
std::vector<double> values(const Errors& errors, const std::vector<std::size_t>& frames,
                           Value value) {
  std::vector<double> all;
  for (const std::size_t i : frames) {
    for (const Error& e : errors[i]) {
      all.push_back(value(e));
    }
  }
  return all;
}

std::vector<std::size_t> every(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i] = i;
  }
  return all;
}

/// "1.2 (0.9-1.6)": the statistic of all frames, and of 95 % of resamples of frames.
std::string with_interval(std::size_t frames, int decimals,
                          const std::function<double(const std::vector<std::size_t>&)>& of) {
  Random random(1);
  std::vector<double> resampled;
  for (int k = 0; k < kResamples; ++k) {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < frames; ++i) {
      some.push_back(static_cast<std::size_t>(random.uniform() * static_cast<double>(frames)));
    }
    resampled.push_back(of(some));
  }
  return printed("%.*f (%.*f-%.*f)", decimals, of(every(frames)), decimals,
                 quantile(resampled, 0.025), decimals, quantile(resampled, 0.975));
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double tip_mm(const Error& e) { return 1e3 * e.tip_m(); }
double range_mm(const Error& e) { return 1e3 * std::abs(e.range_m); }

void print_against_board(const BoardPictures& set) {
  const std::vector<CornerMethod> finders = corner_methods(set.board.family);
  std::vector<std::string> names;
  std::vector<Errors> errors;
  std::vector<std::size_t> found;
  References reference;
  std::vector<FrameCorners> edges;
  const auto add = [&](const std::string& name, const std::vector<TagPoses>& poses) {
    names.push_back(name);
    errors.push_back(errors_of(set, reference, poses));
    std::size_t count = 0;
    for (const TagPoses& frame : poses) {
      count += frame.size();
    }
    found.push_back(count);
  };
  for (const CornerMethod& finder : finders) {
    const auto corners = corners_in(set, finder.find);
    if (names.empty()) {
      reference = references(set, corners);
      double squared = 0.0;
      double count = 0.0;
      for (const FrameCorners& frame : corners) {
        if (const auto pose = board_pose(set, frame)) {
          squared += std::pow(board_rms_px(set, frame, *pose), 2);
          count += 1.0;
        }
      }
      std::printf("Board of %.2f mm tags, AprilTag's corners about it: %.2f px RMS, 2-D.\n\n",
                  1e3 * set.board.tag_m, std::sqrt(squared / count));
    }
    if (finder.name == "`edges`") {
      edges = corners;
    }
    add(finder.name, poses_by_corners(set, corners));
  }
  add("`best`", poses_by_best(set, edges));
  keep_common(errors);
  std::size_t common = 0;
  for (const auto& frame : errors.front()) {
    common += frame.size();
  }
  std::printf("%zu tags that all find, in %zu frames; medians and 95 %% intervals over frames.\n\n",
              common, set.frames.size());
  std::printf(
      "| method | tags found | range, mm | tip, mm | 95 %% of tips, mm | tip without each tag's "
      "mean, mm | its tip over that of `best` |\n|---|---|---|---|---|---|---|\n");
  const std::size_t frames = set.frames.size();
  const Errors best_rest = without_means(errors.back());
  for (std::size_t m = 0; m < names.size(); ++m) {
    const Errors rest = without_means(errors[m]);
    const auto stat = [&](const Errors& of, auto value) {
      return with_interval(
          frames, 2, [&, value](const auto& some) { return median(values(of, some, value)); });
    };
    const std::string ratio = with_interval(frames, 2, [&](const auto& some) {
      return median(values(rest, some, tip_mm)) / median(values(best_rest, some, tip_mm));
    });
    std::printf("| %s | %zu | %s | %s | %.1f | %s | %s |\n", names[m].c_str(), found[m],
                stat(errors[m], range_mm).c_str(), stat(errors[m], tip_mm).c_str(),
                quantile(values(errors[m], every(frames), tip_mm), 0.95),
                stat(rest, tip_mm).c_str(), ratio.c_str());
    std::fflush(stdout);
  }
  std::printf("\n");
}

// Motion capture. cam_from_board by the pictures, world_from_body and world_from_target by it.

using Twelve = Eigen::Matrix<double, 12, 1>;

struct HandEye {
  Transform<Marker, Rig> body_from_camera;
  Transform<Tag, Board> target_from_board;
};

HandEye moved(const HandEye& at, const Twelve& by) {
  const auto move = [&](auto pose, int from) {
    return decltype(pose)(
        rotation_from_vector({by[from + 3], by[from + 4], by[from + 5]}) * pose.rotation(),
        pose.translation() + Vec3{by[from], by[from + 1], by[from + 2]});
  };
  return {move(at.body_from_camera, 0), move(at.target_from_board, 6)};
}

/// How far the camera puts the board from where motion capture has it: m, rad.
std::array<Vec3, 2> off_by(const CapturedPictures& set, std::size_t frame, const HandEye& at,
                           const Transform<Rig, Board>& seen) {
  const Transform<World, Board> by_camera = set.world_from_body[frame] * at.body_from_camera * seen;
  const Transform<World, Board> stated = set.world_from_target * at.target_from_board;
  return {by_camera.translation() - stated.translation(),
          vector_from_rotation(by_camera.rotation() * stated.rotation().transposed())};
}

cv::Mat mat(const Mat3& m) {
  cv::Mat out(3, 3, CV_64F);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      out.at<double>(r, c) = m[r][static_cast<std::size_t>(c)];
    }
  }
  return out;
}

template <class A, class B>
Transform<A, B> transform_of(const cv::Mat& r, const cv::Mat& t) {
  Mat3 rotation;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      rotation[i][static_cast<std::size_t>(k)] = r.at<double>(i, k);
    }
  }
  return Transform<A, B>::checked(rotation, {t.at<double>(0), t.at<double>(1), t.at<double>(2)})
      .value();
}

/// Least absolute residuals, metres as radians times two (the boards are about 2 m away), from
/// OpenCV's solution.
HandEye hand_eye(const CapturedPictures& set,
                 const std::vector<std::optional<Transform<Rig, Board>>>& seen) {
  std::vector<cv::Mat> r_camera, t_camera, r_body, t_body;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) {
      continue;
    }
    const Vec3 t = seen[i]->translation();
    r_camera.push_back(mat(seen[i]->rotation()));
    t_camera.push_back((cv::Mat_<double>(3, 1) << t.x, t.y, t.z));
    const auto body_from_world = set.world_from_body[i].inverse();
    const Vec3 b = body_from_world.translation();
    r_body.push_back(mat(body_from_world.rotation()));
    t_body.push_back((cv::Mat_<double>(3, 1) << b.x, b.y, b.z));
  }
  // OpenCV's names: camera from world (here the board), gripper (body) from base (mocap's world).
  cv::Mat r_base, t_base, r_gripper, t_gripper;
  cv::calibrateRobotWorldHandEye(r_camera, t_camera, r_body, t_body, r_base, t_base, r_gripper,
                                 t_gripper);
  HandEye at{
      transform_of<Rig, Marker>(r_gripper, t_gripper).inverse(),
      set.world_from_target.inverse() * transform_of<Board, World>(r_base, t_base).inverse()};
  constexpr int kSteps = 60;
  constexpr double kStep = 1e-6;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix<double, 12, 12> normal = Eigen::Matrix<double, 12, 12>::Zero();
    Twelve right = Twelve::Zero();
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i]) {
        continue;
      }
      const auto here = off_by(set, i, at, *seen[i]);
      std::array<Eigen::Matrix<double, 3, 12>, 2> slope;
      for (int k = 0; k < 12; ++k) {
        const auto there = off_by(set, i, moved(at, kStep * Twelve::Unit(k)), *seen[i]);
        for (std::size_t part = 0; part < 2; ++part) {
          const Vec3 d = (1.0 / kStep) * (there[part] - here[part]);
          slope[part].col(k) << d.x, d.y, d.z;
        }
      }
      for (std::size_t part = 0; part < 2; ++part) {
        const double scale = part == 0 ? 1.0 : 2.0;
        const Eigen::Vector3d off(here[part].x, here[part].y, here[part].z);
        const double weight = scale / std::max(off.norm(), 1e-4);
        normal += weight * slope[part].transpose() * slope[part];
        right -= weight * slope[part].transpose() * off;
      }
    }
    at = moved(at, normal.ldlt().solve(right));
  }
  return at;
}

void print_row_against_capture(const CapturedPictures& set, const std::string& name,
                               const std::vector<std::optional<Transform<Rig, Board>>>& seen) {
  const auto count = std::count_if(seen.begin(), seen.end(), [](const auto& s) { return !!s; });
  if (count < 10) {
    std::printf("| %s | %td | | |\n", name.c_str(), count);
    return;
  }
  const HandEye at = hand_eye(set, seen);
  const auto off = [&](std::size_t part, double scale) {
    return with_interval(seen.size(), 2, [&](const std::vector<std::size_t>& frames) {
      std::vector<double> all;
      for (const std::size_t i : frames) {
        if (seen[i]) {
          all.push_back(scale * off_by(set, i, at, *seen[i])[part].norm());
        }
      }
      return median(std::move(all));
    });
  };
  std::printf("| %s | %td | %s | %s |\n", name.c_str(), count, off(0, 1e3).c_str(),
              off(1, kDegrees).c_str());
  std::fflush(stdout);
}

void print_against_capture(const CapturedPictures& set) {
  std::printf(
      "The whole board against motion capture, camera in body and board in target by least "
      "absolute "
      "residuals of each method's own; medians and 95 %% intervals over frames.\n\n"
      "| method | frames | position, mm | rotation, deg |\n|---|---|---|---|\n");
  std::vector<std::optional<Transform<Rig, Board>>> edges;
  for (const CornerMethod& finder : corner_methods(set.pictures.board.family)) {
    std::vector<std::optional<Transform<Rig, Board>>> poses;
    for (const FrameCorners& frame : corners_in(set.pictures, finder.find)) {
      poses.push_back(board_pose(set.pictures, frame));
    }
    print_row_against_capture(set, finder.name, poses);
    if (finder.name == "`edges`") {
      edges = poses;
    }
  }
  std::vector<std::optional<Transform<Rig, Board>>> best(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i]) {
      best[i] = board_by_best(set.pictures, set.pictures.frames[i], *edges[i]);
    }
  }
  print_row_against_capture(set, "`best`, the board as one tool", best);
  std::printf("\n");
}

/// Each turned tag's azimuth against what its picture's name states, after the mean difference.
void print_turned(const TurnedTag& set) {
  std::printf(
      "One tag turned by hand, azimuth against the angle stated, about the mean difference.\n\n"
      "| method | pictures | RMS, deg | up to 20 deg from frontal, RMS |\n|---|---|---|---|\n");
  const auto row = [&](const std::string& name, const std::vector<TagPoses>& poses) {
    std::vector<std::pair<double, double>> off_deg;  // stated, difference
    double mean = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (const auto pose = poses[i].find(set.id); pose != poses[i].end()) {
        const Vec3 out = pose->second.rotation().column(2);
        const double azimuth = kDegrees * std::atan2(out.x, -out.z);
        off_deg.emplace_back(set.turned_deg[i], azimuth);
      }
    }
    double sum = 0.0;  // the sense in which the names turn
    for (const auto& [stated, azimuth] : off_deg) {
      sum += stated * azimuth;
    }
    for (auto& [stated, azimuth] : off_deg) {
      azimuth -= std::copysign(1.0, sum) * stated;
      mean += azimuth / static_cast<double>(off_deg.size());
    }
    double all = 0.0, frontal = 0.0, frontals = 0.0;
    for (const auto& [stated, off] : off_deg) {
      all += (off - mean) * (off - mean) / static_cast<double>(off_deg.size());
      if (std::abs(stated) <= 20.0) {
        frontal += (off - mean) * (off - mean);
        frontals += 1.0;
      }
    }
    std::printf("| %s | %zu | %.1f | %.1f |\n", name.c_str(), off_deg.size(), std::sqrt(all),
                std::sqrt(frontal / std::max(frontals, 1.0)));
  };
  std::vector<FrameCorners> edges;
  for (const CornerMethod& finder : corner_methods(set.pictures.board.family)) {
    const auto corners = corners_in(set.pictures, finder.find);
    row(finder.name, poses_by_corners(set.pictures, corners));
    if (finder.name == "`edges`") {
      edges = corners;
    }
  }
  row("`best`", poses_by_best(set.pictures, edges));
  std::printf("\n");
}

int run() {
  const auto pairs = stereo_pairs();
  if (pairs) {
    std::printf("## moms-apriltag-stereo: 23 pairs, 31.6 mm apart\n\n");
    print_against_board(*pairs);
  }
  const auto captured = captured_pictures();
  if (captured) {
    std::printf("## chutsu-yac-mocap-aprilgrid: 30 pictures of one camera\n\n");
    print_against_board(captured->pictures);
    print_against_capture(*captured);
  }
  const auto turned = turned_tag();
  if (turned) {
    std::printf("## duckietown-rotation: 15 pictures of one camera\n\n");
    print_turned(*turned);
  }
  if (!pairs && !captured && !turned) {
    std::printf("skipped: needs shared/real beside the checkout\n");
  }
  return 0;
}

}  // namespace
}  // namespace orthonav::bench

int main() { return orthonav::bench::run(); }
