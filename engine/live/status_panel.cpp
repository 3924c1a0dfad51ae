#include "engine/live/status_panel.h"

#include <utility>

namespace orthonav::engine {

bool StatusPanel::show(const render::Scene& scene) {
  shown_.reset();
  const auto place = offered_ ? PanelLayout::write(scene, next_) : std::nullopt;
  if (!place) {
    return false;
  }
  if (next_.texts.empty()) {
    return true;
  }
  if (!holds_ || next_.texts != drawn_.texts) {
    if (!layout_.fits(next_)) {
      return false;
    }
    if (const Status drawn = draw(); !drawn) {
      problem_ = drawn.error().message;
      return false;
    }
  }
  shown_ = status_panel(*place);
  return true;
}

Status StatusPanel::draw() {
  const auto image = display_.acquire_panel();
  if (!image) {
    return image.error();
  }
  // If this fails, the image stays acquired for the next attempt.
  if (const Status drawn = renderer_.draw_panel(next_, view_, *image); !drawn) {
    return drawn;
  }
  holds_ = false;
  if (const Status released = display_.release_panel(); !released) {
    return released;
  }
  std::swap(drawn_, next_);
  holds_ = true;
  ++drawn_count_;
  return {};
}

void StatusPanel::ended(bool well) {
  // After a failed frame it is not known whether the display still has the released image.
  holds_ = holds_ && well;
  shown_.reset();
}

}  // namespace orthonav::engine
