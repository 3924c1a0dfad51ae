#include "engine/session/known_errors.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/io/json_document.h"

namespace orthonav::engine {
namespace {

// The same as follow from the simulated room's magnitudes, whose sources are in
// hal/sim/error_model.h.
constexpr double kTip_m = 0.0004;
constexpr double kCameras_m = 0.00046;
constexpr double kMapDrift_m_per_sqrt_s = 0.00011;
/// What makers of optical trackers state.
constexpr double kTracker_m = 0.00025;

constexpr std::array<std::string_view, 4> kSources = {"given", "simulated room", "assumed", "none"};

void put(JournalLine& out, const char* name, const char* unit, const ErrorSd& error) {
  out[name] = {{unit, error.sd * 1e3},
               {"source", kSources[static_cast<std::size_t>(error.source)]}};
}

ErrorSd error_of(const JsonNode& node, const char* unit) {
  ErrorSd error{node.number(unit) * 1e-3, ErrorSource::kAssumed};
  const std::string source = node.text("source");
  for (std::size_t i = 0; i < kSources.size(); ++i) {
    error.source = source == kSources[i] ? static_cast<ErrorSource>(i) : error.source;
  }
  return error;
}

constexpr const char* kMm = "sd_mm";
constexpr const char* kMmPerSqrtS = "sd_mm_per_sqrt_s";

}  // namespace

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

JournalLine errors_json(const ErrorsInUse& errors) {
  JournalLine out = JournalLine::object();
  put(out, "tip", kMm, errors.tip_m);
  put(out, "cameras", kMm, errors.cameras_m);
  put(out, "map", kMm, errors.map_m);
  put(out, "map_drift", kMmPerSqrtS, errors.map_drift_m_per_sqrt_s);
  return out;
}

ErrorsInUse errors_from(const JsonNode& node) {
  return {error_of(node.child("tip"), kMm), error_of(node.child("cameras"), kMm),
          error_of(node.child("map"), kMm), error_of(node.child("map_drift"), kMmPerSqrtS)};
}

}  // namespace orthonav::engine
