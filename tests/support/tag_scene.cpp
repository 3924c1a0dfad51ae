#include "tests/support/tag_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "nav/tracking/tag_pose.h"
#include "tests/support/tag_picture.h"

namespace orthonav::test {
namespace {

constexpr int kRaysASide = 8;

struct Camera {
  const CameraModel& model;
  Transform<Rig, Marker> rig_from_camera;  // the type of the camera frame does not matter here
};

// The pixels that a tag with its white border may touch.
nav::PixelBox box_of(const Camera& camera, const PlacedTag& tag, double border) {
  Vec2 low{1e9, 1e9};
  Vec2 high{-1e9, -1e9};
  for (const Vec3& corner : nav::corners_in_marker(tag.size_m * border)) {
    const Vec3 in_rig = (tag.rig_from_marker * Point<Marker>{corner}).v;
    const Vec3 in_camera = camera.rig_from_camera.rotation().transposed() *
                           (in_rig - camera.rig_from_camera.translation());
    const auto seen = camera.model.project(in_camera);
    if (!seen) {
      return {0, 0, camera.model.width_px(), camera.model.height_px()};
    }
    low = {std::min(low.x, seen->x), std::min(low.y, seen->y)};
    high = {std::max(high.x, seen->x), std::max(high.y, seen->y)};
  }
  const int x = std::max(0, static_cast<int>(low.x) - 3);
  const int y = std::max(0, static_cast<int>(low.y) - 3);
  return {x, y, std::min(camera.model.width_px(), static_cast<int>(high.x) + 4) - x,
          std::min(camera.model.height_px(), static_cast<int>(high.y) + 4) - y};
}

// The same for the first quarter of the footprint, which is the last quarter of the previous pixel.
Vec2 quarter_place_of(int x, int y, int ray) {
  return place_of(x, y, ray / (kRaysASide / 2) * kRaysASide + ray % (kRaysASide / 2), kRaysASide);
}

// A tag as a camera sees it; `eye` is in the marker's frame.
struct SeenTag {
  const Camera& camera;
  const TagPicture& cells;
  double size_m = 0.0;
  Mat3 marker_from_camera;
  Vec3 eye;

  // Empty if the ray does not meet the tag's plane.
  [[nodiscard]] std::optional<TagPlace> seen_at(Vec2 place) const {
    const auto unit = camera.model.unproject(place);
    if (!unit) {
      return std::nullopt;
    }
    const Vec3 direction = marker_from_camera * Vec3{unit->x, unit->y, 1.0};
    const double along = -eye.z / direction.z;
    if (!(along > 0.0)) {
      return std::nullopt;
    }
    return place_on(cells, size_m, eye.x + along * direction.x, eye.y + along * direction.y);
  }

  struct Rays {
    double sum = 0.0;    // of greys
    double count = 0.0;  // of those that meet the tag
  };
  [[nodiscard]] Rays quarter_at(int x, int y) const;
};

constexpr int kQuarterRays = kRaysASide * kRaysASide / 4;

// Whether both lie in the same cell, so far within it that what is seen between them does too:
// straight lines are bent by far less.
bool in_one_cell(const TagPlace& a, const TagPlace& b) {
  constexpr double kWithin = 0.02;
  const auto well_within = [](double p, double q) {
    const double cell = std::floor(p);
    return std::min(p, q) > cell + kWithin && std::max(p, q) < cell + 1.0 - kWithin;
  };
  return well_within(a.column, b.column) && well_within(a.row, b.row);
}

SeenTag::Rays SeenTag::quarter_at(int x, int y) const {
  constexpr int kLast = kRaysASide / 2 - 1;
  const auto first = seen_at(quarter_place_of(x, y, 0));
  bool one_cell = first.has_value();
  for (const int ray : {kLast, kQuarterRays - 1 - kLast, kQuarterRays - 1}) {
    const auto corner = one_cell ? seen_at(quarter_place_of(x, y, ray)) : std::nullopt;
    one_cell = corner && in_one_cell(*first, *corner);
  }
  Rays rays;
  const auto add = [&rays](double grey, double count) {
    if (grey >= 0.0) {
      rays.sum += count * grey;
      rays.count += count;
    }
  };
  if (one_cell) {
    add(grey_at(cells, *first), kQuarterRays);
    return rays;
  }
  for (int ray = 0; ray < kQuarterRays; ++ray) {
    if (const auto seen = seen_at(quarter_place_of(x, y, ray))) {
      add(grey_at(cells, *seen), 1.0);
    }
  }
  return rays;
}

void draw(const Camera& camera, const PlacedTag& tag, std::vector<double>& sums,
          std::vector<double>& covered) {
  const TagPicture cells = tag_picture(tag.family, tag.id);
  const Mat3 marker_from_rig = tag.rig_from_marker.rotation().transposed();
  const Vec3 eye =
      marker_from_rig * (camera.rig_from_camera.translation() - tag.rig_from_marker.translation());
  if (eye.z < 0.0) {
    return;
  }
  const SeenTag seen_tag{camera, cells, tag.size_m,
                         marker_from_rig * camera.rig_from_camera.rotation(), eye};
  const double border = double(cells.cells) / (cells.cells - 2 * cells.border_cells);
  const nav::PixelBox box = box_of(camera, tag, border);
  // Footprints overlap: each quarter of one belongs to four pixels.
  for (int y = box.y_px; y <= box.y_px + box.height_px; ++y) {
    for (int x = box.x_px; x <= box.x_px + box.width_px; ++x) {
      const auto [sum, count] = seen_tag.quarter_at(x, y);
      for (const int row : {y - 1, y}) {
        for (const int column : {x - 1, x}) {
          if (row < box.y_px || column < box.x_px || row == box.y_px + box.height_px ||
              column == box.x_px + box.width_px) {
            continue;
          }
          const auto i = static_cast<std::size_t>(row * camera.model.width_px() + column);
          sums[i] += sum;
          covered[i] += count;
        }
      }
    }
  }
}

template <class CameraFrame>
std::array<Vec2, 4> corners_seen(const CameraModel& model,
                                 const Transform<CameraFrame, Rig>& camera_from_rig,
                                 const PlacedTag& tag) {
  std::array<Vec2, 4> seen;
  const auto corners = nav::corners_in_marker(tag.size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    seen[i] = model.project((camera_from_rig * (tag.rig_from_marker * Point<Marker>{corners[i]})).v)
                  .value();
  }
  return seen;
}

StereoCalibration made_calibration() {
  const BrownConrady left{640, 480, 362.0, 361.0, 324.0, 238.0, -0.04, 0.01, 3e-4, -2e-4, 0.0};
  const BrownConrady right{640, 480, 359.0, 360.0, 317.0, 243.0, -0.038, 0.009, -2e-4, 3e-4, 0.0};
  StereoCalibration calibration;
  calibration.left = CameraModel::from_brown_conrady(left).value();
  calibration.right = CameraModel::from_brown_conrady(right).value();
  calibration.left_from_rig = {{{{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}}}, {}};
  const Mat3 right_rotation = {{{{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}}};
  calibration.right_from_rig = {right_rotation * rotation_from_vector({0.005, -0.01, 0.008}),
                                {0.0, 0.099, 0.004}};
  return calibration;
}

}  // namespace

StereoCalibration test_calibration() {
  static const StereoCalibration made = made_calibration();
  return made;
}

GreyImage picture(const CameraModel& camera, const Transform<Rig, Marker>& rig_from_camera,
                  const std::vector<PlacedTag>& tags) {
  GreyImage image(camera.width_px(), camera.height_px());
  std::vector<double> sums(image.pixels.size(), 0.0);
  std::vector<double> covered(image.pixels.size(), 0.0);
  for (const PlacedTag& tag : tags) {
    draw({camera, rig_from_camera}, tag, sums, covered);
  }
  constexpr double kRays = kRaysASide * kRaysASide;
  std::fill(image.pixels.begin(), image.pixels.end(), kSceneGrey);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (covered[i] > 0.0) {
      image.pixels[i] = static_cast<std::uint8_t>(
          std::lround((sums[i] + kSceneGrey * std::max(0.0, kRays - covered[i])) /
                      std::max(kRays, covered[i])));
    }
  }
  return image;
}

StereoFrame stereo_frame(const StereoCalibration& calibration, const std::vector<PlacedTag>& tags,
                         Timestamp time) {
  const auto left = calibration.left_from_rig.inverse();
  const auto right = calibration.right_from_rig.inverse();
  StereoFrame frame;
  frame.time = time;
  frame.left = picture(calibration.left, {left.rotation(), left.translation()}, tags);
  frame.right = picture(calibration.right, {right.rotation(), right.translation()}, tags);
  frame.world_from_rig =
      Transform<World, Rig>(rotation_from_vector({0.1, -0.4, 0.05}), {0.3, 1.6, -0.2});
  return frame;
}

std::array<Vec2, 4> left_corners(const StereoCalibration& calibration, const PlacedTag& tag) {
  return corners_seen(calibration.left, calibration.left_from_rig, tag);
}

std::array<Vec2, 4> right_corners(const StereoCalibration& calibration, const PlacedTag& tag) {
  return corners_seen(calibration.right, calibration.right_from_rig, tag);
}

Transform<Rig, Marker> facing(Vec3 offset_m, Vec3 rotation_rad) {
  // The rig looks along -z, so an unturned marker faces it.
  return {rotation_from_vector(rotation_rad), Vec3{0.05, 0.0, -0.4} + offset_m};
}

}  // namespace orthonav::test
