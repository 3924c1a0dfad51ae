#include "nav/tracking/tag_search.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr int kLargestRadiusPx = 40;
/// Wide searches look at every second pixel first.
constexpr int kFineRadiusPx = 6;

}  // namespace

CellMatch TagSearch::at(const GreyImage& image, int dx, int dy) const {
  double n = 0.0;
  double grey = 0.0;
  double grey2 = 0.0;
  double white = 0.0;
  double both = 0.0;
  for (const Cell& cell : cells_) {
    const int x = cell.x_px + dx;
    const int y = cell.y_px + dy;
    if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px) continue;
    const double g = image.at(x, y);
    n += 1.0;
    grey += g;
    grey2 += g * g;
    white += static_cast<double>(cell.white);
    both += static_cast<double>(cell.white) * g;
  }
  CellMatch match;
  match.shift_px = {static_cast<double>(dx), static_cast<double>(dy)};
  if (n < 8.0) return match;
  match.share = n / static_cast<double>(all_cells_);
  // The template is 0 or 1: its squares are itself.
  const double spread = (n * grey2 - grey * grey) * (n * white - white * white);
  match.correlation = spread > 0.0 ? (n * both - grey * white) / std::sqrt(spread) : 0.0;
  return match;
}

CellMatch TagSearch::match(const GreyImage& image, const CameraModel& camera, const BlurredTag& tag,
                           const CameraFromTag& pose) {
  const int n = tag.cells().cells;
  cells_.clear();
  all_cells_ = static_cast<std::size_t>(n * n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const Vec3 in_tag{(column + 0.5 - 0.5 * n) * tag.cell_m(),
                        (0.5 * n - row - 0.5) * tag.cell_m(), 0.0};
      const auto pixel = camera.project(pose.rotation * in_tag + pose.translation_m);
      if (!pixel) continue;
      cells_.push_back({static_cast<int>(std::floor(pixel->x)),
                        static_cast<int>(std::floor(pixel->y)), tag.cells().at(row, column)});
    }
  return at(image, 0, 0);
}

CellMatch TagSearch::best_shift(const GreyImage& image, int radius_px) const {
  const int radius = std::clamp(radius_px, 1, kLargestRadiusPx);
  const int step = radius > kFineRadiusPx ? 2 : 1;
  CellMatch best = at(image, 0, 0);
  const auto look = [&](int x, int y) {
    const CellMatch here = at(image, x, y);
    if (here.correlation > best.correlation) best = here;
  };
  for (int y = -radius; y <= radius; y += step)
    for (int x = -radius; x <= radius; x += step) look(x, y);
  const int x0 = static_cast<int>(best.shift_px.x);
  const int y0 = static_cast<int>(best.shift_px.y);
  for (int y = y0 - 1; step > 1 && y <= y0 + 1; ++y)
    for (int x = x0 - 1; x <= x0 + 1; ++x) look(x, y);
  return best;
}

}  // namespace orthonav::nav
