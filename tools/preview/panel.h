#pragma once

#include <optional>
#include <string>

#include "hal/sim/error_model.h"
#include "tools/preview/model.h"

namespace orthonav::preview {

inline constexpr int kPanel_px = 380;

/// What the panel shows beside the model and its moment.
struct PanelFacts {
  std::string headset;
  std::string device;      ///< that draws
  std::int64_t pairs = 0;  ///< of a recording; 0: not known
  double background_ms = 0.0;
  double holograms_ms = 0.0;
  double pictures_a_second = 0.0;
  bool video = false;
  bool ended = false;
  std::shared_ptr<const Moment> moment;      ///< that the picture is of; null: none yet
  std::string note;                          ///< the newest thing to say
  const sim::ErrorModel* running = nullptr;  ///< of a simulated room
};

/// The panel and the help, made of Dear ImGui within a window's frame. `error_model` are those of
/// the next start.
void draw_panel(PreviewModel& model, const PanelFacts& facts, sim::ErrorModel& error_model);

}  // namespace orthonav::preview
