#include <nlohmann/json.hpp>

#include "study/study_profile.h"
#include "study/study_reading.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// What studies read: a profile, and results of another study; the first byte chooses.
void fuzz_profile(std::span<const std::uint8_t> input) {
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
  const auto profile = engine::parse_profile(text, "profile");
  if (!profile) {
    insist_one_line(profile.error());
    return;
  }
  insist(!profile->name.empty());
}

}  // namespace orthonav::fuzz
