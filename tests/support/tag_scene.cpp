#include "tests/support/tag_scene.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "nav/tracking/tag_pose.h"

namespace orthonav::test {
namespace {

constexpr double kBackground = 110.0;
constexpr double kWhite = 230.0;
constexpr double kBlack = 20.0;
constexpr int kRaysASide = 8;

struct Family {
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

const std::map<std::string, Family>& families() {
  static const std::map<std::string, Family> all = {
      {"tag36h11", {tag36h11_create, tag36h11_destroy}},
      {"tag36h10", {tag36h10_create, tag36h10_destroy}},
      {"tag25h9", {tag25h9_create, tag25h9_destroy}},
      {"tag16h5", {tag16h5_create, tag16h5_destroy}},
      {"tagStandard41h12", {tagStandard41h12_create, tagStandard41h12_destroy}},
      {"tagStandard52h13", {tagStandard52h13_create, tagStandard52h13_destroy}},
      {"tagCircle21h7", {tagCircle21h7_create, tagCircle21h7_destroy}},
      {"tagCircle49h12", {tagCircle49h12_create, tagCircle49h12_destroy}},
      {"tagCustom48h12", {tagCustom48h12_create, tagCustom48h12_destroy}}};
  return all;
}

// Grey where a ray of the marker frame meets the tag's plane; negative beside the tag.
double grey_on(const TagPicture& tag, double size_m, double x_m, double y_m) {
  const double cell_m = size_m / (tag.cells - 2 * tag.border_cells);
  const int column = static_cast<int>(std::floor(x_m / cell_m + tag.cells / 2.0));
  const int row = static_cast<int>(std::floor(-y_m / cell_m + tag.cells / 2.0));
  if (column < 0 || row < 0 || column >= tag.cells || row >= tag.cells) {
    return -1.0;
  }
  return tag.white[static_cast<std::size_t>(row * tag.cells + column)] ? kWhite : kBlack;
}

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

// Where the n-th ray goes in a pixel's footprint: a box two pixels wide, like a lens's blur. With
// unblurred edges along the rows the library's corners are off by a quarter of a pixel.
Vec2 place_of(int x, int y, int ray, int rays_a_side) {
  return {x - 0.5 + 2.0 * (ray % rays_a_side + 0.5) / rays_a_side,
          y - 0.5 + 2.0 * (ray / rays_a_side + 0.5) / rays_a_side};
}

// The same for the first quarter of the footprint, which is the last quarter of the previous pixel.
Vec2 quarter_place_of(int x, int y, int ray) {
  return place_of(x, y, ray / (kRaysASide / 2) * kRaysASide + ray % (kRaysASide / 2), kRaysASide);
}

void draw(const Camera& camera, const PlacedTag& tag, std::vector<double>& sums,
          std::vector<double>& covered) {
  const TagPicture cells = tag_picture(tag.family, tag.id);
  const Mat3 marker_from_rig = tag.rig_from_marker.rotation().transposed();
  const Mat3 rotation = marker_from_rig * camera.rig_from_camera.rotation();
  const Vec3 eye =
      marker_from_rig * (camera.rig_from_camera.translation() - tag.rig_from_marker.translation());
  if (eye.z < 0.0) {
    return;
  }
  const double border = double(cells.cells) / (cells.cells - 2 * cells.border_cells);
  const nav::PixelBox box = box_of(camera, tag, border);
  const auto grey = [&](Vec2 place) {
    const auto unit = camera.model.unproject(place);
    if (!unit) {
      return -1.0;
    }
    const Vec3 direction = rotation * Vec3{unit->x, unit->y, 1.0};
    const double along = -eye.z / direction.z;
    if (!(along > 0.0)) {
      return -1.0;
    }
    return grey_on(cells, tag.size_m, eye.x + along * direction.x, eye.y + along * direction.y);
  };
  // Footprints overlap: each quarter of one belongs to four pixels.
  for (int y = box.y_px; y <= box.y_px + box.height_px; ++y) {
    for (int x = box.x_px; x <= box.x_px + box.width_px; ++x) {
      double sum = 0.0;
      double count = 0.0;
      for (int ray = 0; ray < kRaysASide * kRaysASide / 4; ++ray) {
        const double seen = grey(quarter_place_of(x, y, ray));
        if (seen < 0.0) {
          continue;
        }
        sum += seen;
        count += 1.0;
      }
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

}  // namespace

namespace {

// The library has no such family: adds a ring of black cells between code and white border.
TagPicture with_wider_border(const TagPicture& tag) {
  TagPicture wide;
  wide.cells = tag.cells + 2;
  wide.border_cells = tag.border_cells;
  const auto is_white = [&](int column, int row) {
    const int last = wide.cells - 1;
    if (column == 0 || row == 0 || column == last || row == last) {
      return true;
    }
    if (column == 1 || row == 1 || column == last - 1 || row == last - 1) {
      return false;
    }
    return bool(tag.white[static_cast<std::size_t>((row - 1) * tag.cells + column - 1)]);
  };
  for (int row = 0; row < wide.cells; ++row) {
    for (int column = 0; column < wide.cells; ++column) {
      wide.white.push_back(is_white(column, row));
    }
  }
  return wide;
}

}  // namespace

TagPicture tag_picture(const std::string& family, int id) {
  if (family == "tag36h11b2") {
    return with_wider_border(tag_picture("tag36h11", id));
  }
  const Family& known = families().at(family);
  apriltag_family_t* made = known.create();
  image_u8_t* image = apriltag_to_image(made, id);
  TagPicture picture;
  picture.cells = image->width;
  picture.border_cells = (made->total_width - made->width_at_border) / 2;
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      picture.white.push_back(image->buf[y * image->stride + x] > 127);
    }
  }
  // What the library's image_u8_destroy does; Debian's library does not export it.
  std::free(image->buf);
  std::free(image);
  known.destroy(made);
  return picture;
}

StereoCalibration test_calibration() {
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

GreyImage picture(const CameraModel& camera, const Transform<Rig, Marker>& rig_from_camera,
                  const std::vector<PlacedTag>& tags) {
  GreyImage image(camera.width_px(), camera.height_px());
  std::vector<double> sums(image.pixels.size(), 0.0);
  std::vector<double> covered(image.pixels.size(), 0.0);
  for (const PlacedTag& tag : tags) {
    draw({camera, rig_from_camera}, tag, sums, covered);
  }
  constexpr double kRays = kRaysASide * kRaysASide;
  std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(kBackground));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (covered[i] > 0.0) {
      image.pixels[i] = static_cast<std::uint8_t>(
          std::lround((sums[i] + kBackground * std::max(0.0, kRays - covered[i])) /
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

GreyImage april_grid_picture(int columns, int rows, double cell_px, double spacing) {
  std::vector<TagPicture> tags;
  for (int id = 0; id < columns * rows; ++id) {
    tags.push_back(tag_picture("tag36h11b2", id));
  }
  const double edge_px = 10 * cell_px;
  const double pitch_px = (1 + spacing) * edge_px;
  const auto grey = [&](Vec2 p) {
    const int column = static_cast<int>(std::floor((p.x - spacing * edge_px) / pitch_px));
    const int row = static_cast<int>(std::floor((p.y - spacing * edge_px) / pitch_px));
    const Vec2 in{p.x - spacing * edge_px - column * pitch_px,
                  p.y - spacing * edge_px - row * pitch_px};
    const bool on_tag = in.x < edge_px && in.y < edge_px;
    if (in.x >= edge_px && in.y >= edge_px && column < columns && row < rows) {
      return kBlack;
    }
    if (!on_tag || column < 0 || row < 0 || column >= columns || row >= rows) {
      return kWhite;
    }
    return grey_on(tags[static_cast<std::size_t>(row * columns + column)], edge_px,
                   in.x - edge_px / 2, edge_px / 2 - in.y);
  };
  GreyImage image(static_cast<int>(columns * pitch_px + 2 * spacing * edge_px),
                  static_cast<int>(rows * pitch_px + 2 * spacing * edge_px));
  constexpr int kSide = 8;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      double sum = 0.0;
      for (int ray = 0; ray < kSide * kSide; ++ray) {
        sum += grey(place_of(x, y, ray, kSide));
      }
      image.at(x, y) = static_cast<std::uint8_t>(std::lround(sum / (kSide * kSide)));
    }
  }
  return image;
}

GreyImage flat_picture(const std::string& family, int id, int width_px, int height_px, Vec2 corner,
                       double cell_px) {
  const TagPicture tag = tag_picture(family, id);
  GreyImage image(width_px, height_px);
  constexpr int kSide = 16;
  const double edge_px = cell_px * (tag.cells - 2 * tag.border_cells);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      double sum = 0.0;
      for (int ray = 0; ray < kSide * kSide; ++ray) {
        const Vec2 from_centre = place_of(x, y, ray, kSide) - corner - 0.5 * Vec2{edge_px, edge_px};
        const double grey = grey_on(tag, edge_px, from_centre.x, -from_centre.y);
        sum += grey < 0.0 ? kWhite : grey;
      }
      image.at(x, y) = static_cast<std::uint8_t>(std::lround(sum / (kSide * kSide)));
    }
  }
  return image;
}

}  // namespace orthonav::test
