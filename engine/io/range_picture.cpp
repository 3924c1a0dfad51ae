#include "engine/io/range_picture.h"

#include <algorithm>
#include <vector>

namespace orthonav::engine {

namespace {

constexpr double kDarkest = 40.0;
constexpr double kWhite = 255.0;

/// The value below which this fraction of the numbers lies.
std::uint16_t quantile(std::vector<std::uint16_t>& numbers, double fraction) {
  const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(numbers.size() - 1));
  std::nth_element(numbers.begin(), numbers.begin() + at, numbers.end());
  return numbers[static_cast<std::size_t>(at)];
}

}  // namespace

RangePicture picture_of_ranges(const DepthImage& range_mm) {
  // A few stray pixels must not reduce the contrast of all the others.
  constexpr double kStray = 0.005;
  RangePicture picture;
  std::vector<std::uint16_t> measured;
  std::copy_if(range_mm.pixels.begin(), range_mm.pixels.end(), std::back_inserter(measured),
               [](std::uint16_t value) { return value != 0; });
  if (!measured.empty()) {
    picture.white_mm = quantile(measured, kStray);
    picture.dark_mm = quantile(measured, 1.0 - kStray);
  }
  const double span_mm = std::max(1, picture.dark_mm - picture.white_mm);
  picture.image.width_px = range_mm.width_px;
  picture.image.height_px = range_mm.height_px;
  picture.image.pixels.reserve(4 * range_mm.pixels.size());
  for (const std::uint16_t value_mm : range_mm.pixels) {
    const double far = std::clamp((value_mm - picture.white_mm) / span_mm, 0.0, 1.0);
    const double grey = value_mm == 0 ? 0.0 : kWhite + far * (kDarkest - kWhite);
    for (int channel = 0; channel < 3; ++channel) {
      picture.image.pixels.push_back(static_cast<std::uint8_t>(grey + 0.5));
    }
    picture.image.pixels.push_back(255);
  }
  return picture;
}

}  // namespace orthonav::engine
