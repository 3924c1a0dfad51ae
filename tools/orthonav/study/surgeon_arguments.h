#pragma once

#include <CLI/App.hpp>
#include <string>

#include "base/result.h"
#include "hal/sim/error_model.h"
#include "hal/sim/surgeon/guidance_profile.h"

namespace orthonav::tools {

/// `--guidance`, `--instrument` and `--strokes` of a study: how the simulated surgeon strokes bones
/// and places screws.
struct SurgeonArguments {
  std::string guidance;    ///< empty: as it is, by the numbers unless a profile says otherwise
  std::string instrument;  ///< empty: as it is, a wire unless a profile says otherwise

  std::string strokes;  ///< empty: as they are, fitted unless a profile says otherwise

  void add_to(CLI::App& command);
  [[nodiscard]] bool is_given() const {
    return !guidance.empty() || !instrument.empty() || !strokes.empty();
  }
  /// Changes what was given. Refuses an unknown instrument.
  [[nodiscard]] Status set_in(sim::GuidanceProfile& profile, sim::ErrorModel& error_model) const;
};

}  // namespace orthonav::tools
