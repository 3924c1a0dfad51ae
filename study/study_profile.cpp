#include "study/study_profile.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/angle.h"
#include "engine/io/json_document.h"
#include "hal/sim/magnitudes.h"
#include "hal/sim/room/instruments.h"
#include "study/left_out.h"

namespace orthonav::engine {
namespace {

struct NamedExposure {
  std::string_view name;
  sim::Exposure value;
};
constexpr std::array<NamedExposure, 3> kExposure = {{
    {"laminae", sim::Exposure::kLaminae},
    {"transverse processes", sim::Exposure::kTransverseProcesses},
    {"trained pattern", sim::Exposure::kTrainedPattern},
}};

/// The one of `known` that `key` names; refuses other names.
template <class Named, std::size_t N>
void read_name(const JsonNode& profile, const char* key, const std::array<Named, N>& known,
               decltype(Named::value)& out) {
  const std::string name = profile.text(key);
  std::string names;
  for (const Named& one : known) {
    if (one.name == name) {
      out = one.value;
      return;
    }
    names += (names.empty() ? "" : ", ") + std::string(one.name);
  }
  profile.refuse(key, "'" + name + "' is unknown (known: " + names + ")");
}

/// A stated navigation error already includes all of these.
void leave_to_navigation(sim::ErrorModel& model) {
  for (double sim::ErrorModel::*stated :
       {&sim::ErrorModel::calibration_focal_ratio, &sim::ErrorModel::calibration_centre_px,
        &sim::ErrorModel::calibration_rotation_rad, &sim::ErrorModel::calibration_baseline_m,
        &sim::ErrorModel::calibration_distortion_px, &sim::ErrorModel::head_pose_noise_m,
        &sim::ErrorModel::head_pose_noise_rad, &sim::ErrorModel::map_drift_m_per_sqrt_s,
        &sim::ErrorModel::map_drift_rad_per_sqrt_s, &sim::ErrorModel::map_step_m,
        &sim::ErrorModel::tip_calibration_m, &sim::ErrorModel::axis_calibration_rad,
        &sim::ErrorModel::tag_scale, &sim::ErrorModel::tag_bow_m,
        &sim::ErrorModel::model_error_m}) {
    model.*stated = 0.0;
  }
}

void read_magnitudes(const JsonNode& profile, sim::ErrorModel& model) {
  if (!profile.has("magnitudes")) {
    return;
  }
  const JsonNode own = profile.child("magnitudes");
  for (const std::string& name : own.keys()) {
    const sim::Magnitude* known = sim::magnitude_named(name);
    if (known == nullptr) {
      own.refuse(name.c_str(), "is unknown: no magnitude of the simulated room has that name");
      return;
    }
    model.*known->value = own.number(name.c_str());
  }
}

void read_without(const JsonNode& profile, StudyProfile& out) {
  if (!profile.has("without")) {
    return;
  }
  out.without = profile.texts("without");
  OperationOptions tried;
  for (const std::string& step : out.without) {
    if (const Status known = leave_out(step, tried); !known) {
      profile.refuse("without", known.error().message);
      return;
    }
  }
}

void read_ways(const JsonNode& profile, StudyProfile& out) {
  if (profile.has("navigation")) {
    const JsonNode stated = profile.child("navigation");
    out.navigation = {stated.number("target_mm") * 1e-3,
                      stated.number("angle_deg") * kRadiansPerDegree};
    leave_to_navigation(out.magnitudes);
  } else {
    out.method = profile.text("method");
    if (const auto known = method_named(out.method); !known) {
      profile.refuse("method", known.error().message);
    }
  }
  read_name(profile, "guidance", sim::kGuidanceNames, out.guidance);
  if (profile.has("exposure")) {
    read_name(profile, "exposure", kExposure, out.exposure.emplace());
  }
  out.reference = profile.flag_or("reference", false);
  read_without(profile, out);
  out.instrument = profile.text("instrument");
  if (const Status known = sim::use_instrument(out.instrument, out.magnitudes); !known) {
    profile.refuse("instrument", known.error().message);
  }
}

}  // namespace

bool StudyProfile::can_be_previewed() const {
  return !navigation && !reference && without.empty() && !exposure && told_sd_factor == 1.0;
}

void StudyProfile::apply(OperationOptions& options) const {
  options.method = method;
  options.navigation = navigation;
  options.exposure = exposure;
  options.sim.guidance = guidance;
  options.sim.error_model = magnitudes;
  options.sim.told_sd_factor = told_sd_factor;
  options.use_reference = reference;
  for (const std::string& step : without) {
    static_cast<void>(leave_out(step, options));  // known since it was read
  }
}

Result<StudyProfile> parse_profile(std::string_view text, const std::string& name) {
  auto document = JsonDocument::parse(text, name);
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  StudyProfile out;
  out.name = root.text("name");
  read_ways(root, out);
  read_magnitudes(root, out.magnitudes);
  if (root.has("told_sd_factor")) {
    out.told_sd_factor = root.number("told_sd_factor");
  }
  sim::SimOptions room;
  room.error_model = out.magnitudes;
  room.told_sd_factor = out.told_sd_factor;
  if (const Status possible = room.check(); !possible) {
    root.refuse(possible.error().message);
  }
  if (const Status status = document->status(); !status) {
    return status.error();
  }
  return out;
}

Result<StudyProfile> profile_named(const std::string& name_or_file) {
  constexpr std::string_view kPublication = "liebmann-2019";
  if (name_or_file == kPublication) {
    StudyProfile publication;
    publication.name = kPublication;
    publication.method = "paper";
    publication.guidance = sim::GuidanceProfile::kPublished;
    publication.instrument = "wire";
    return publication;
  }
  std::error_code code;
  if (!std::filesystem::is_regular_file(name_or_file, code)) {
    return Error{"--profile " + name_or_file + ": neither a file nor " + std::string(kPublication),
                 ErrorCode::kNotFound};
  }
  const auto text = read_text(name_or_file);
  return text ? parse_profile(*text, name_or_file) : text.error();
}

}  // namespace orthonav::engine
