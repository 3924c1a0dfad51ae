#include "tools/orthonav/study/surgeon_arguments.h"

#include <CLI/Validators.hpp>
#include <vector>

#include "base/joined.h"
#include "hal/sim/room/instruments.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/set_up_arguments.h"

namespace orthonav::tools {
void SurgeonArguments::add_to(CLI::App& command) {
  command
      .add_option("--guidance", guidance,
                  "what the surgeon goes by: overlay, numbers, \"closed loop\" or published "
                  "(default: numbers)")
      ->check(CLI::IsMember(guidance_names()));
  command.add_option("--instrument", instrument, "of the surgeon (default: wire)")
      ->check(some_text())
      ->type_name(joined(sim::instrument_names(), "|"));
  command
      .add_option(
          "--strokes", strokes,
          "measured (docs/real-measurements.md): as others stroked a bare sawbone pelvis, 0.4 "
          "mm above the model (default: fitted to a publication, 1.6 mm)")
      ->check(CLI::IsMember({"measured"}));
}

Status SurgeonArguments::set_in(sim::GuidanceProfile& profile, sim::ErrorModel& error_model) const {
  for (const auto& [name, named] : sim::kGuidanceNames) {
    profile = guidance == name ? named : profile;
  }
  if (strokes == "measured") {
    sim::use_measured_strokes(error_model);
  }
  if (instrument.empty()) {
    return {};
  }
  if (const Status known = sim::use_instrument(instrument, error_model); !known) {
    return Error{"--instrument: " + known.error().message};
  }
  return {};
}

}  // namespace orthonav::tools
