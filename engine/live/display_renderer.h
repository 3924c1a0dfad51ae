#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "engine/live/status_panel.h"
#include "hal/api/pixel_display.h"
#include "render/renderer.h"

namespace orthonav::engine {

/// A renderer on the device that the display's runtime makes, drawing into the display's images.
/// The only connection between the two: neither knows the other.
class DisplayRenderer {
 public:
  /// Opens the display and starts it. `options` as for render::Renderer, except that the display
  /// decides the blend.
  static Result<std::unique_ptr<DisplayRenderer>> start(PixelDisplay& display,
                                                        render::RendererOptions options);
  /// Waits for the frames in flight, closes the display, then destroys the device.
  ~DisplayRenderer();
  DisplayRenderer(const DisplayRenderer&) = delete;
  DisplayRenderer& operator=(const DisplayRenderer&) = delete;

  /// Draws a scene into a frame that was begun. While the head is not located, only what is fixed
  /// to the head is drawn; if it is also unknown where the eyes are on the head, nothing is drawn
  /// for them and the answer is false. The eyes are located as late as possible: only layout,
  /// recording and submission come after that. What is fixed to the head goes onto the display's
  /// panel, if it has one.
  Result<bool> draw(const render::Scene& scene);
  /// Ends the frame with what was drawn since it was begun.
  Status end_frame();
  [[nodiscard]] const render::Renderer& renderer() const { return *renderer_; }
  /// The scene drawn last (the given one, or the part of it that is fixed to the head) and its
  /// views.
  [[nodiscard]] const render::Scene& drawn() const { return *drawn_; }
  [[nodiscard]] const std::vector<render::View>& views() const { return views_; }
  /// Whether those views are places in the world.
  [[nodiscard]] bool head_located() const { return !views_.empty() && drawn_ != &head_lost_; }
  [[nodiscard]] const StatusPanel& panel() const { return *panel_; }
  /// Where the eyes looked when they were last located.
  [[nodiscard]] const std::optional<Gaze>& gaze() const { return gaze_; }

 private:
  explicit DisplayRenderer(PixelDisplay& display) : display_(display) {}
  Status draw_eyes(const EyeViews& eyes, std::span<const std::uint32_t> images);

  PixelDisplay& display_;
  std::unique_ptr<render::Renderer> renderer_;
  std::optional<StatusPanel> panel_;
  bool panel_shows_ = false;  ///< the panel shows what hangs on the head, in this frame
  bool eyes_drawn_ = false;   ///< in this frame
  std::optional<Gaze> gaze_;
  std::vector<render::View> views_;
  render::Scene head_lost_;  ///< drawn while the head is not located
  const render::Scene* drawn_ = &head_lost_;
};

}  // namespace orthonav::engine
