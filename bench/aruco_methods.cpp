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

}  // namespace

std::vector<NamedDetect> aruco_detectors(const std::string& family) {
  // tag36h11b2 has the codes of tag36h11 inside a border of two cells.
  const bool wide = family == "tag36h11b2";
  if (!wide && family != "tag36h11" && family != "tag36h10") {
    return {};
  }
  const auto dictionary = cv::aruco::getPredefinedDictionary(
      family == "tag36h10" ? cv::aruco::DICT_APRILTAG_36h10 : cv::aruco::DICT_APRILTAG_36h11);
  std::vector<NamedDetect> all;
  const auto add = [&](const char* name, cv::aruco::CornerRefineMethod refinement,
                       int window_px = kWindowPx) {
    const auto parameters = cv::aruco::DetectorParameters::create();
    parameters->cornerRefinementMethod = refinement;
    parameters->cornerRefinementWinSize = window_px;
    parameters->markerBorderBits = wide ? 2 : 1;
    all.push_back({std::string("ArUco, ") + name, [=](const GreyImage& image, auto& found) {
                     cv::setNumThreads(1);
                     return detect(dictionary, parameters, image, found);
                   }});
  };
  add("none", cv::aruco::CORNER_REFINE_NONE);
  add("subpix", cv::aruco::CORNER_REFINE_SUBPIX);
  add("subpix 2 px", cv::aruco::CORNER_REFINE_SUBPIX, kSmallWindowPx);
  add("contour", cv::aruco::CORNER_REFINE_CONTOUR);
  add("apriltag", cv::aruco::CORNER_REFINE_APRILTAG);
  return all;
}

}  // namespace orthonav::bench
