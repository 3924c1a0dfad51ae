#pragma once

#include <array>
#include <map>
#include <string>

#include "base/image.h"
#include "engine/print/page.h"
#include "engine/print/sheet_drawing.h"
#include "engine/print/tag_sheets.h"

// What is printed is drawn as an image by the same code and measured there.
namespace orthonav::engine::print_test {

inline constexpr double kPxPerMm = 10.0;
// A tag is usable if its place and size are as its text says; the detector itself is exact to some
// hundredths of these pixels.
inline constexpr double kPlaceToleranceMm = 0.1;

inline Page a4() { return *page_named("A4", false); }

PrintedTag tag(const std::string& family, int id, double size_m, const std::string& tool = "");
GreyImage drawn(const Sheet& sheet, double px_per_mm = kPxPerMm);

using Corners = std::array<Vec2, 4>;

/// Corners in millimetres on the page, by id.
std::map<int, Corners> detected(const GreyImage& image, const std::string& family);

/// The same for tags with wide borders, of which the library has no family: the bits lie one cell
/// farther in.
std::map<int, Corners> detected_with_wide_borders(const GreyImage& image);

/// Bottom left, bottom right, top right, top left of an upright square on the page.
Corners square(double left_mm, double top_mm, double size_mm);
double farthest_mm(const Corners& a, const Corners& b);

}  // namespace orthonav::engine::print_test
