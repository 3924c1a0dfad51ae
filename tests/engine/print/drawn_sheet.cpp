#include "tests/engine/print/drawn_sheet.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "nav/tracking/marker_detector.h"

namespace orthonav::engine::print_test {

PrintedTag tag(const std::string& family, int id, double size_m, const std::string& tool) {
  PrintedTag printed;
  printed.marker.family = family;
  printed.marker.id = id;
  printed.marker.size_m = size_m;
  printed.name = tool;
  return printed;
}

GreyImage drawn(const Sheet& sheet, double px_per_mm) {
  auto image = image_of(sheet, px_per_mm);
  EXPECT_TRUE(image);
  return image ? *image : GreyImage();
}

std::map<int, Corners> detected(const GreyImage& image, const std::string& family) {
  nav::DetectorOptions options;
  options.families = {family};
  auto detector = nav::MarkerDetector::create(options);
  std::vector<nav::MarkerCorners> found;
  EXPECT_TRUE(detector && detector->detect(image, found));
  std::map<int, Corners> corners;
  for (const nav::MarkerCorners& marker : found) {
    EXPECT_FALSE(corners.contains(marker.id)) << "id " << marker.id << " twice";
    for (std::size_t i = 0; i < 4; ++i) {
      corners[marker.id][i] = marker.corners_px[i] * (1.0 / kPxPerMm);
    }
  }
  return corners;
}

Corners square(double left_mm, double top_mm, double size_mm) {
  const double right = left_mm + size_mm;
  const double bottom = top_mm + size_mm;
  return {{{left_mm, bottom}, {right, bottom}, {right, top_mm}, {left_mm, top_mm}}};
}

double farthest_mm(const Corners& a, const Corners& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    farthest = std::max(farthest, (a[i] - b[i]).norm());
  }
  return farthest;
}

std::map<int, Corners> detected_with_wide_borders(const GreyImage& image) {
  const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(),
                                                                                tag36h11_destroy);
  family->width_at_border += 2;
  family->total_width += 2;
  for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
    ++family->bit_x[bit];
    ++family->bit_y[bit];
  }
  const std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), family.get(), 1);
  detector->quad_decimate = 1;
  GreyImage copy = image;
  image_u8_t view = {copy.width_px, copy.height_px, copy.width_px, copy.pixels.data()};
  zarray_t* detections = apriltag_detector_detect(detector.get(), &view);
  std::map<int, Corners> corners;
  for (int i = 0; i < zarray_size(detections); ++i) {
    apriltag_detection_t* found = nullptr;
    zarray_get(detections, i, &found);
    if (found->decision_margin < nav::DetectorOptions().min_decision_margin) {
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      corners[found->id][k] = {found->p[k][0] / kPxPerMm, found->p[k][1] / kPxPerMm};
    }
  }
  apriltag_detections_destroy(detections);
  return corners;
}

}  // namespace orthonav::engine::print_test
