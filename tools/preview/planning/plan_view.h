#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scan/volume.h"
#include "render/renderer.h"
#include "tools/preview/planning/plan_scene.h"

namespace orthonav::preview {

/// Draws the four panes of a plan into one picture: three slices along and across the screw, over
/// the scan if there is one, and the bone in space. One thread.
class PlanView {
 public:
  /// The picture's size; both even. An Error when no Vulkan device is suitable.
  static Result<std::unique_ptr<PlanView>> create(int width_px, int height_px,
                                                  const std::string& device);

  /// The scan from which the models were made, in their frame; it must outlive the view.
  void look_at_scan(const engine::Volume& scan) { scan_.emplace(scan); }
  Status draw(const PlanModel& model);
  [[nodiscard]] const RgbaImage& picture() const { return picture_; }
  [[nodiscard]] double aspect() const {
    return static_cast<double>(picture_.width_px) / picture_.height_px;
  }
  [[nodiscard]] const render::DeviceInfo& device() const { return renderer_->device(); }

 private:
  PlanView(int width_px, int height_px, std::unique_ptr<render::Renderer> renderer);
  void draw_behind(const PlanModel& model, Pane pane);
  void put(Pane pane);

  std::unique_ptr<render::Renderer> renderer_;
  std::optional<engine::ScanField> scan_;
  std::optional<DrawnBone> bone_;
  RgbaImage picture_;

  // Reused from pane to pane.
  RgbaImage behind_;
  render::Scene scene_;
  std::vector<const RgbaImage*> backgrounds_;
  std::vector<RgbaImage> images_;
};

}  // namespace orthonav::preview
