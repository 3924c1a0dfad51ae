#include "nav/tracking/detector_check.h"

#include <algorithm>
#include <cmath>

#include "nav/tracking/tool.h"

namespace orthonav::nav {
namespace {

// The library asserts on more.
constexpr int kLargestPx = 32767;

}  // namespace

Status check(const DetectorOptions& options) {
  if (options.families.empty()) {
    return Error{"marker detector: no tag family given"};
  }
  for (std::size_t i = 0; i < options.families.size(); ++i) {
    const std::string& name = options.families[i];
    if (!is_known_family(name)) {
      return Error{"unknown tag family '" + name + "', known are " + known_families_text()};
    }
    if (std::find(options.families.begin(), options.families.begin() + static_cast<long>(i),
                  name) != options.families.begin() + static_cast<long>(i)) {
      return Error{"tag family '" + name + "' is given twice"};
    }
  }
  const double d = options.decimate;
  if (d != 1.0 && d != 1.5 && d != 2.0 && d != 3.0 && d != 4.0) {
    return Error{"marker detector: decimate " + std::to_string(d) + ", must be 1, 1.5, 2, 3 or 4"};
  }
  if (options.max_hamming < 0 || options.max_hamming > 2) {
    return Error{"marker detector: max_hamming " + std::to_string(options.max_hamming) +
                 ", must be 0, 1 or 2"};
  }
  if (!std::isfinite(options.min_decision_margin)) {
    return Error{"marker detector: min_decision_margin is not finite"};
  }
  if (options.threads < 1 || options.threads > 64) {
    return Error{"marker detector: " + std::to_string(options.threads) + " threads, must be 1-64"};
  }
  return {};
}

Status check(const GreyImage& image) {
  if (image.width_px <= 0 || image.height_px <= 0) {
    return Error{"image is empty (" + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px)"};
  }
  if (image.width_px > kLargestPx || image.height_px > kLargestPx) {
    return Error{"image is " + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px, limit " + std::to_string(kLargestPx)};
  }
  const auto expected =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.pixels.size() != expected) {
    return Error{"image of " + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px holds " +
                 std::to_string(image.pixels.size()) + " bytes, " + std::to_string(expected) +
                 " expected"};
  }
  return {};
}

}  // namespace orthonav::nav
