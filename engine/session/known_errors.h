#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "nav/registration/tre.h"

namespace orthonav::engine {

/// Where the SD of an error comes from.
enum class ErrorSource {
  kGiven,    ///< by the user
  kRoom,     ///< the simulated room draws from it
  kAssumed,  ///< nobody said: as such devices usually are (docs/headsets.md)
  kNone,     ///< there is no such error: nothing hangs on a headset's map
};
inline constexpr std::size_t kErrorSources = 4;
/// "given", "simulated room", "assumed", "none".
[[nodiscard]] std::string_view name_of(ErrorSource source);

struct ErrorSd {
  double sd = 0.0;
  ErrorSource source = ErrorSource::kAssumed;
};

/// What is known of the errors that all strokes share, SDs along an axis; the rest is assumed.
struct KnownErrors {
  std::optional<ErrorSd> tip_m;      ///< of the pointer's tip
  std::optional<ErrorSd> cameras_m;  ///< of where calibrated cameras see a tool
  /// Of World against the patient since the bone was stroked, however long ago; replaces the drift.
  std::optional<ErrorSd> map_m;
  std::optional<ErrorSd> map_drift_m_per_sqrt_s;
};

/// What an operation counts with.
struct ErrorsInUse {
  ErrorSd tip_m;
  ErrorSd cameras_m;
  ErrorSd map_m;
  ErrorSd map_drift_m_per_sqrt_s;

  [[nodiscard]] nav::CommonErrors common() const { return {tip_m.sd, cameras_m.sd, map_m.sd}; }
};

/// The devices of an operation, as far as assumptions depend on them.
struct ErrorsOfDevices {
  bool measures_tools = false;     ///< a tracker that stands still finds the tools, no headset
  bool patient_reference = false;  ///< positions are relative to it
};

/// The one place that decides with which common errors an operation counts.
[[nodiscard]] ErrorsInUse errors_in_use(const KnownErrors& known, const ErrorsOfDevices& devices);

}  // namespace orthonav::engine
