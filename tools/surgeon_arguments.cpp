#include "tools/surgeon_arguments.h"

#include <algorithm>
#include <array>
#include <CLI/Validators.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/sim/instruments.h"
#include "tools/arguments.h"

namespace orthonav::tools {
namespace {

std::vector<std::string> guidance_names() {
  std::vector<std::string> names;
  for (const sim::NamedGuidance& one : sim::kGuidanceNames) {
    names.emplace_back(one.name);
  }
  return names;
}

}  // namespace

void SurgeonArguments::add_to(CLI::App& command) {
  command
      .add_option(
          "--guidance", guidance,
          "what the surgeon goes by: overlay, numbers or \"closed loop\" (default: numbers)")
      ->check(CLI::IsMember(guidance_names()));
  command
      .add_option("--instrument", instrument,
                  "wire, cannula, \"sleeved drill\", screw or \"robot arm\" (default: wire)")
      ->check(some_text());
}

std::string SurgeonArguments::described() const {
  constexpr std::array<std::pair<std::string_view, const char*>, 5> kPlaced = {{
      {"wire", "a wire that nothing supports"},
      {"cannula", "a cannula"},
      {"sleeved drill", "a drill in a sleeve"},
      {"screw", "a drill in a sleeve, then the screw in its hole"},
      {"robot arm", "a drill held by a robot's arm"},
  }};
  const std::string_view placed = instrument.empty() ? kPlaced[0].first : instrument;
  const auto* with = std::find_if(kPlaced.begin(), kPlaced.end(),
                                  [&](const auto& one) { return one.first == placed; });
  std::string by = "the angle by the number, the entry as shown";
  if (guidance == "overlay") {
    by = "entry and trajectory as shown over the bone";
  } else if (guidance == "closed loop") {
    by = "entry and angle by the numbers, also while drilling";
  }
  return "The surgeon works with " + (with == kPlaced.end() ? instrument : with->second) +
         " and goes by " + by + ".";
}

Status SurgeonArguments::set_in(sim::GuidanceProfile& profile, sim::ErrorModel& error_model) const {
  for (const auto& [name, named] : sim::kGuidanceNames) {
    profile = guidance == name ? named : profile;
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
