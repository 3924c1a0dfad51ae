#include "render/font_maker/distance_field.h"

#include <cmath>
#include <limits>

namespace orthonav::font_maker {
namespace {

constexpr float kFar = 1e12f;

/// Lower envelope of the parabolas f[q] + (p - q)^2 along one line, in place, with a stride.
void transform_line(float* cells, int count, int stride) {
  std::vector<float> f(count);
  std::vector<int> apex(count);
  std::vector<float> bound(count + 1);
  for (int i = 0; i < count; ++i) {
    f[i] = cells[i * stride];
  }
  const auto crossing = [&](int q, int p) {
    const auto fq = f[q] + static_cast<float>(q) * static_cast<float>(q);
    const auto fp = f[p] + static_cast<float>(p) * static_cast<float>(p);
    return (fq - fp) / static_cast<float>(2 * (q - p));
  };
  int last = 0;
  apex[0] = 0;
  bound[0] = -std::numeric_limits<float>::infinity();
  bound[1] = std::numeric_limits<float>::infinity();
  for (int q = 1; q < count; ++q) {
    float at = crossing(q, apex[last]);
    while (at <= bound[last]) {
      at = crossing(q, apex[--last]);
    }
    apex[++last] = q;
    bound[last] = at;
    bound[last + 1] = std::numeric_limits<float>::infinity();
  }
  int k = 0;
  for (int q = 0; q < count; ++q) {
    while (bound[k + 1] < static_cast<float>(q)) {
      ++k;
    }
    const auto off = static_cast<float>(q - apex[k]);
    cells[q * stride] = off * off + f[apex[k]];
  }
}

/// Distance from every cell to the nearest cell whose value in the mask is `target`.
std::vector<float> distance_to(const Mask& mask, std::uint8_t target) {
  std::vector<float> cells(mask.inside.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = (mask.inside[i] != 0) == (target != 0) ? 0.0f : kFar;
  }
  for (int x = 0; x < mask.width; ++x) {
    transform_line(&cells[x], mask.height, mask.width);
  }
  for (int y = 0; y < mask.height; ++y) {
    transform_line(&cells[y * mask.width], mask.width, 1);
  }
  for (float& cell : cells) {
    cell = std::sqrt(cell);
  }
  return cells;
}

}  // namespace

std::vector<float> signed_distance(const Mask& mask) {
  std::vector<float> to_outside = distance_to(mask, 0);
  const std::vector<float> to_inside = distance_to(mask, 1);
  for (std::size_t i = 0; i < to_outside.size(); ++i) {
    // The outline lies half a cell from the nearest centres on either side.
    to_outside[i] = mask.inside[i] ? to_outside[i] - 0.5f : 0.5f - to_inside[i];
  }
  return to_outside;
}

}  // namespace orthonav::font_maker
