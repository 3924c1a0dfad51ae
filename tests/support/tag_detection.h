#pragma once

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <array>
#include <map>

#include "base/image.h"
#include "base/vec.h"

namespace orthonav::sim::scene {

/// Corners in Marker's order (-s,-s), (s,-s), (s,s), (-s,s), continuous pixels, by tag id.
using Detections = std::map<int, std::array<Vec2, 4>>;

/// AprilTag with its defaults at full resolution.
inline Detections detect(const GreyImage& image) {
  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, family);
  detector->quad_decimate = 1.0F;
  GreyImage copy = image;
  image_u8_t view = {copy.width_px, copy.height_px, copy.width_px, copy.pixels.data()};
  zarray_t* found = apriltag_detector_detect(detector, &view);
  Detections detections;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* one = nullptr;
    zarray_get(found, i, &one);
    for (std::size_t k = 0; k < 4; ++k) {
      detections[one->id][k] = {one->p[k][0], one->p[k][1]};
    }
  }
  apriltag_detections_destroy(found);
  apriltag_detector_destroy(detector);
  tag36h11_destroy(family);
  return detections;
}

}  // namespace orthonav::sim::scene
