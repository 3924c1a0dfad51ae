#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/vec.h"

namespace orthonav::test {

/// The picture of a tag, straight from the AprilTag library: true is white.
struct TagPicture {
  int cells = 0;         ///< a side, with the white border
  int border_cells = 0;  ///< outside the edge that is the tag's size
  std::vector<bool> white;
};
TagPicture tag_picture(const std::string& family, int id);

inline constexpr double kTagWhite = 230.0;
inline constexpr double kTagBlack = 20.0;

/// A place on a tag, in cells from its picture's top left corner.
struct TagPlace {
  double column = 0.0;
  double row = 0.0;
};
inline TagPlace place_on(const TagPicture& tag, double size_m, double x_m, double y_m) {
  const double cell_m = size_m / (tag.cells - 2 * tag.border_cells);
  return {x_m / cell_m + tag.cells / 2.0, -y_m / cell_m + tag.cells / 2.0};
}

/// Negative beside the tag.
inline double grey_at(const TagPicture& tag, TagPlace place) {
  const int column = static_cast<int>(std::floor(place.column));
  const int row = static_cast<int>(std::floor(place.row));
  if (column < 0 || row < 0 || column >= tag.cells || row >= tag.cells) {
    return -1.0;
  }
  return tag.white[static_cast<std::size_t>(row * tag.cells + column)] ? kTagWhite : kTagBlack;
}

/// Grey where a ray of the marker frame meets the tag's plane; negative beside the tag.
inline double grey_on(const TagPicture& tag, double size_m, double x_m, double y_m) {
  return grey_at(tag, place_on(tag, size_m, x_m, y_m));
}

/// Where the n-th ray goes in a pixel's footprint: a box two pixels wide, like a lens's blur. With
/// unblurred edges along the rows the library's corners are off by a quarter of a pixel.
inline Vec2 place_of(int x, int y, int ray, int rays_a_side) {
  return {x - 0.5 + 2.0 * (ray % rays_a_side + 0.5) / rays_a_side,
          y - 0.5 + 2.0 * (ray / rays_a_side + 0.5) / rays_a_side};
}

/// A flat picture: the tag magnified to `cell_px` a cell with its outer edge's top left corner at
/// `corner`, in continuous pixels, on white.
GreyImage flat_picture(const std::string& family, int id, int width_px, int height_px, Vec2 corner,
                       double cell_px);

/// A board on white: tags of ids 0, 1, ..., and small black squares between them that touch their
/// corners; of tag36h11b2, Kalibr's AprilGrid. The first tag's outer edge begins at (edge ·
/// spacing) from the left and the top; the next is (1 + spacing) edges farther.
GreyImage april_grid_picture(int columns, int rows, double edge_px, double spacing,
                             const std::string& family = "tag36h11b2");

}  // namespace orthonav::test
