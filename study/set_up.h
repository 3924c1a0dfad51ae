#pragma once

#include <string>

#include "base/result.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::engine {

/// How an operation in the simulated room is set up.
struct SetUp {
  std::string method;
  bool reference = false;  ///< positions are relative to the patient reference
  sim::GuidanceProfile guidance = sim::GuidanceProfile::kNumbers;
  std::string instrument;  ///< by its name in hal/sim/room/instruments.h

  /// The best there is: what every command shows that is asked for nothing else. (A study has
  /// defaults of its own, study_profile.h.)
  [[nodiscard]] static SetUp best();
  /// That of Liebmann et al. 2019: docs/published.md.
  [[nodiscard]] static SetUp published();
  /// Brings the scripted surgeon into the room, with the guidance, the instrument and the
  /// reference. Refuses an unknown instrument.
  [[nodiscard]] Status tell(sim::SimOptions& room) const;
};

}  // namespace orthonav::engine
