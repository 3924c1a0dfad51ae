#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/holograms/optical_model.h"
#include "hal/api/devices.h"
#include "hal/sim/cameras/room_renderer.h"
#include "hal/sim/sim_headset.h"
#include "render/renderer.h"
#include "tools/preview/model.h"
#include "tools/preview/recorded_images.h"

namespace orthonav::preview {

struct StageOptions {
  int width_px = 1120;
  int height_px = 720;
  double half_angle_deg = 27.0;  ///< of the horizontal field of view
  std::string device;            ///< part of a Vulkan device's name; empty: the best
};

/// Draws a moment: the simulated room, or the left camera's image of a recording, with the
/// holograms over it. The room is seen from where the head truly is, the holograms where the
/// headset believed them to be: tracking error and map drift appear as they would in reality. One
/// thread.
class StageView {
 public:
  /// An Error when no Vulkan device is suitable.
  static Result<std::unique_ptr<StageView>> create(const StageOptions& options);

  /// Sets the background of the holograms from now on.
  void look_at_room(const sim::SimHeadset& headset);
  void look_at_recording(RecordedImages images);

  Status draw(const Moment& moment, const Look& look);
  [[nodiscard]] const RgbaImage& picture() const { return images_.front(); }
  /// Where the surgeon's eye is at that moment.
  [[nodiscard]] Transform<sim::Room, Eye> eye_of(const Moment& moment) const;
  [[nodiscard]] const render::DeviceInfo& device() const { return renderer_->device(); }
  /// Wall time of the newest picture: what is behind, and the holograms.
  [[nodiscard]] double background_ms() const { return background_ms_; }
  [[nodiscard]] double holograms_ms() const { return renderer_->last_timing().total_ms; }

 private:
  StageView(const StageOptions& options, std::unique_ptr<render::Renderer> renderer);
  void set_field_of_view(double magnification);
  void draw_background(const Moment& moment, const Look& look,
                       const Transform<sim::Room, Eye>& stage_from_eye);

  StageOptions options_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<sim::RoomRenderer> room_;
  std::optional<RecordedImages> recording_;
  engine::WorldBehindCombiner combiner_;
  double background_ms_ = 0.0;

  // Reused from picture to picture.
  RgbaImage room_picture_;
  RgbaImage background_;
  render::Scene scene_;
  std::vector<render::View> views_;
  std::vector<const RgbaImage*> backgrounds_;
  std::vector<RgbaImage> images_;
};

}  // namespace orthonav::preview
