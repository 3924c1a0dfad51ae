#include "render/compare.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace orthonav::render {
namespace {

/// Whether the sizes agree and both images hold as many pixels as their sizes say.
bool comparable(const RgbaImage& a, const RgbaImage& b) {
  const auto bytes = 4 * static_cast<std::size_t>(std::max(a.width_px, 0)) * a.height_px;
  return a.width_px == b.width_px && a.height_px == b.height_px && a.pixels.size() == bytes &&
         b.pixels.size() == bytes;
}

int channel_difference(const RgbaImage& a, const RgbaImage& b, std::size_t i) {
  return std::abs(int{a.pixels[i]} - int{b.pixels[i]});
}

std::string at(int x_px, int y_px) {
  return "(" + std::to_string(x_px) + ", " + std::to_string(y_px) + ")";
}

}  // namespace

ColourDifference compare_colour(const RgbaImage& expected, const RgbaImage& actual) {
  ColourDifference difference;
  difference.same_size = comparable(expected, actual);
  if (!difference.same_size) {
    return difference;
  }
  const auto width = static_cast<std::size_t>(expected.width_px);
  for (std::size_t pixel = 0; 4 * pixel < expected.pixels.size(); ++pixel) {
    if (std::memcmp(&expected.pixels[4 * pixel], &actual.pixels[4 * pixel], 4) == 0) {
      continue;
    }
    int worst = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      worst = std::max(worst, channel_difference(expected, actual, 4 * pixel + c));
    }
    if (worst > kColourTolerance) {
      ++difference.outside;
    }
    if (worst <= difference.worst) {
      continue;
    }
    difference.worst = worst;
    difference.worst_x_px = static_cast<int>(pixel % width);
    difference.worst_y_px = static_cast<int>(pixel / width);
  }
  return difference;
}

std::string ColourDifference::text() const {
  if (!same_size) {
    return "sizes differ";
  }
  if (alike()) {
    return "alike";
  }
  return std::to_string(outside) + " pixels differ, the worst by " + std::to_string(worst) +
         " at " + at(worst_x_px, worst_y_px);
}

LabelDifference compare_labels(const LabelImage& expected, const LabelImage& actual) {
  LabelDifference difference;
  const auto pixels = static_cast<std::size_t>(std::max(expected.width_px, 0)) * expected.height_px;
  difference.same_size = expected.width_px == actual.width_px &&
                         expected.height_px == actual.height_px &&
                         expected.labels.size() == pixels && actual.labels.size() == pixels;
  if (!difference.same_size) {
    return difference;
  }
  for (std::size_t i = 0; i < expected.labels.size(); ++i) {
    if (expected.labels[i] == actual.labels[i]) {
      continue;
    }
    if (difference.outside++ > 0) {
      continue;
    }
    difference.first_x_px = static_cast<int>(i % static_cast<std::size_t>(expected.width_px));
    difference.first_y_px = static_cast<int>(i / static_cast<std::size_t>(expected.width_px));
    difference.expected = expected.labels[i];
    difference.actual = actual.labels[i];
  }
  return difference;
}

std::string LabelDifference::text() const {
  if (!same_size) {
    return "sizes differ";
  }
  if (alike()) {
    return "alike";
  }
  return std::to_string(outside) + " pixels differ, the first at " + at(first_x_px, first_y_px) +
         ": label " + std::to_string(expected) + " became " + std::to_string(actual);
}

RgbaImage difference_image(const RgbaImage& expected, const RgbaImage& actual) {
  constexpr int kGain = 16;
  RgbaImage image;
  if (!comparable(expected, actual)) {
    return image;
  }
  image.width_px = expected.width_px;
  image.height_px = expected.height_px;
  image.pixels.resize(expected.pixels.size(), 255);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 == 3) {
      continue;
    }
    const int scaled = kGain * channel_difference(expected, actual, i);
    image.pixels[i] = static_cast<std::uint8_t>(std::min(scaled, 255));
  }
  return image;
}

std::optional<LabelExtent> extent_of(const LabelImage& image, Label label) {
  LabelExtent extent;
  extent.left_px = image.width_px;
  extent.top_px = image.height_px;
  for (std::size_t i = 0; i < image.labels.size(); ++i) {
    if (image.labels[i] != label) {
      continue;
    }
    const auto x = static_cast<int>(i % static_cast<std::size_t>(image.width_px));
    const auto y = static_cast<int>(i / static_cast<std::size_t>(image.width_px));
    extent.centre_x_px += x + 0.5;
    extent.centre_y_px += y + 0.5;
    extent.left_px = std::min(extent.left_px, x);
    extent.right_px = std::max(extent.right_px, x + 1);
    extent.top_px = std::min(extent.top_px, y);
    extent.bottom_px = std::max(extent.bottom_px, y + 1);
    ++extent.pixels;
  }
  if (extent.pixels == 0) {
    return std::nullopt;
  }
  extent.centre_x_px /= static_cast<double>(extent.pixels);
  extent.centre_y_px /= static_cast<double>(extent.pixels);
  return extent;
}

}  // namespace orthonav::render
