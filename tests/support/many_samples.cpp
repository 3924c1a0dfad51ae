#include "tests/support/many_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/srgb.h"

namespace orthonav::render {
namespace {

constexpr double kEdgeLevels = 2;

float linear_of_level(std::uint8_t level) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
      linear[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255.0));
    }
    return linear;
  }();
  return kLinear[level];
}

/// The view displaced by these pixels to the right and down.
View displaced(View view, double right_px, double down_px, const LinearImage& image) {
  const auto across =
      static_cast<float>(right_px * (view.tan_left + view.tan_right) / image.width_px);
  const auto down = static_cast<float>(down_px * (view.tan_up + view.tan_down) / image.height_px);
  view.tan_left -= across;
  view.tan_right += across;
  view.tan_up -= down;
  view.tan_down += down;
  return view;
}

}  // namespace

Result<std::vector<LinearImage>> many_samples(Renderer& hard, const Scene& scene,
                                              const std::vector<View>& views, int grid) {
  std::vector<RgbaImage> frame;
  if (const Status drawn = hard.draw(scene, views, {}, frame); !drawn) {
    return drawn.error();
  }
  std::vector<LinearImage> sum;
  for (const RgbaImage& image : frame) {
    sum.push_back({image.width_px, image.height_px, {}});
    sum.back().light.resize(3 * image.pixels.size() / 4);
  }
  const float part = 1.0f / static_cast<float>(grid * grid);
  for (int sample = 0; sample < grid * grid; ++sample) {
    std::vector<View> aside = views;
    for (View& view : aside) {
      view = displaced(view, (sample % grid + 0.5) / grid - 0.5, (sample / grid + 0.5) / grid - 0.5,
                       sum.front());
    }
    if (const Status drawn = hard.draw(scene, aside, {}, frame); !drawn) {
      return drawn.error();
    }
    for (std::size_t view = 0; view < sum.size(); ++view) {
      for (std::size_t i = 0; i < sum[view].light.size(); ++i) {
        sum[view].light[i] += part * linear_of_level(frame[view].pixels[4 * (i / 3) + i % 3]);
      }
    }
  }
  return sum;
}

double EdgeError::rms() const {
  return channels == 0 ? 0 : std::sqrt(sum_squares / static_cast<double>(channels));
}

void add_error(const LinearImage& reference, const RgbaImage& hard, const RgbaImage& picture,
               EdgeError& error) {
  for (std::size_t i = 0; i < reference.light.size(); ++i) {
    const std::size_t at = 4 * (i / 3) + i % 3;
    const double expected = 255 * std::clamp(srgb_from_linear(reference.light[i]), 0.0, 1.0);
    if (std::abs(expected - hard.pixels[at]) <= kEdgeLevels) {
      continue;
    }
    const double off = picture.pixels[at] - expected;
    error.sum_squares += off * off;
    error.worst = std::max(error.worst, std::abs(off));
    ++error.channels;
  }
}

}  // namespace orthonav::render
