#include "tests/support/tag_picture.h"

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

#include <cmath>
#include <cstdlib>
#include <map>

namespace orthonav::test {
namespace {

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

/// Each pixel is the mean of `rays_a_side` squared rays, each of whole grey. Footprints overlap:
/// each quarter of one belongs to four pixels.
template <class Grey>
GreyImage averaged(int width_px, int height_px, int rays_a_side, const Grey& grey) {
  const int rays = rays_a_side * rays_a_side;
  const auto width = static_cast<std::size_t>(width_px) + 1;
  std::vector<double> first_quarters;
  for (int y = 0; y <= height_px; ++y) {
    for (int x = 0; x <= width_px; ++x) {
      double sum = 0.0;
      for (int row = 0; row < rays_a_side / 2; ++row) {
        for (int column = 0; column < rays_a_side / 2; ++column) {
          sum += grey(place_of(x, y, row * rays_a_side + column, rays_a_side));
        }
      }
      first_quarters.push_back(sum);
    }
  }
  GreyImage image(width_px, height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double* q =
          &first_quarters[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
      image.at(x, y) =
          static_cast<std::uint8_t>(std::lround((q[0] + q[1] + q[width] + q[width + 1]) / rays));
    }
  }
  return image;
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

GreyImage april_grid_picture(int columns, int rows, double edge_px, double spacing,
                             const std::string& family) {
  std::vector<TagPicture> tags;
  for (int id = 0; id < columns * rows; ++id) {
    tags.push_back(tag_picture(family, id));
  }
  const double pitch_px = (1 + spacing) * edge_px;
  const auto grey = [&](Vec2 p) {
    const int column = static_cast<int>(std::floor((p.x - spacing * edge_px) / pitch_px));
    const int row = static_cast<int>(std::floor((p.y - spacing * edge_px) / pitch_px));
    const Vec2 in{p.x - spacing * edge_px - column * pitch_px,
                  p.y - spacing * edge_px - row * pitch_px};
    const bool on_tag = in.x < edge_px && in.y < edge_px;
    if (in.x >= edge_px && in.y >= edge_px && column < columns && row < rows) {
      return kTagBlack;
    }
    if (!on_tag || column < 0 || row < 0 || column >= columns || row >= rows) {
      return kTagWhite;
    }
    return grey_on(tags[static_cast<std::size_t>(row * columns + column)], edge_px,
                   in.x - edge_px / 2, edge_px / 2 - in.y);
  };
  return averaged(static_cast<int>(columns * pitch_px + 2 * spacing * edge_px),
                  static_cast<int>(rows * pitch_px + 2 * spacing * edge_px), 8, grey);
}

GreyImage flat_picture(const std::string& family, int id, int width_px, int height_px, Vec2 corner,
                       double cell_px) {
  const TagPicture tag = tag_picture(family, id);
  const double edge_px = cell_px * (tag.cells - 2 * tag.border_cells);
  return averaged(width_px, height_px, 16, [&](Vec2 place) {
    const Vec2 from_centre = place - corner - 0.5 * Vec2{edge_px, edge_px};
    const double grey = grey_on(tag, edge_px, from_centre.x, -from_centre.y);
    return grey < 0.0 ? kTagWhite : grey;
  });
}

}  // namespace orthonav::test
