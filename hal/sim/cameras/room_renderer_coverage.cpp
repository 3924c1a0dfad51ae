#include "hal/sim/cameras/room_renderer_coverage.h"

#include <algorithm>
#include <cmath>

namespace orthonav::sim {
namespace {

constexpr double kFarPx = 1e8;

}  // namespace

void CoverageWindow::touch(int row, int low, int high) {
  Span& span = spans_[row];
  if (span.low == span.high) {
    span = {low, high};
    return;
  }
  span.low = std::min(span.low, low);
  span.high = std::max(span.high, high);
}

void CoverageWindow::add_segment(Vec2 from, Vec2 to, double weight) {
  // NaN, or a segment too far off to be clipped exactly, covers nothing.
  if (!(std::abs(from.x) + std::abs(from.y) + std::abs(to.x) + std::abs(to.y) < kFarPx)) {
    return;
  }
  if (from.y == to.y) {
    return;
  }
  if (from.y > to.y) {
    return add_segment(to, from, -weight);
  }
  if (to.y <= 0.0 || from.y >= height_) {
    return;
  }
  const double slope = (to.x - from.x) / (to.y - from.y);
  if (from.y < 0.0) {
    from = {from.x - from.y * slope, 0.0};
  }
  if (to.y > height_) {
    to = {to.x - (to.y - height_) * slope, static_cast<double>(height_)};
  }
  // Left of the window a segment acts as if on its left edge; right of it, it covers nothing.
  double y = from.y;
  for (const double edge : {slope >= 0.0 ? 0.0 : static_cast<double>(width_),
                            slope >= 0.0 ? static_cast<double>(width_) : 0.0}) {
    if (slope == 0.0) {
      break;
    }
    const double crossing = from.y + (edge - from.x) / slope;
    if (!(crossing > y) || crossing >= to.y) {
      continue;
    }
    add_inside({from.x + (y - from.y) * slope, y}, {edge, crossing}, weight);
    y = crossing;
  }
  add_inside({from.x + (y - from.y) * slope, y}, to, weight);
}

void CoverageWindow::add_inside(Vec2 from, Vec2 to, double weight) {
  if (std::min(from.x, to.x) >= width_) {
    // Covers nothing, but the row is open up to the edge.
    const int last_row = std::min(static_cast<int>(std::ceil(to.y)), height_);
    for (int row = static_cast<int>(from.y); row < last_row; ++row) {
      touch(row, width_, width_ + 1);
    }
    return;
  }
  from.x = std::clamp(from.x, 0.0, static_cast<double>(width_));
  to.x = std::clamp(to.x, 0.0, static_cast<double>(width_));
  if (!(to.y > from.y)) {
    return;
  }
  const double slope = (to.x - from.x) / (to.y - from.y);
  const int last = std::min(static_cast<int>(std::ceil(to.y)), height_);
  for (int row = static_cast<int>(from.y); row < last; ++row) {
    const double top = std::max(static_cast<double>(row), from.y);
    const double bottom = std::min(row + 1.0, to.y);
    if (!(bottom > top)) {
      continue;
    }
    add_row(row, from.x + (top - from.y) * slope, from.x + (bottom - from.y) * slope,
            (bottom - top) * weight);
  }
}

void CoverageWindow::add_row(int row, double x0, double x1, double height) {
  if (x0 > x1) {
    std::swap(x0, x1);
  }
  const double limit = width_;
  x0 = std::clamp(x0, 0.0, limit);
  x1 = std::clamp(x1, 0.0, limit);
  float* cells = cells_ + static_cast<std::ptrdiff_t>(row) * stride(width_);
  const int first = static_cast<int>(x0);
  const int end = std::max(static_cast<int>(std::ceil(x1)), first + 1);
  touch(row, first, end + 1);
  if (end == first + 1) {
    const double right = height * (0.5 * (x0 + x1) - first);
    cells[first] += static_cast<float>(height - right);
    cells[first + 1] += static_cast<float>(right);
    return;
  }
  // The area left of the segment in each pixel it crosses, as differences from pixel to pixel.
  const double per_px = height / (x1 - x0);
  double covered_before = 0.0;
  for (int x = first; x < end; ++x) {
    const double a = std::max(x0, static_cast<double>(x));
    const double b = std::min(x1, x + 1.0);
    // Inside this pixel the segment passes (b - a) wide: full right of it, half under it.
    const double passed = per_px * (a - x0);
    const double covered = passed * 1.0 + per_px * (b - a) * (x + 1.0 - 0.5 * (a + b));
    cells[x] += static_cast<float>(covered - covered_before);
    covered_before = covered;
  }
  cells[end] += static_cast<float>(height - covered_before);
}

}  // namespace orthonav::sim
