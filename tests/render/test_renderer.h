#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/compare.h"
#include "render/projection.h"
#include "render/renderer.h"
#include "tests/render/silent_validation.h"
#include "tests/support/is_ok.h"
#include "tests/support/test_device.h"

namespace orthonav::render {

/// A renderer on the software rasterizer with the validation layer listening until it is gone.
class TestRenderer {
 public:
  explicit TestRenderer(int width_px = 200, int height_px = 120, Blend blend = Blend::kAdditive,
                        Edges edges = Edges::kCoverage, EyesAPass eyes_a_pass = EyesAPass::kProbe) {
    RendererOptions options;
    options.width_px = width_px;
    options.height_px = height_px;
    options.blend = blend;
    options.edges = edges;
    options.device = test::test_device();
    options.validation = true;
    options.messages = validation_.sink();
    options.eyes_a_pass = eyes_a_pass;
    options.cache_folder = "";
    auto renderer = Renderer::create(options);
    if (!renderer) {  // fails the test, not the program
      throw std::runtime_error(renderer.error().message);
    }
    renderer_ = std::move(*renderer);
  }
  TestRenderer(const TestRenderer&) = delete;
  TestRenderer& operator=(const TestRenderer&) = delete;

  Renderer& operator*() { return *renderer_; }
  Renderer* operator->() { return renderer_.get(); }

  RgbaImage draw(const Scene& scene, const View& view, const RgbaImage* background = nullptr) {
    std::vector<const RgbaImage*> backgrounds;
    if (background != nullptr) {
      backgrounds.push_back(background);
    }
    std::vector<RgbaImage> images;
    EXPECT_TRUE(test::is_ok(renderer_->draw(scene, {view}, backgrounds, images)));
    return images.empty() ? RgbaImage{} : images.front();
  }
  LabelImage labels(const Scene& scene, const View& view) {
    std::vector<LabelImage> images;
    EXPECT_TRUE(test::is_ok(renderer_->draw_labels(scene, {view}, images)));
    return images.empty() ? LabelImage{} : images.front();
  }
  std::string error_of(const Scene& scene, const View& view = straight_ahead()) {
    std::vector<RgbaImage> images;
    const Status drawn = renderer_->draw(scene, {view}, {}, images);
    EXPECT_FALSE(drawn.ok());
    return test::error_of(drawn);
  }

  /// From the origin along -z; one metre away, a pixel of the default size is 5 mm.
  static View straight_ahead() {
    View view;
    view.tan_left = view.tan_right = 0.5f;
    view.tan_up = view.tan_down = 0.3f;
    return view;
  }

 private:
  SilentValidation validation_;
  std::unique_ptr<Renderer> renderer_;
};

/// Red, green and blue at a pixel.
inline std::array<int, 3> pixel(const RgbaImage& image, int x_px, int y_px) {
  const std::size_t i = 4 * (static_cast<std::size_t>(y_px) * image.width_px + x_px);
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

}  // namespace orthonav::render
