#include "bench/aruco_methods.h"

#include <opencv2/aruco.hpp>
#include <opencv2/core/utility.hpp>

namespace orthonav::bench {
namespace {

/// ArUco starts at the upright tag's bottom right corner and goes round the other way.
constexpr std::array<std::size_t, 4> kTheirs{1, 0, 3, 2};

/// What to add to OpenCV's corners: our first pixel's centre is at (0.5, 0.5), OpenCV's at (0, 0),
/// except for quads that it takes over from AprilTag unchanged (OpenCV 4.6).
double corner_offset_px(cv::aruco::CornerRefineMethod refinement) {
  return refinement == cv::aruco::CORNER_REFINE_APRILTAG ? 0.0 : 0.5;
}

bool detect(const cv::Ptr<cv::aruco::Dictionary>& dictionary,
            const cv::Ptr<cv::aruco::DetectorParameters>& parameters, const GreyImage& image,
            std::vector<nav::MarkerCorners>& found) {
  found.clear();
  // OpenCV has no read-only matrix; the detector does not write.
  const cv::Mat view(image.height_px, image.width_px, CV_8UC1,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<int> ids;
  std::vector<std::vector<cv::Point2f>> corners;
  try {
    cv::aruco::detectMarkers(view, dictionary, corners, ids, parameters);
  } catch (const cv::Exception&) {
    return false;
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    nav::MarkerCorners tag;
    tag.family = "tag36h11";
    tag.id = ids[i];
    const double offset_px = corner_offset_px(
        static_cast<cv::aruco::CornerRefineMethod>(parameters->cornerRefinementMethod));
    for (std::size_t k = 0; k < 4; ++k) {
      const cv::Point2f theirs = corners[i][kTheirs[k]];
      tag.corners_px[k] = {static_cast<double>(theirs.x) + offset_px,
                           static_cast<double>(theirs.y) + offset_px};
    }
    found.push_back(tag);
  }
  return true;
}

/// OpenCV's default; where cells are small, the window holds more than the corner.
constexpr int kWindowPx = 5;
constexpr int kSmallWindowPx = 2;

Method method(const std::string& name, cv::aruco::CornerRefineMethod refinement,
              int window_px = kWindowPx) {
  return {"ArUco, " + name, [refinement, window_px](const Sequence& sequence) {
            cv::setNumThreads(1);
            const auto dictionary =
                cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
            const auto parameters = cv::aruco::DetectorParameters::create();
            parameters->cornerRefinementMethod = refinement;
            parameters->cornerRefinementWinSize = window_px;
            return tracked_by_corners(sequence, [=](const GreyImage& image, auto& found) {
              return detect(dictionary, parameters, image, found);
            });
          }};
}

}  // namespace

void add_aruco_methods(std::vector<Method>& methods) {
  methods.push_back(method("none", cv::aruco::CORNER_REFINE_NONE));
  methods.push_back(method("subpix", cv::aruco::CORNER_REFINE_SUBPIX));
  methods.push_back(method("subpix 2 px", cv::aruco::CORNER_REFINE_SUBPIX, kSmallWindowPx));
  methods.push_back(method("contour", cv::aruco::CORNER_REFINE_CONTOUR));
  methods.push_back(method("apriltag", cv::aruco::CORNER_REFINE_APRILTAG));
}

}  // namespace orthonav::bench
