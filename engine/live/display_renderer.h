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

  /// Draws a scene into a frame that was begun. While the head is not located only what hangs on it
  /// is drawn, and where its eyes are not known either nothing: then false. The head is asked for
  /// its pose last, when all that takes time but recording is done.
  Result<bool> draw(const render::Scene& scene);
  [[nodiscard]] const render::HostedRenderer& renderer() const { return *renderer_; }
  /// What was drawn last, the scene given or what was left of it, and its views.
  [[nodiscard]] const render::Scene& drawn() const { return *drawn_; }
  [[nodiscard]] const std::vector<render::View>& views() const { return views_; }

 private:
  explicit DisplayRenderer(PixelDisplay& display) : display_(display) {}

  PixelDisplay& display_;
  std::unique_ptr<render::HostedRenderer> renderer_;
  std::vector<render::View> views_;
  render::Scene left_;  ///< while the head is not located
  const render::Scene* drawn_ = &left_;
};

}  // namespace orthonav::engine
