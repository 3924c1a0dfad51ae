#pragma once

#include <string>
#include <vector>

#include "base/vec.h"

namespace orthonav::engine {

// A page to print as plain values: millimetres from the page's top left corner, x right, y down.

struct SheetRect {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double width_mm = 0.0;
  double height_mm = 0.0;
};

/// Rectangles filled black together, so that no seam is visible where they touch.
struct SheetShape {
  std::vector<SheetRect> rects;
};

/// A cutting line: thin, dashed, light enough not to be taken for a tag's edge.
struct SheetCut {
  std::vector<Vec2> corners_mm;  ///< of a closed outline
};

struct SheetLine {
  double from_x_mm = 0.0;
  double from_y_mm = 0.0;
  double to_x_mm = 0.0;
  double to_y_mm = 0.0;
  double width_mm = 0.2;
  bool white = false;
};

enum class SheetAlign { kLeft, kCentre, kRight };

struct SheetText {
  double x_mm = 0.0;  ///< of the point that `align` names, on the baseline
  double y_mm = 0.0;
  double height_mm = 3.0;  ///< of the font
  std::string text;
  SheetAlign align = SheetAlign::kLeft;
  bool upward = false;  ///< read upwards
  bool white = false;
};

struct Sheet {
  double width_mm = 0.0;
  double height_mm = 0.0;
  std::vector<SheetShape> shapes;
  std::vector<SheetCut> cuts;
  std::vector<SheetLine> lines;
  std::vector<SheetText> texts;
};

}  // namespace orthonav::engine
