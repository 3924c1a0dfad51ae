#include "engine/live/camera_files.h"

#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/io/json_document.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kMostBytes = 1u << 20u;
constexpr int kLargestSide_px = 16384;
constexpr int kMaxPixels = 64'000'000;
// Numbers rounded to four digits still count as rigid.
constexpr double kMaxShear = 1e-3;
// Two eyes are not farther apart: a larger translation is not in metres.
constexpr double kFarthest_m = 2.0;
// A pixel whose direction does not lead back to it has none.
constexpr double kWayBackPx = 0.001;

/// Thrown within this file alone, since OpenCV's parser throws as well.
struct Refused {
  std::string message;
};

[[noreturn]] void refuse(const std::string& field, const std::string& reason) {
  throw Refused{field + " " + reason};
}

cv::FileNode needed(const cv::FileNode& parent, const std::string& name) {
  if (!parent.isMap() || parent[name].empty()) {
    refuse(name, "is missing");
  }
  return parent[name];
}

double number(const cv::FileNode& node, const std::string& field) {
  if (!node.isInt() && !node.isReal()) {
    refuse(field, "must be numbers");
  }
  const double value = node.real();
  if (!std::isfinite(value)) {
    refuse(field, "must be finite");
  }
  return value;
}

/// The numbers of a list, of lists of them, or of a matrix with its `data`.
std::vector<double> numbers(const cv::FileNode& node, const std::string& field) {
  const cv::FileNode list = node.isMap() ? node["data"] : node;
  if (!list.isSeq()) {
    refuse(field, "must be numbers");
  }
  std::vector<double> all;
  for (const cv::FileNode& each : list) {
    if (each.isSeq()) {
      const std::vector<double> row = numbers(each, field);
      all.insert(all.end(), row.begin(), row.end());
    } else {
      all.push_back(number(each, field));
    }
  }
  return all;
}

std::vector<double> numbers(const cv::FileNode& parent, const std::string& name,
                            std::size_t count) {
  std::vector<double> all = numbers(needed(parent, name), name);
  if (all.size() != count) {
    refuse(name,
           "has " + std::to_string(all.size()) + " numbers, must have " + std::to_string(count));
  }
  return all;
}

std::string text(const cv::FileNode& parent, const std::string& name) {
  const cv::FileNode node = needed(parent, name);
  if (!node.isString()) {
    refuse(name, "must be text");
  }
  return node.string();
}

int side_px(double value, const std::string& field) {
  if (!(value >= 1 && value <= kLargestSide_px) || value != std::floor(value)) {
    refuse(field, "must be a whole number of pixels, 1 to " + std::to_string(kLargestSide_px));
  }
  return static_cast<int>(value);
}

struct Lens {
  int width_px = 0;
  int height_px = 0;
  std::array<double, 4> focal_and_centre_px{};  ///< fx fy cx cy; the first pixel's centre at (0, 0)
  bool fisheye = false;
  std::vector<double> coefficients;
};

std::array<double, 4> pinhole(const std::vector<double>& rows, const std::string& field) {
  if (rows[1] != 0 || rows[3] != 0 || rows[6] != 0 || rows[7] != 0 || rows[8] != 1) {
    refuse(field, "must be fx 0 cx, 0 fy cy, 0 0 1");
  }
  return {rows[0], rows[4], rows[2], rows[5]};
}

CameraModel model_of(const Lens& lens, const std::string& which) {
  const auto [fx, fy, cx, cy] = lens.focal_and_centre_px;
  if (!(fx > 0) || !(fy > 0)) {
    refuse(which, "must have positive focal lengths");
  }
  const cv::Mat camera = (cv::Mat_<double>(3, 3) << fx, 0, cx, 0, fy, cy, 0, 0, 1);
  if (lens.width_px > kMaxPixels / lens.height_px) {
    refuse(which, "has more than 64 million pixels");
  }
  const cv::TermCriteria exact(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-10);
  const cv::Vec3d none(0, 0, 0);
  std::vector<Vec2> lookup;
  for (int y = 0; y < lens.height_px; ++y) {
    std::vector<cv::Point2d> pixels;
    for (int x = 0; x < lens.width_px; ++x) {
      pixels.emplace_back(x, y);
    }
    std::vector<cv::Point2d> plane;
    std::vector<cv::Point2d> back;
    if (lens.fisheye) {
      cv::fisheye::undistortPoints(pixels, plane, camera, lens.coefficients, cv::noArray(),
                                   cv::noArray(), exact);
      cv::fisheye::distortPoints(plane, back, camera, lens.coefficients);
    } else {
      cv::undistortPoints(pixels, plane, camera, lens.coefficients, cv::noArray(), cv::noArray(),
                          exact);
      std::vector<cv::Point3d> rays;
      for (const cv::Point2d& p : plane) {
        rays.emplace_back(p.x, p.y, 1);
      }
      cv::projectPoints(rays, none, none, camera, lens.coefficients, back);
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const bool same = cv::norm(back[i] - pixels[i]) < kWayBackPx;
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      lookup.push_back(same ? Vec2{plane[i].x, plane[i].y} : Vec2{kNone, kNone});
    }
  }
  auto model = CameraModel::from_lookup(lens.width_px, lens.height_px, std::move(lookup));
  if (!model) {
    refuse(which + ":", model.error().message);
  }
  return std::move(model).value();
}

void check_coefficients(const Lens& lens, const std::string& field) {
  const std::size_t count = lens.coefficients.size();
  const bool known =
      lens.fisheye ? count == 4 : count == 4 || count == 5 || count == 8 || count == 12;
  if (!known) {
    refuse(field, "has " + std::to_string(count) + " coefficients, must have " +
                      (lens.fisheye ? "4" : "4, 5, 8 or 12"));
  }
}

Lens kalibr_lens(const cv::FileNode& node) {
  Lens lens;
  if (const std::string model = text(node, "camera_model"); model != "pinhole") {
    refuse("camera_model", "is " + model + ", must be pinhole");
  }
  const std::string distortion = text(node, "distortion_model");
  if (distortion != "radtan" && distortion != "equidistant") {
    refuse("distortion_model", "is " + distortion + ", must be radtan or equidistant");
  }
  lens.fisheye = distortion == "equidistant";
  lens.coefficients = numbers(node, "distortion_coeffs", 4);
  const std::vector<double> size = numbers(node, "resolution", 2);
  lens.width_px = side_px(size[0], "resolution");
  lens.height_px = side_px(size[1], "resolution");
  const std::vector<double> pinhole = numbers(node, "intrinsics", 4);
  std::copy(pinhole.begin(), pinhole.end(), lens.focal_and_centre_px.begin());
  return lens;
}

Lens opencv_lens(const cv::FileNode& root, const std::string& camera,
                 const std::string& lens_name) {
  Lens lens;
  lens.width_px = side_px(number(needed(root, "image_width"), "image_width"), "image_width");
  lens.height_px = side_px(number(needed(root, "image_height"), "image_height"), "image_height");
  lens.focal_and_centre_px = pinhole(numbers(root, camera, 9), camera);
  lens.coefficients = numbers(needed(root, lens_name), lens_name);
  if (!root["distortion_model"].empty()) {
    const std::string model = text(root, "distortion_model");
    if (model != "fisheye" && model != "equidistant" && model != "plumb_bob" &&
        model != "rational_polynomial") {
      refuse("distortion_model", "is " + model +
                                     ", must be plumb_bob, rational_polynomial, equidistant or "
                                     "fisheye");
    }
    lens.fisheye = model == "fisheye" || model == "equidistant";
  }
  check_coefficients(lens, lens_name);
  return lens;
}

Transform<RightCamera, LeftCamera> checked_pose(const std::array<double, 16>& rows,
                                                const std::string& field) {
  const auto pose = Transform<RightCamera, LeftCamera>::from_row_major(rows, kMaxShear);
  if (!pose) {
    refuse(field, pose.error().message);
  }
  const double apart_m = pose->translation().norm();
  if (!(apart_m > 0 && apart_m <= kFarthest_m)) {
    refuse(field, "puts the cameras " + std::to_string(apart_m) +
                      " m apart, must be above 0 and at most 2: is it in metres?");
  }
  return *pose;
}

std::array<double, 16> rows_of(const cv::Matx33d& r, const cv::Vec3d& t) {
  return {r(0, 0), r(0, 1), r(0, 2), t[0], r(1, 0), r(1, 1), r(1, 2), t[1],
          r(2, 0), r(2, 1), r(2, 2), t[2], 0,       0,       0,       1};
}

struct Cameras {
  Lens left;
  Lens right;
  Transform<RightCamera, LeftCamera> right_from_left;
};

Cameras of_kalibr(const cv::FileNode& root) {
  const cv::FileNode right = needed(root, "cam1");
  std::array<double, 16> rows{};
  const std::vector<double> pose = numbers(right, "T_cn_cnm1", 16);
  std::copy(pose.begin(), pose.end(), rows.begin());
  return {kalibr_lens(root["cam0"]), kalibr_lens(right), checked_pose(rows, "T_cn_cnm1")};
}

Cameras of_opencv(const cv::FileNode& root, const cv::FileNode& extrinsics) {
  const std::vector<double> r = numbers(extrinsics, "R", 9);
  const std::vector<double> t = numbers(extrinsics, "T", 3);
  return {opencv_lens(root, "M1", "D1"), opencv_lens(root, "M2", "D2"),
          checked_pose(rows_of(cv::Matx33d(r.data()), cv::Vec3d(t.data())), "R, T")};
}

/// Rectified cameras lie in a row: the projection matrix of the right one says how far.
Cameras of_ros(const cv::FileNode& left, const cv::FileNode& right) {
  const cv::Matx33d left_rectified(numbers(left, "rectification_matrix", 9).data());
  const cv::Matx33d right_rectified(numbers(right, "rectification_matrix", 9).data());
  const std::vector<double> p = numbers(right, "projection_matrix", 12);
  if (!(p[0] > 0)) {
    refuse("projection_matrix", "must have a positive focal length");
  }
  const cv::Vec3d shift(p[3] / p[0], p[7] / p[5], p[11]);
  return {opencv_lens(left, "camera_matrix", "distortion_coefficients"),
          opencv_lens(right, "camera_matrix", "distortion_coefficients"),
          checked_pose(rows_of(right_rectified.t() * left_rectified, right_rectified.t() * shift),
                       "projection_matrix, rectification_matrix")};
}

/// OpenCV's parser wants its header, and a list's dashes deeper than the list's name.
cv::FileStorage opened(const std::string& content) {
  std::string text = content;
  if (!content.starts_with("%YAML") && !content.starts_with("<?xml")) {
    text = "%YAML:1.0\n---\n";
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t start = line.find_first_not_of(' ');
      const bool is_item = start != std::string::npos && line.compare(start, 2, "- ") == 0;
      text += (is_item ? "  " : "") + line + "\n";
    }
  }
  return {text, cv::FileStorage::READ | cv::FileStorage::MEMORY};
}

Cameras cameras_in(const std::vector<std::string>& contents) {
  const cv::FileStorage first = opened(contents.front());
  const cv::FileStorage second = opened(contents.back());
  const cv::FileNode root = first.root();
  if (!root["cam0"].empty()) {
    return of_kalibr(root);
  }
  if (!root["M1"].empty()) {
    return of_opencv(root, second.root());
  }
  if (!root["camera_matrix"].empty()) {
    if (contents.size() < 2) {
      refuse("camera_info", "is of one camera: name both files, LEFT,RIGHT");
    }
    return of_ros(root, second.root());
  }
  refuse("is",
         "not a calibration of orthonav (JSON), Kalibr (cam0), OpenCV (M1) or ROS "
         "(camera_matrix)");
}

}  // namespace

Result<CalibrationFile> load_cameras(const std::string& path) {
  std::vector<std::string> names = {path};
  if (const std::size_t comma = path.find(','); comma != std::string::npos) {
    names = {path.substr(0, comma), path.substr(comma + 1)};
  }
  std::vector<std::string> contents;
  for (const std::string& name : names) {
    auto content = read_text(name, kMostBytes);
    if (!content) {
      return content.error();
    }
    contents.push_back(std::move(*content));
  }
  const std::size_t start = contents.front().find_first_not_of(" \t\r\n");
  if (names.size() == 1 && (start == std::string::npos || contents.front()[start] == '{')) {
    return load_calibration(path);
  }
  try {
    Cameras cameras = cameras_in(contents);
    return CalibrationFile{path,
                           CalibrationFile::Lenses{model_of(cameras.left, "left camera"),
                                                   model_of(cameras.right, "right camera")},
                           cameras.right_from_left};
  } catch (const Refused& refused) {
    return Error{path + ": " + refused.message};
  } catch (const std::exception& damaged) {
    // Some of its parser's are the standard library's.
    const auto* of_opencv = dynamic_cast<const cv::Exception*>(&damaged);
    return Error{path + ": can't be read as YAML or XML: " +
                 (of_opencv ? of_opencv->err : std::string(damaged.what()))};
  }
}

}  // namespace orthonav::engine
