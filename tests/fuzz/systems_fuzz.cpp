#include <nlohmann/json.hpp>

#include "engine/study/study_reading.h"
#include "engine/study/system_profile.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// What studies read: profiles of systems, and results of another study; the first byte chooses.
void fuzz_systems(std::span<const std::uint8_t> input) {
  if (input.empty()) {
    return;
  }
  const std::string text = text_of(input.subspan(1));
  if (input[0] % 2 == 1) {
    const auto study = engine::parse_study(text, "study");
    if (!study) {
      insist_one_line(study.error());
    }
    return;
  }
  const auto systems = engine::parse_systems(text, "systems");
  if (!systems) {
    insist_one_line(systems.error());
    return;
  }
  for (const engine::SystemProfile& system : *systems) {
    insist(!system.name.empty());
  }
}

}  // namespace orthonav::fuzz
