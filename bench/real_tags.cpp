#include "bench/real_tags.h"

#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <set>
#include <utility>

#include "bench/aruco_methods.h"
#include "nav/geometry/absolute_orientation.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool_follower.h"

namespace orthonav::bench {
namespace {

/// As the tracker doubts a tag that it found by its corners, in one camera or in two.
constexpr double kDoubtPx = 1.0;
constexpr double kOneCameraDoubtPx = 6.0;

TagsSeen seen_once(std::span<const nav::MarkerCorners> found) {
  TagsSeen seen;
  std::set<int> twice;
  for (const nav::MarkerCorners& marker : found) {
    if (!seen.emplace(marker.id, marker.corners_px).second) {
      twice.insert(marker.id);
    }
  }
  for (const int id : twice) {
    seen.erase(id);
  }
  return seen;
}

CornerMethod ours(const std::string& name, const std::string& family, nav::Refinement refinement) {
  nav::DetectorOptions options;
  options.families = {family};
  options.refinement = refinement;
  // The library's corners are the library's: without tags that it would not find.
  options.touched = refinement != nav::Refinement::kLibrary;
  const auto detector =
      std::make_shared<nav::MarkerDetector>(nav::MarkerDetector::create(options).value());
  return {name, [detector](const GreyImage& image) {
            std::vector<nav::MarkerCorners> found;
            return detector->detect(image, found) ? seen_once(found) : TagsSeen{};
          }};
}

Transform<Board, Marker> place_of(const TagBoard& board, int id) {
  return {Mat3::identity(), board.centre_m(id)};
}

/// The pose of a tag by one camera, from corners on the unit plane.
std::optional<Transform<LeftCamera, Marker>> pose_by_one(const CameraModel& camera,
                                                         const nav::TagCorners& corners,
                                                         double size_m) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  // IPPE's square starts at the top left and goes on clockwise.
  const auto in_tag = nav::corners_in_marker(size_m);
  for (const std::size_t k : {3u, 2u, 1u, 0u}) {
    const auto plane = camera.unproject(corners[k]);
    if (!plane) {
      return std::nullopt;
    }
    object.emplace_back(in_tag[k].x, in_tag[k].y, 0.0);
    image.emplace_back(plane->x, plane->y);
  }
  std::vector<cv::Mat> rotations, translations;
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  std::vector<double> left;
  try {
    cv::solvePnPGeneric(object, image, identity, cv::noArray(), rotations, translations, false,
                        cv::SOLVEPNP_IPPE_SQUARE, cv::noArray(), cv::noArray(), left);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  if (rotations.empty()) {
    return std::nullopt;
  }
  // Sorted by what they leave.
  cv::solvePnPRefineLM(object, image, identity, cv::noArray(), rotations[0], translations[0]);
  const auto* r = rotations[0].ptr<double>();
  const auto* t = translations[0].ptr<double>();
  return Transform<LeftCamera, Marker>(rotation_from_vector({r[0], r[1], r[2]}),
                                       {t[0], t[1], t[2]});
}

/// What a board's pose leaves of one corner, by camera.
struct SeenCorner {
  bool right = false;
  Vec3 on_board_m;
  Vec2 px;
};

std::vector<SeenCorner> corners_but(const BoardPictures& set, const FrameCorners& corners,
                                    int without) {
  std::vector<SeenCorner> all;
  const auto in_tag = nav::corners_in_marker(set.board.tag_m);
  for (const bool right : {false, true}) {
    for (const auto& [id, seen] : right ? corners.right : corners.left) {
      for (std::size_t k = 0; k < 4 && id != without; ++k) {
        all.push_back({right, set.board.centre_m(id) + in_tag[k], seen[k]});
      }
    }
  }
  return all;
}

std::optional<Vec2> left_over_px(const StereoCalibration& c, const Transform<Rig, Board>& pose,
                                 const SeenCorner& corner) {
  const Point<Rig> in_rig = pose * Point<Board>{corner.on_board_m};
  const auto px = corner.right ? c.right.project((c.right_from_rig * in_rig).v)
                               : c.left.project((c.left_from_rig * in_rig).v);
  if (!px) {
    return std::nullopt;
  }
  return *px - corner.px;
}

Transform<Rig, Board> moved(const Transform<Rig, Board>& pose,
                            const Eigen::Matrix<double, 6, 1>& by) {
  return {rotation_from_vector({by[3], by[4], by[5]}) * pose.rotation(),
          pose.translation() + Vec3{by[0], by[1], by[2]}};
}

std::optional<Transform<Rig, Board>> start_of(const BoardPictures& set,
                                              std::span<const SeenCorner> corners) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (const SeenCorner& corner : corners) {
    const auto plane = set.calibration.left.unproject(corner.px);
    if (!corner.right && plane) {
      object.emplace_back(corner.on_board_m.x, corner.on_board_m.y, 0.0);
      image.emplace_back(plane->x, plane->y);
    }
  }
  if (object.size() < 16) {
    return std::nullopt;
  }
  cv::Vec3d r, t;
  if (!cv::solvePnP(object, image, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), r, t, false,
                    cv::SOLVEPNP_IPPE)) {
    return std::nullopt;
  }
  return set.calibration.left_from_rig.inverse() *
         Transform<LeftCamera, Board>(rotation_from_vector({r[0], r[1], r[2]}), {t[0], t[1], t[2]});
}

nav::ToolGeometry tool_of(const TagBoard& board, int id) {
  nav::ToolGeometry tool;
  tool.name = "tag";
  tool.role = nav::ToolRole::kReference;
  tool.marker = {board.family, id, board.tag_m};
  return tool;
}

}  // namespace

StereoCalibration calibration_of_one(const CameraModel& camera) {
  StereoCalibration out;
  out.left = out.right = camera;
  out.right_from_rig = {Mat3::identity(), {-1000.0, 0.0, 0.0}};
  return out;
}

std::vector<CornerMethod> corner_methods(const std::string& family) {
  std::vector<CornerMethod> methods = {
      ours("AprilTag, `library`", family, nav::Refinement::kLibrary),
      ours("`none`", family, nav::Refinement::kNone),
      ours("`edges`", family, nav::Refinement::kEdges)};
  for (const NamedDetect& aruco : aruco_detectors(family)) {
    methods.push_back({aruco.name, [detect = aruco.detect](const GreyImage& image) {
                         std::vector<nav::MarkerCorners> found;
                         return detect(image, found) ? seen_once(found) : TagsSeen{};
                       }});
  }
  return methods;
}

std::vector<FrameCorners> corners_in(const BoardPictures& set, const FindTags& find) {
  std::vector<FrameCorners> all;
  for (const StereoFrame& frame : set.frames) {
    all.push_back({find(frame.left), set.stereo ? find(frame.right) : TagsSeen{}});
    for (TagsSeen* seen : {&all.back().left, &all.back().right}) {
      std::erase_if(*seen, [&](const auto& tag) { return tag.first >= set.board.tags(); });
    }
  }
  return all;
}

std::vector<TagPoses> poses_by_corners(const BoardPictures& set,
                                       const std::vector<FrameCorners>& corners) {
  const nav::TagGeometry geometry(set.calibration);
  std::vector<TagPoses> all;
  for (const FrameCorners& frame : corners) {
    TagPoses& poses = all.emplace_back();
    for (const auto& [id, left] : frame.left) {
      if (!set.stereo) {
        if (const auto pose = pose_by_one(set.calibration.left, left, set.board.tag_m)) {
          poses[id] = set.calibration.left_from_rig.inverse() * *pose;
        }
        continue;
      }
      const auto right = frame.right.find(id);
      if (right == frame.right.end()) {
        continue;
      }
      if (const auto pose = geometry.pose({left, right->second}, set.board.tag_m)) {
        poses[id] = pose->rig_from_marker;
      }
    }
  }
  return all;
}

std::vector<TagPoses> poses_by_best(const BoardPictures& set,
                                    const std::vector<FrameCorners>& corners) {
  nav::PhotometricSolver solver(set.calibration);
  const nav::TagGeometry geometry(set.calibration);
  nav::TagSearch search;
  std::vector<TagPoses> all(set.frames.size());
  for (int id = 0; id < set.board.tags(); ++id) {
    auto follower = nav::ToolFollower::create(tool_of(set.board, id)).value();
    for (std::size_t i = 0; i < set.frames.size(); ++i) {
      const auto left = corners[i].left.find(id);
      const auto right = corners[i].right.find(id);
      if (left == corners[i].left.end() || (set.stereo && right == corners[i].right.end())) {
        continue;
      }
      std::vector<Transform<Rig, Marker>> starts;
      if (set.stereo) {
        if (const auto pose = geometry.pose({left->second, right->second}, set.board.tag_m)) {
          starts.push_back(pose->rig_from_marker);
        }
      } else if (const auto two =
                     nav::poses_by_one(set.calibration, {set.board.family, id, left->second}, false,
                                       set.board.tag_m)) {
        for (const Transform<Rig, Tag>& pose : *two) {
          starts.emplace_back(pose.rotation(), pose.translation());
        }
      }
      for (const Transform<Rig, Marker>& start : starts) {
        const double px = set.stereo ? kDoubtPx : kOneCameraDoubtPx;
        // The pictures are minutes apart: no light is kept from one to the next.
        follower.forget();
        const auto fit = follower.follow(set.frames[i], start,
                                         px * start.translation().norm() / solver.focal_px(false),
                                         solver, search);
        if (fit && fit->left && fit->right == set.stereo) {
          all[i][id] = fit->rig_from_marker;
          break;
        }
      }
    }
  }
  return all;
}

std::optional<Transform<Rig, Board>> board_pose(const BoardPictures& set,
                                                const FrameCorners& corners, int without) {
  const std::vector<SeenCorner> seen = corners_but(set, corners, without);
  auto pose = start_of(set, seen);
  if (!pose) {
    return std::nullopt;
  }
  constexpr int kSteps = 8;
  constexpr double kStep = 1e-6;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (const SeenCorner& corner : seen) {
      const auto here = left_over_px(set.calibration, *pose, corner);
      if (!here) {
        continue;
      }
      Eigen::Matrix<double, 2, 6> slope = Eigen::Matrix<double, 2, 6>::Zero();
      for (int k = 0; k < 6; ++k) {
        const auto there = left_over_px(
            set.calibration, moved(*pose, kStep * Eigen::Matrix<double, 6, 1>::Unit(k)), corner);
        if (there) {
          slope.col(k) << (there->x - here->x) / kStep, (there->y - here->y) / kStep;
        }
      }
      const Eigen::Vector2d off(here->x, here->y);
      normal += slope.transpose() * slope;
      right -= slope.transpose() * off;
    }
    pose = moved(*pose, normal.ldlt().solve(right));
  }
  return pose;
}

double board_rms_px(const BoardPictures& set, const FrameCorners& corners,
                    const Transform<Rig, Board>& pose) {
  double squared = 0.0;
  double count = 0.0;
  for (const SeenCorner& corner : corners_but(set, corners, -1)) {
    if (const auto off = left_over_px(set.calibration, pose, corner)) {
      squared += off->dot(*off);
      count += 1.0;
    }
  }
  return count > 0 ? std::sqrt(squared / count) : std::numeric_limits<double>::quiet_NaN();
}

std::optional<Transform<Rig, Board>> board_by_best(const BoardPictures& set,
                                                   const StereoFrame& frame,
                                                   const Transform<Rig, Board>& near) {
  nav::ToolGeometry tool = tool_of(set.board, 0);
  const Transform<Marker, Board> marker_from_board = place_of(set.board, 0).inverse();
  for (int id = 1; id < set.board.tags(); ++id) {
    const auto pose = marker_from_board * place_of(set.board, id);
    tool.more_markers.push_back(
        {{set.board.family, id, set.board.tag_m}, {pose.rotation(), pose.translation()}});
  }
  auto follower = nav::ToolFollower::create(tool).value();
  nav::PhotometricSolver solver(set.calibration);
  nav::TagSearch search;
  const auto fit = follower.follow(frame, near * place_of(set.board, 0),
                                   kDoubtPx * near.translation().norm() / solver.focal_px(false),
                                   solver, search);
  if (!fit) {
    return std::nullopt;
  }
  return fit->rig_from_marker * marker_from_board;
}

}  // namespace orthonav::bench
