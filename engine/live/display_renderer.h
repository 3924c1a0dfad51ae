#pragma once

#include <memory>

#include "base/result.h"
#include "hal/api/pixel_display.h"
#include "render/hosted_renderer.h"

namespace orthonav::engine {

/// A renderer on the device that the display's runtime makes, drawing into the display's images.
/// The only connection between the two: neither knows the other.
class DisplayRenderer {
 public:
  /// Opens the display and starts it. `options` as for HostedRenderer, except that the display
  /// decides the blend.
  static Result<std::unique_ptr<DisplayRenderer>> start(PixelDisplay& display,
                                                        render::RendererOptions options);
  /// Waits for the frames in flight, closes the display, then destroys the device.
  ~DisplayRenderer();
  DisplayRenderer(const DisplayRenderer&) = delete;
  DisplayRenderer& operator=(const DisplayRenderer&) = delete;

  /// Draws a scene into a begun frame. While the head is not located, only items fixed to the head
  /// are drawn; if the eyes' places on the head are also unknown, nothing is drawn and the result
  /// is false. The eyes are located as late as possible: only layout, recording and submission come
  /// after that.
  Result<bool> draw(const render::Scene& scene);
  [[nodiscard]] const render::HostedRenderer& renderer() const { return *renderer_; }
  /// The scene drawn last (the given one, or the part of it that is fixed to the head) and its
  /// views.
  [[nodiscard]] const render::Scene& drawn() const { return *drawn_; }
  [[nodiscard]] const std::vector<render::View>& views() const { return views_; }
  /// Whether those views are places in the world.
  [[nodiscard]] bool head_located() const { return !views_.empty() && drawn_ != &head_lost_; }

 private:
  explicit DisplayRenderer(PixelDisplay& display) : display_(display) {}

  PixelDisplay& display_;
  std::unique_ptr<render::HostedRenderer> renderer_;
  std::vector<render::View> views_;
  render::Scene head_lost_;  ///< drawn while the head is not located
  const render::Scene* drawn_ = &head_lost_;
};

}  // namespace orthonav::engine
