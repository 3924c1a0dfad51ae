#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/srgb.h"
#include "tests/hal/openxr/runtime_test.h"
#include "tests/hal/openxr/software_renderer.h"
#include "tests/support/is_ok.h"

namespace orthonav::test {

/// Compares the frames that the compositor got with those that the image renderer draws for the
/// same scene and views, so that no reference pictures are needed.
class FrameComparison {
 public:
  FrameComparison(int width_px, int height_px, render::Blend blend,
                  render::Edges edges = render::Edges::kCoverage)
      : renderer_(software_renderer(width_px, height_px, blend, edges)) {}

  /// The largest difference of any colour value in both eyes, in levels of 255; and how many pixels
  /// are lit in the eyes' images and on the panel.
  struct Difference {
    int most = 0;
    std::size_t beyond = 0;  ///< colour values that differ by more than the tolerance
    std::size_t lit_px = 0;
    std::size_t lit_on_panel_px = 0;
  };
  /// What hangs on the head must be in the eyes' images if the frame has no panel, and only then.
  Difference compare(const DrawnScene& drawn, const SubmittedFrame& frame, int tolerance = 0) {
    render::Scene scene = drawn.scene;
    if (frame.quad) {
      scene.texts.erase_if(
          [](const render::TextItem& text) { return text.place == render::TextPlace::kView; });
    }
    std::vector<RgbaImage> images;
    EXPECT_TRUE(is_ok(renderer_->draw(scene, drawn.views, {}, images)));
    Difference difference;
    for (std::size_t i = 0; frame.quad && i < frame.quad->pixels->size(); i += 4) {
      difference.lit_on_panel_px += (*frame.quad->pixels)[i] != 0 ? 1 : 0;
    }
    for (std::size_t eye = 0; eye < 2; ++eye) {
      add(images[eye].pixels, frame.pixels[eye], frame.format, tolerance, difference);
    }
    return difference;
  }

 private:
  static bool is_swapped(std::int64_t format) {
    return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
  }
  static bool is_linear(std::int64_t format) {
    return format == VK_FORMAT_R8G8B8A8_UNORM || format == VK_FORMAT_B8G8R8A8_UNORM;
  }
  static void add(const std::vector<std::uint8_t>& expected, const std::vector<std::uint8_t>& got,
                  std::int64_t format, int tolerance, Difference& difference) {
    ASSERT_EQ(expected.size(), got.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (i % 4 == 3) {
        continue;
      }
      const std::size_t from = is_swapped(format) ? i - i % 4 + (2 - i % 4) : i;
      int wanted = expected[i];
      if (is_linear(format)) {
        wanted = static_cast<int>(std::lround(255.0 * linear_from_srgb(wanted / 255.0)));
      }
      const int off = std::abs(wanted - got[from]);
      difference.most = std::max(difference.most, off);
      difference.beyond += off > tolerance ? 1 : 0;
      if (i % 4 == 0 && (got[i] | got[i + 1] | got[i + 2]) != 0) {
        ++difference.lit_px;
      }
    }
  }

  std::unique_ptr<render::Renderer> renderer_;
};

/// The frames that had pixels, and what was drawn into them, the newest first.
inline std::vector<std::pair<DrawnScene, SubmittedFrame>> matched(
    const std::vector<DrawnScene>& drawn, const std::vector<SubmittedFrame>& frames) {
  std::vector<std::pair<DrawnScene, SubmittedFrame>> pairs;
  auto scene = drawn.rbegin();
  for (auto frame = frames.rbegin(); frame != frames.rend() && scene != drawn.rend(); ++frame) {
    if (frame->has_eyes) {
      pairs.emplace_back(*scene++, *frame);
    }
  }
  return pairs;
}

}  // namespace orthonav::test
