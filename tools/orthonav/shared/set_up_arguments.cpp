#include "tools/orthonav/shared/set_up_arguments.h"

#include <algorithm>
#include <CLI/Validators.hpp>
#include <cstdint>
#include <vector>

#include "base/joined.h"
#include "hal/sim/room/instruments.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

std::vector<std::string> guidance_names() {
  std::vector<std::string> names;
  for (const sim::NamedGuidance& one : sim::kGuidanceNames) {
    names.emplace_back(one.name);
  }
  return names;
}

void SetUpArguments::add_to(CLI::App& command) {
  command.add_flag("--as-published", as_published,
                   "as in Liebmann et al. 2019: method paper, no reference, guidance published, a "
                   "wire (docs/published.md)");
  command.add_option("-m,--method", method, "best or paper (default: best)")
      ->type_name("best|paper");
  // A flag with the optional itself would set it to false where it is not given.
  command.add_flag_function(
      "--reference,!--no-reference", [this](std::int64_t count) { reference = count > 0; },
      "positions are relative to the patient reference instead of the headset's map (default in "
      "the simulated room)");
  command
      .add_option("--guidance", guidance,
                  "what the simulated surgeon goes by (default: closed loop)")
      ->check(CLI::IsMember(guidance_names()));
  command
      .add_option("--instrument", instrument, "of the simulated surgeon (default: sleeved drill)")
      ->check(some_text())
      ->type_name(joined(sim::instrument_names(), "|"));
}

engine::SetUp SetUpArguments::chosen() const {
  engine::SetUp out =
      as_published || method == "paper" ? engine::SetUp::published() : engine::SetUp::best();
  out.method = method.empty() ? out.method : method;
  out.reference = reference.value_or(out.reference);
  for (const auto& [name, named] : sim::kGuidanceNames) {
    out.guidance = guidance == name ? named : out.guidance;
  }
  out.instrument = instrument.empty() ? out.instrument : instrument;
  return out;
}

bool is_simulated(std::string_view headset_uri) {
  return headset_uri.starts_with("sim:") || headset_uri == "openxr:" ||
         headset_uri.find("+sim:") != std::string_view::npos;
}

engine::SetUp chosen_for(const SetUpArguments& arguments, std::string_view headset_uri) {
  engine::SetUp out = arguments.chosen();
  if (!is_simulated(headset_uri)) {
    out.reference = arguments.reference.value_or(false);
  }
  return out;
}

std::string described(const engine::SetUp& set_up) {
  const auto named =
      std::find_if(sim::kGuidanceNames.begin(), sim::kGuidanceNames.end(),
                   [&set_up](const auto& one) { return one.value == set_up.guidance; });
  return "The simulated surgeon uses: " + set_up.instrument +
         "; guidance: " + std::string(named->name) + " (docs/accuracy.md).";
}

}  // namespace orthonav::tools
