#include "engine/session/known_errors.h"

#include <array>
#include <string_view>

namespace orthonav::engine {
namespace {

// The same as follow from the simulated room's magnitudes, whose sources are in
// hal/sim/error_model.h.
constexpr double kTip_m = 0.0004;
constexpr double kCameras_m = 0.00046;
constexpr double kMapDrift_m_per_sqrt_s = 0.00011;
/// What makers of optical trackers state.
constexpr double kTracker_m = 0.00025;

constexpr std::array<std::string_view, kErrorSources> kSources = {"given", "simulated room",
                                                                  "assumed", "none"};

}  // namespace

std::string_view name_of(ErrorSource source) { return kSources[static_cast<std::size_t>(source)]; }

ErrorsInUse errors_in_use(const KnownErrors& known, const ErrorsOfDevices& devices) {
  ErrorsInUse out;
  out.tip_m = known.tip_m.value_or(ErrorSd{kTip_m});
  out.cameras_m =
      known.cameras_m.value_or(ErrorSd{devices.measures_tools ? kTracker_m : kCameras_m});
  const ErrorSd none{0.0, ErrorSource::kNone};
  if (known.map_m) {
    out.map_m = *known.map_m;
    out.map_drift_m_per_sqrt_s = none;
  } else if (devices.measures_tools || devices.patient_reference) {
    out.map_m = out.map_drift_m_per_sqrt_s = none;
  } else {
    out.map_m = none;
    out.map_drift_m_per_sqrt_s =
        known.map_drift_m_per_sqrt_s.value_or(ErrorSd{kMapDrift_m_per_sqrt_s});
  }
  return out;
}

}  // namespace orthonav::engine
