#pragma once

#include <optional>
#include <string>

#include "hal/sim/error_model.h"
#include "tools/preview/model.h"

namespace orthonav::preview {

/// What the panel shows besides the model and its moment.
struct PanelFacts {
  std::string headset;
  std::string device;      ///< the device that draws
  std::int64_t pairs = 0;  ///< of a recording; 0: not known
  double background_ms = 0.0;
  double holograms_ms = 0.0;
  double pictures_a_second = 0.0;
  bool video = false;
  bool ended = false;
  std::shared_ptr<const Moment> moment;      ///< the moment that the picture shows; null: none yet
  std::string note;                          ///< the newest message
  const sim::ErrorModel* running = nullptr;  ///< the error model of the running room, if simulated
};

/// The panel and the help, made with Dear ImGui during a frame of the window. `error_model` is that
/// of the next start.
void draw_panel(PreviewModel& model, const PanelFacts& facts, sim::ErrorModel& error_model);

}  // namespace orthonav::preview
