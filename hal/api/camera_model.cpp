#include "hal/api/camera_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "hal/api/brown_conrady.h"
#include "hal/api/lookup_cell.h"
#include "hal/api/start_grid.h"

namespace orthonav {
namespace {

/// Far beyond any sensor; keeps width · height from overflowing on damaged input.
constexpr int kMaxSide = 16384;
/// Newton's error is about the square of its last step: 1e-8 px, where the contract is 1e-6.
constexpr double kNewtonStepPx = 1e-4;
constexpr int kNewtonSteps = 30;
/// A point that is just past the image's edge due to rounding counts as on it.
constexpr double kEdgePx = 1e-7;

struct Place {
  int column = 0;
  int row = 0;
  double s = 0.0;
  double t = 0.0;
};

Place place_of(Vec2 pixel_px, int width_px, int height_px) {
  // Clamped before the conversion: Newton may ask for pixels that no int can hold.
  const double x = pixel_px.x - 0.5;
  const double y = pixel_px.y - 0.5;
  const int column = static_cast<int>(std::clamp(std::floor(x), 0.0, width_px - 2.0));
  const int row = static_cast<int>(std::clamp(std::floor(y), 0.0, height_px - 2.0));
  return {column, row, x - column, y - row};
}

/// +1 or -1 where the cell keeps or mirrors orientation throughout, 0 where it folds: the
/// determinant of a bilinear map is linear in each fraction, so its corners bound it.
int orientation(const LookupCell& cell) {
  int positive = 0;
  int negative = 0;
  for (const double t : {0.0, 1.0}) {
    for (const double s : {0.0, 1.0}) {
      const double determinant = cell.along_x(t).cross(cell.along_y(s));
      positive += determinant > 0.0 ? 1 : 0;
      negative += determinant < 0.0 ? 1 : 0;
    }
  }
  return positive == 4 ? 1 : (negative == 4 ? -1 : 0);
}

/// Newton's step in pixels: how far to move in the cell to change the direction by `off`.
std::optional<Vec2> newton_step(const LookupCell& cell, const Place& at, Vec2 off) {
  const Vec2 by_x = cell.along_x(at.t);
  const Vec2 by_y = cell.along_y(at.s);
  const double determinant = by_x.cross(by_y);
  if (determinant == 0.0) {
    return std::nullopt;
  }
  return Vec2{off.cross(by_y) / determinant, by_x.cross(off) / determinant};
}

/// The pixel, moved onto the image's edge if it is just past it due to rounding; nothing farther
/// out.
std::optional<Vec2> on_image(Vec2 pixel_px, int width_px, int height_px) {
  if (pixel_px.x < -kEdgePx || pixel_px.y < -kEdgePx || pixel_px.x > width_px + kEdgePx ||
      pixel_px.y > height_px + kEdgePx) {
    return std::nullopt;
  }
  return Vec2{std::clamp(pixel_px.x, 0.0, static_cast<double>(width_px)),
              std::clamp(pixel_px.y, 0.0, static_cast<double>(height_px))};
}

std::string pixel_name(int column, int row) {
  return std::string("(").append(std::to_string(column)).append(", ").append(std::to_string(row)) +
         ")";
}

Status check_entries(int width_px, std::vector<Vec2>& lookup) {
  std::size_t valid = 0;
  for (std::size_t i = 0; i < lookup.size(); ++i) {
    Vec2& v = lookup[i];
    if (std::isinf(v.x) || std::isinf(v.y)) {
      return Error{"camera look-up table holds an infinity at pixel " +
                   pixel_name(static_cast<int>(i) % width_px, static_cast<int>(i) / width_px)};
    }
    if (is_nan(v)) {
      v = kNoDirection;
    } else {
      ++valid;
    }
  }
  if (valid == 0) {
    return Error{"camera look-up table has no valid pixel (all NaN)"};
  }
  return {};
}

Status check_folds(int width_px, int height_px, std::span<const Vec2> lookup) {
  int sign = 0;
  for (int row = 0; row + 1 < height_px; ++row) {
    for (int column = 0; column + 1 < width_px; ++column) {
      const LookupCell cell = cell_at(lookup, width_px, column, row);
      if (!cell.valid()) {
        continue;
      }
      const int here = orientation(cell);
      if (here == 0 || (sign != 0 && here != sign)) {
        return Error{"camera look-up table folds over at pixel " + pixel_name(column, row) +
                     ": two pixels would see the same direction"};
      }
      sign = here;
    }
  }
  if (sign == 0) {
    return Error{"camera look-up table has no four neighbouring valid pixels to interpolate in"};
  }
  return {};
}

Status check_size(int width_px, int height_px) {
  if (width_px < 2 || height_px < 2 || width_px > kMaxSide || height_px > kMaxSide) {
    return Error{"camera image is " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                 " px, each side must be 2 to " + std::to_string(kMaxSide)};
  }
  return {};
}

}  // namespace

Result<CameraModel> CameraModel::from_lookup(int width_px, int height_px,
                                             std::vector<Vec2> unit_plane) {
  if (Status size = check_size(width_px, height_px); !size) {
    return size.error();
  }
  const std::size_t expected =
      static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  if (unit_plane.size() != expected) {
    return Error{"camera look-up table has " + std::to_string(unit_plane.size()) +
                 " entries, an image of " + std::to_string(width_px) + " x " +
                 std::to_string(height_px) + " px needs " + std::to_string(expected)};
  }
  if (Status entries = check_entries(width_px, unit_plane); !entries) {
    return entries.error();
  }
  if (Status folds = check_folds(width_px, height_px, unit_plane); !folds) {
    return folds.error();
  }
  StartGrid grid = start_grid(width_px, height_px, unit_plane);
  CameraModel model;
  model.width_px_ = width_px;
  model.height_px_ = height_px;
  model.lookup_ = std::move(unit_plane);
  model.grid_columns_ = grid.columns;
  model.grid_rows_ = grid.rows;
  model.grid_origin_ = grid.origin;
  model.grid_step_ = grid.step;
  model.grid_start_px_ = std::move(grid.start_px);
  return model;
}

Result<CameraModel> CameraModel::from_brown_conrady(const BrownConrady& p) {
  if (Status size = check_size(p.width_px, p.height_px); !size) {
    return size.error();
  }
  if (Status parameters = checked_parameters(p); !parameters) {
    return parameters.error();
  }
  std::vector<Vec2> table;
  table.reserve(static_cast<std::size_t>(p.width_px) * static_cast<std::size_t>(p.height_px));
  for (int row = 0; row < p.height_px; ++row) {
    for (int column = 0; column < p.width_px; ++column) {
      table.push_back(undistorted(p, {column + 0.5, row + 0.5}));
    }
  }
  return from_lookup(p.width_px, p.height_px, std::move(table));
}

std::optional<Vec2> CameraModel::unproject(Vec2 pixel_px) const {
  if (!(pixel_px.x >= 0.0 && pixel_px.y >= 0.0 && pixel_px.x <= width_px_ &&
        pixel_px.y <= height_px_) ||
      lookup_.empty()) {
    return std::nullopt;
  }
  const Place at = place_of(pixel_px, width_px_, height_px_);
  const LookupCell cell = cell_at(lookup_, width_px_, at.column, at.row);
  if (cell.valid()) {
    return cell.value(at.s, at.t);
  }
  // A pixel's own centre needs no neighbours; at the rim of the valid part it may have none.
  const Vec2 own = at.s == 0.0 && at.t == 0.0 ? cell.a : kNoDirection;
  return is_nan(own) ? std::nullopt : std::optional<Vec2>(own);
}

std::optional<Vec2> CameraModel::project(Vec2 u) const {
  if (lookup_.empty() || !std::isfinite(u.x) || !std::isfinite(u.y)) {
    return std::nullopt;
  }
  const double column = std::floor((u.x - grid_origin_.x) / grid_step_.x);
  const double row = std::floor((u.y - grid_origin_.y) / grid_step_.y);
  if (column < -1.0 || row < -1.0 || column > grid_columns_ || row > grid_rows_) {
    return std::nullopt;
  }
  const int x = std::clamp(static_cast<int>(column), 0, grid_columns_ - 1);
  const int y = std::clamp(static_cast<int>(row), 0, grid_rows_ - 1);
  Vec2 pixel = grid_start_px_[static_cast<std::size_t>(y * grid_columns_ + x)];
  Vec2 last_valid = pixel;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Place at = place_of(pixel, width_px_, height_px_);
    const LookupCell cell = cell_at(lookup_, width_px_, at.column, at.row);
    if (!cell.valid()) {  // a step too far, past the rim of the valid part
      pixel = 0.5 * (pixel + last_valid);
      continue;
    }
    last_valid = pixel;
    const auto step = newton_step(cell, at, u - cell.value(at.s, at.t));
    if (!step) {
      return std::nullopt;
    }
    pixel = pixel + *step;
    const double length_px = std::abs(step->x) + std::abs(step->y);
    if (!(length_px < 1e6)) {
      return std::nullopt;
    }
    if (length_px <= kNewtonStepPx) {
      return on_image(pixel, width_px_, height_px_);
    }
  }
  return std::nullopt;
}

std::optional<Vec2> CameraModel::project(Vec3 in_camera_m) const {
  if (!(in_camera_m.z > 0.0)) {
    return std::nullopt;
  }
  return project(Vec2{in_camera_m.x / in_camera_m.z, in_camera_m.y / in_camera_m.z});
}

std::optional<std::array<double, 4>> CameraModel::jacobian_px(Vec2 pixel_px) const {
  if (!unproject(pixel_px)) {
    return std::nullopt;
  }
  const Place at = place_of(pixel_px, width_px_, height_px_);
  const LookupCell cell = cell_at(lookup_, width_px_, at.column, at.row);
  if (!cell.valid()) {
    return std::nullopt;
  }
  const Vec2 by_x = cell.along_x(at.t);
  const Vec2 by_y = cell.along_y(at.s);
  const double determinant = by_x.cross(by_y);
  if (determinant == 0.0) {
    return std::nullopt;
  }
  return std::array<double, 4>{by_y.y / determinant, -by_y.x / determinant, -by_x.y / determinant,
                               by_x.x / determinant};
}

}  // namespace orthonav
