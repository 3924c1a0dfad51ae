#include "nav/tracking/tag_search.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr int kLargestRadiusPx = 40;
/// Wide searches look at every second pixel first.
constexpr int kFineRadiusPx = 6;
constexpr double kFewestCells = 8.0;

/// Correlation of single pixels' grey with a template of zeros and ones.
struct Correlation {
  double n = 0.0;
  double grey = 0.0;
  double grey2 = 0.0;
  double white = 0.0;
  double both = 0.0;

  void add(const GreyImage& image, int x, int y, float template_white) {
    if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px) {
      return;
    }
    const double g = image.at(x, y);
    const auto w = static_cast<double>(template_white);
    n += 1.0;
    grey += g;
    grey2 += g * g;
    white += w;
    both += w * g;
  }
  [[nodiscard]] double value() const {
    // The template's squares equal its values.
    const double spread = (n * grey2 - grey * grey) * (n * white - white * white);
    return n < kFewestCells || !(spread > 0.0) ? 0.0
                                               : (n * both - grey * white) / std::sqrt(spread);
  }
};

}  // namespace

CellMatch TagSearch::at(const GreyImage& image, int dx, int dy) const {
  Correlation all;
  for (const Cell& cell : cells_) {
    all.add(image, cell.x_px + dx, cell.y_px + dy, cell.white);
  }
  CellMatch match;
  match.offset_px = {static_cast<double>(dx), static_cast<double>(dy)};
  match.fraction = all.n / static_cast<double>(all_cells_);
  match.correlation = all.value();
  return match;
}

double TagSearch::code_at(const GreyImage& image, Vec2 offset_px) const {
  Correlation code;
  for (const Cell& cell : cells_) {
    if (cell.code) {
      code.add(image, cell.x_px + static_cast<int>(offset_px.x),
               cell.y_px + static_cast<int>(offset_px.y), cell.white);
    }
  }
  return code.value();
}

CellMatch TagSearch::match(const GreyImage& image, const CameraModel& camera, const BlurredTag& tag,
                           const CameraFromTag& pose) {
  const int n = tag.cells().cells;
  cells_.clear();
  all_cells_ = static_cast<std::size_t>(n * n);
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const Vec3 in_tag{(column + 0.5 - 0.5 * n) * tag.cell_m(),
                        (0.5 * n - row - 0.5) * tag.cell_m(), 0.0};
      const auto pixel = camera.project(pose.rotation * in_tag + pose.translation_m);
      if (!pixel) {
        continue;
      }
      cells_.push_back({static_cast<int>(std::floor(pixel->x)),
                        static_cast<int>(std::floor(pixel->y)), tag.cells().at(row, column),
                        tag.cells().code[static_cast<std::size_t>(row * n + column)]});
    }
  }
  CellMatch here = at(image, 0, 0);
  here.code = code_at(image, {});
  return here;
}

CellMatch TagSearch::best_offset(const GreyImage& image, int radius_px) const {
  const int radius = std::clamp(radius_px, 1, kLargestRadiusPx);
  const int step = radius > kFineRadiusPx ? 2 : 1;
  CellMatch best = at(image, 0, 0);
  const auto look = [&](int x, int y) {
    const CellMatch here = at(image, x, y);
    if (here.correlation > best.correlation) {
      best = here;
    }
  };
  for (int y = -radius; y <= radius; y += step) {
    for (int x = -radius; x <= radius; x += step) {
      look(x, y);
    }
  }
  const int x0 = static_cast<int>(best.offset_px.x);
  const int y0 = static_cast<int>(best.offset_px.y);
  for (int y = y0 - 1; step > 1 && y <= y0 + 1; ++y) {
    for (int x = x0 - 1; x <= x0 + 1; ++x) {
      look(x, y);
    }
  }
  best.code = code_at(image, best.offset_px);
  return best;
}

}  // namespace orthonav::nav
