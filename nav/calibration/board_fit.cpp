#include "nav/calibration/board_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using ImagePoints = std::vector<std::vector<cv::Point2f>>;
using ObjectPoints = std::vector<std::vector<cv::Point3f>>;

constexpr float kCentre = 0.5F;
constexpr int kCoefficients = 8;
// Half the window in which a corner is refined, as a fraction of the distance to the next corner: a
// larger window would include the next corner's edges.
constexpr double kWindowFraction = 0.3;
// The image is first softened by this much: gradients of sharp edges fall between pixels, with
// errors that depend on their position.
constexpr double kSofteningPx = 1.0;
constexpr int kSmallestWindowPx = 2;
constexpr int kLargestWindowPx = 11;

/// OpenCV prints every error that it throws; during this object's lifetime it does not print.
class QuietOpenCv {
 public:
  QuietOpenCv() {
    cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  }
  ~QuietOpenCv() { cv::redirectError(nullptr); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;
};

Error opencv_error(const cv::Exception& error) {
  return Error{"camera calibration: OpenCV refused: " + error.err};
}

/// Half the refinement window, from the distances between these corners.
int window_px(const Chessboard& board, const std::vector<cv::Point2f>& corners) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto a_row = static_cast<std::size_t>(board.columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if ((i + 1) % a_row != 0) {
      nearest = std::min(nearest, cv::norm(corners[i + 1] - corners[i]));
    }
    if (i + a_row < corners.size()) {
      nearest = std::min(nearest, cv::norm(corners[i + a_row] - corners[i]));
    }
  }
  return std::clamp(static_cast<int>(kWindowFraction * nearest), kSmallestWindowPx,
                    kLargestWindowPx);
}

std::optional<std::vector<cv::Point2f>> corners_of(const cv::Mat& grey, const Chessboard& board) {
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(grey, size, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE) &&
      !cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE)) {
    return std::nullopt;
  }
  if (corners.size() != board.corners()) {
    return std::nullopt;
  }
  const int half = window_px(board, corners);
  cv::Mat soft;
  cv::GaussianBlur(grey, soft, {0, 0}, kSofteningPx);
  cv::cornerSubPix(soft, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4});
  return corners;
}

ImagePoints image_points(std::span<const BoardCorners> views) {
  ImagePoints all;
  for (const BoardCorners& view : views) {
    all.emplace_back();
    for (const Vec2 corner : view) {
      all.back().emplace_back(static_cast<float>(corner.x) - kCentre,
                              static_cast<float>(corner.y) - kCentre);
    }
  }
  return all;
}

ObjectPoints object_points(const Chessboard& board, std::size_t views) {
  std::vector<cv::Point3f> corners;
  for (std::size_t i = 0; i < board.corners(); ++i) {
    const Vec2 place = board.corner_m(i);
    corners.emplace_back(static_cast<float>(place.x), static_cast<float>(place.y), 0.0F);
  }
  return ObjectPoints(views, corners);
}

cv::Mat matrix_of(const BrownConrady& c) {
  return (cv::Mat_<double>(3, 3) << c.fx_px, 0, c.cx_px - kCentre, 0, c.fy_px, c.cy_px - kCentre, 0,
          0, 1);
}

cv::Mat distortion_of(const BrownConrady& c) {
  return (cv::Mat_<double>(1, kCoefficients) << c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6);
}

BrownConrady camera_from(ImageSize size, const cv::Mat& matrix, const cv::Mat& distortion) {
  // OpenCV cuts off what it did not fit.
  const auto d = [&](int i) {
    return i < static_cast<int>(distortion.total()) ? distortion.at<double>(i) : 0.0;
  };
  return {size.width_px,
          size.height_px,
          matrix.at<double>(0, 0),
          matrix.at<double>(1, 1),
          matrix.at<double>(0, 2) + kCentre,
          matrix.at<double>(1, 2) + kCentre,
          d(0),
          d(1),
          d(2),
          d(3),
          d(4),
          d(5),
          d(6),
          d(7)};
}

int flags_for(LensTerms terms) {
  return terms == LensTerms::kRational ? cv::CALIB_RATIONAL_MODEL
         : terms == LensTerms::kThree  ? 0
                                       : cv::CALIB_FIX_K3;
}

Result<Transform<RightCamera, LeftCamera>> transform_from(const cv::Mat& rotation,
                                                          const cv::Mat& translation) {
  return Transform<RightCamera, LeftCamera>::checked(mat_of(cv::Matx33d(rotation)),
                                                     vec_of(cv::Matx31d(translation)));
}

}  // namespace

std::optional<BoardCorners> find_chessboard(const GreyImage& image, const Chessboard& board) {
  const QuietOpenCv quiet;
  if (!board.check().empty() || image.width_px < 2 || image.height_px < 2) {
    return std::nullopt;
  }
  try {
    // OpenCV takes no const pixels but does not write to these.
    const cv::Mat grey(image.height_px, image.width_px, CV_8UC1,
                       const_cast<std::uint8_t*>(image.pixels.data()));
    const auto found = corners_of(grey, board);
    if (!found) {
      return std::nullopt;
    }
    BoardCorners corners;
    for (const cv::Point2f& p : *found) {
      corners.push_back({static_cast<double>(p.x + kCentre), static_cast<double>(p.y + kCentre)});
    }
    put_in_order(image, board, corners);
    return corners;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

Result<CameraFit> fit_camera(const Chessboard& board, ImageSize size,
                             std::span<const BoardCorners> views, LensTerms terms) {
  const QuietOpenCv quiet;
  try {
    cv::Mat matrix;
    cv::Mat distortion = cv::Mat::zeros(1, kCoefficients, CV_64F);
    cv::Mat sigmas;
    std::vector<cv::Mat> rotations;
    std::vector<cv::Mat> translations;
    CameraFit fit;
    fit.rms_px = cv::calibrateCamera(
        object_points(board, views.size()), image_points(views), {size.width_px, size.height_px},
        matrix, distortion, rotations, translations, sigmas, cv::noArray(), cv::noArray(),
        flags_for(terms), {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-10});
    fit.camera = camera_from(size, matrix, distortion);
    constexpr int kK3 = 8;  // fx fy cx cy k1 k2 p1 p2 k3
    fit.k3_sigma = sigmas.at<double>(kK3);
    return fit;
  } catch (const cv::Exception& error) {
    return opencv_error(error);
  }
}

Result<StereoFit> fit_stereo(const Chessboard& board, ImageSize size,
                             std::span<const BoardCorners> left,
                             std::span<const BoardCorners> right, const BrownConrady& left_start,
                             const BrownConrady& right_start, LensTerms terms) {
  const QuietOpenCv quiet;
  try {
    cv::Mat left_matrix = matrix_of(left_start);
    cv::Mat right_matrix = matrix_of(right_start);
    cv::Mat left_distortion = distortion_of(left_start);
    cv::Mat right_distortion = distortion_of(right_start);
    cv::Mat rotation;
    cv::Mat translation;
    cv::Mat essential;
    cv::Mat fundamental;
    cv::Mat view_rms;
    StereoFit fit;
    fit.rms_px = cv::stereoCalibrate(
        object_points(board, left.size()), image_points(left), image_points(right), left_matrix,
        left_distortion, right_matrix, right_distortion, {size.width_px, size.height_px}, rotation,
        translation, essential, fundamental, view_rms,
        flags_for(terms) | cv::CALIB_USE_INTRINSIC_GUESS,
        {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-10});
    fit.left = camera_from(size, left_matrix, left_distortion);
    fit.right = camera_from(size, right_matrix, right_distortion);
    const auto between = transform_from(rotation, translation);
    if (!between) {
      return Error{"camera calibration: " + between.error().message};
    }
    fit.right_from_left = *between;
    for (int i = 0; i < view_rms.rows; ++i) {
      fit.view_rms_px.push_back({view_rms.at<double>(i, 0), view_rms.at<double>(i, 1)});
    }
    return fit;
  } catch (const cv::Exception& error) {
    return opencv_error(error);
  }
}

}  // namespace orthonav::nav
