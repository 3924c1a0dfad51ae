#pragma once

#include <vector>

#include "base/vec.h"

namespace orthonav::sim {

/// Exact area sampling: how much of each pixel's square lies inside closed contours. Every segment
/// adds its signed area to the pixel it crosses and to the one right of it; a running sum along the
/// row then gives the covered area, exact up to rounding (the method of font rasterizers, see
/// Levien, "font-rs"). Contours may be given in any number of pieces and in any order.
///
/// Works on a window of a float buffer that must be zero; it remembers which part of each row it
/// touched.
class CoverageWindow {
 public:
  struct Span {
    int low = 0;
    int high = 0;  ///< one past; low == high: untouched
  };
  /// `cells` holds (width_px + 2) * height_px zeros, `spans` height_px empty spans.
  CoverageWindow(float* cells, Span* spans, int width_px, int height_px)
      : cells_(cells), spans_(spans), width_(width_px), height_(height_px) {}

  [[nodiscard]] static int stride(int width_px) { return width_px + 2; }
  /// A directed segment in pixels of the window; `weight` scales the area, and its sign the
  /// direction.
  void add_segment(Vec2 from, Vec2 to, double weight);

 private:
  void add_inside(Vec2 from, Vec2 to, double weight);
  void add_row(int row, double x0, double x1, double height);
  void touch(int row, int low, int high);

  float* cells_;
  Span* spans_;
  int width_;
  int height_;
};

}  // namespace orthonav::sim
