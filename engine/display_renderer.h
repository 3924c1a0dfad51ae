#pragma once

#include <memory>

#include "hal/api/pixel_display.h"
#include "render/hosted_renderer.h"

namespace orthonav::engine {

/// A renderer on the device that a display's runtime makes, drawing into the display's images. The
/// one place where both meet: neither knows the other.
class DisplayRenderer {
 public:
  /// Opens the display and starts it. `options` as for HostedRenderer, but for the blend, which is
  /// the display's.
  static Result<std::unique_ptr<DisplayRenderer>> start(PixelDisplay& display,
                                                        render::RendererOptions options);
  /// Waits for the frames in flight, then closes the display, then lets the device go.
  ~DisplayRenderer();
  DisplayRenderer(const DisplayRenderer&) = delete;
  DisplayRenderer& operator=(const DisplayRenderer&) = delete;

  /// Draws a scene into a frame that was begun: false when the eyes are not located. The head is
  /// asked for its pose last, when all that takes time but recording is done.
  Result<bool> draw(const render::Scene& scene);
  [[nodiscard]] const render::HostedRenderer& renderer() const { return *renderer_; }
  /// The views of the last frame drawn.
  [[nodiscard]] const std::vector<render::View>& views() const { return views_; }

 private:
  explicit DisplayRenderer(PixelDisplay& display) : display_(display) {}

  PixelDisplay& display_;
  std::unique_ptr<render::HostedRenderer> renderer_;
  std::vector<render::View> views_;
};

}  // namespace orthonav::engine
