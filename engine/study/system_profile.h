#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/study/simulated_operation.h"

namespace orthonav::engine {

/// A publication's figures for one quantity.
struct PublishedFigure {
  double mean = 0.0;
  std::optional<double> sd;
};

/// A published system, as the simulated room can represent it, and its results.
struct SystemProfile {
  std::string name;
  std::string title;
  std::string conditions;
  bool fitted = false;  ///< its figures were looked at when magnitudes were chosen
  std::string method = "best";
  std::optional<StatedNavigation> navigation;  ///< replaces our own method
  sim::GuidanceProfile guidance = sim::GuidanceProfile::kNumbers;
  std::string instrument;
  bool reference = false;            ///< everything is relative to the patient reference
  std::vector<std::string> without;  ///< steps of the method (left_out.h)
  sim::Exposure exposure = sim::Exposure::kLaminae;
  sim::ErrorModel magnitudes;
  std::optional<PublishedFigure> entry_mm;
  std::optional<PublishedFigure> angle_deg;
  std::optional<PublishedFigure> rmse_mm;
  std::optional<PublishedFigure> tre_mm;  ///< of a registration, at the screws
  std::optional<int> screws;              ///< how many were measured

  /// Its settings, for operations.
  void apply(OperationOptions& options) const;
  /// Whether the preview can show an operation with it completely: camera images, the whole method,
  /// relative to the map, with the documented exposure.
  [[nodiscard]] bool can_be_previewed() const;
};

/// A list of profiles (docs/file-formats.md). `name` stands for the file in messages.
Result<std::vector<SystemProfile>> parse_systems(std::string_view text, const std::string& name);
/// Those of data/systems.json, which is part of the program.
[[nodiscard]] const std::vector<SystemProfile>& published_systems();
/// One of them by its name, or the only one in a file. An Error lists the known names in one line.
Result<SystemProfile> system_named(const std::string& name_or_file);

}  // namespace orthonav::engine
