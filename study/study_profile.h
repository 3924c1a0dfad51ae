#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/simulated_operation.h"

namespace orthonav::engine {

/// The setting of a study: with which method, guidance and instrument, and in what room.
struct StudyProfile {
  std::string name;
  std::string method = "best";
  std::optional<StatedNavigation> navigation;  ///< replaces our own method
  sim::GuidanceProfile guidance = sim::GuidanceProfile::kNumbers;
  std::string instrument;
  bool reference = false;                 ///< everything is relative to the patient reference
  std::vector<std::string> without;       ///< steps of the method (left_out.h)
  std::optional<sim::Exposure> exposure;  ///< absent: as the method is used
  sim::ErrorModel magnitudes;
  double told_sd_factor = 1.0;  ///< as `SimOptions` has it

  /// Its settings, for operations.
  void apply(OperationOptions& options) const;
  /// Whether the preview can show an operation with it completely: camera images, the whole method,
  /// relative to the map, with the documented exposure.
  [[nodiscard]] bool can_be_previewed() const;
};

/// A profile's file (docs/file-formats.md). `name` stands for the file in messages.
Result<StudyProfile> parse_profile(std::string_view text, const std::string& name);
/// "liebmann-2019", the setting of the publication's Table 1, or that of a file. An Error is one
/// line.
Result<StudyProfile> profile_named(const std::string& name_or_file);

}  // namespace orthonav::engine
