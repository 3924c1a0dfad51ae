#include "engine/study/system_profile.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/angle.h"
#include "embedded/systems_json.h"
#include "engine/io/json_document.h"
#include "engine/study/left_out.h"
#include "hal/sim/instruments.h"
#include "hal/sim/magnitudes.h"

namespace orthonav::engine {
namespace {

struct NamedExposure {
  std::string_view name;
  sim::Exposure value;
};
constexpr std::array<NamedExposure, 2> kExposure = {{
    {"laminae", sim::Exposure::kLaminae},
    {"transverse processes", sim::Exposure::kTransverseProcesses},
}};

/// The one of `known` that `key` names; refuses other names.
template <class Named, std::size_t N>
void read_name(const JsonNode& system, const char* key, const std::array<Named, N>& known,
               decltype(Named::value)& out) {
  const std::string name = system.text(key);
  std::string names;
  for (const Named& one : known) {
    if (one.name == name) {
      out = one.value;
      return;
    }
    names += (names.empty() ? "" : ", ") + std::string(one.name);
  }
  system.refuse(key, "'" + name + "' is unknown (known: " + names + ")");
}

std::optional<PublishedFigure> read_figure(const JsonNode& published, const char* key) {
  if (!published.has(key)) {
    return std::nullopt;
  }
  const JsonNode figure = published.child(key);
  PublishedFigure out{figure.number("mean"), {}};
  if (figure.has("sd")) {
    out.sd = figure.number("sd");
  }
  return out;
}

/// The stated navigation error of a published system already includes all of these.
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

void read_magnitudes(const JsonNode& system, sim::ErrorModel& model) {
  if (!system.has("magnitudes")) {
    return;
  }
  const JsonNode own = system.child("magnitudes");
  for (const std::string& name : own.keys()) {
    const sim::Magnitude* known = sim::magnitude_named(name);
    if (known == nullptr) {
      own.refuse(name.c_str(), "is unknown: no magnitude of the simulated room has that name");
      return;
    }
    model.*known->value = own.number(name.c_str());
  }
}

void read_without(const JsonNode& system, SystemProfile& out) {
  if (!system.has("without")) {
    return;
  }
  out.without = system.texts("without");
  OperationOptions tried;
  for (const std::string& step : out.without) {
    if (const Status known = leave_out(step, tried); !known) {
      system.refuse("without", known.error().message);
      return;
    }
  }
}

void read_ways(const JsonNode& system, SystemProfile& out) {
  if (system.has("navigation")) {
    const JsonNode stated = system.child("navigation");
    out.navigation = {stated.number("target_mm") * 1e-3,
                      stated.number("angle_deg") * kRadiansPerDegree};
    leave_to_navigation(out.magnitudes);
  } else {
    out.method = system.text("method");
    if (const auto known = method_named(out.method); !known) {
      system.refuse("method", known.error().message);
    }
  }
  read_name(system, "guidance", sim::kGuidanceNames, out.guidance);
  if (system.has("exposure")) {
    read_name(system, "exposure", kExposure, out.exposure);
  }
  out.reference = system.flag_or("reference", false);
  read_without(system, out);
  out.instrument = system.text("instrument");
  if (const Status known = sim::use_instrument(out.instrument, out.magnitudes); !known) {
    system.refuse("instrument", known.error().message);
  }
}

SystemProfile read_system(const JsonNode& system) {
  SystemProfile out;
  out.name = system.text("name");
  out.title = system.text("title");
  out.conditions = system.text_or("conditions", "");
  out.fitted = system.flag_or("fitted", false);
  read_ways(system, out);
  read_magnitudes(system, out.magnitudes);
  for (const std::string& problem : out.magnitudes.check()) {
    system.refuse(problem);
  }
  const JsonNode published = system.child("published");
  out.entry_mm = read_figure(published, "entry_mm");
  out.angle_deg = read_figure(published, "angle_deg");
  out.rmse_mm = read_figure(published, "rmse_mm");
  out.tre_mm = read_figure(published, "tre_mm");
  if (published.has("screws")) {
    out.screws = published.integer("screws");
  }
  return out;
}

}  // namespace

bool SystemProfile::can_be_previewed() const {
  return !navigation && !reference && without.empty() && exposure == sim::Exposure::kLaminae;
}

void SystemProfile::apply(OperationOptions& options) const {
  options.method = method;
  options.navigation = navigation;
  options.exposure = exposure;
  options.sim.guidance = guidance;
  options.sim.error_model = magnitudes;
  options.use_reference = reference;
  for (const std::string& step : without) {
    static_cast<void>(leave_out(step, options));  // known since it was read
  }
}

Result<std::vector<SystemProfile>> parse_systems(std::string_view text, const std::string& name) {
  auto document = JsonDocument::parse(text, name);
  if (!document) {
    return document.error();
  }
  std::vector<SystemProfile> systems;
  for (const JsonNode& system : document->root().list("systems")) {
    systems.push_back(read_system(system));
  }
  if (const Status status = document->status(); !status) {
    return status.error();
  }
  if (systems.empty()) {
    return Error{name + ": systems is empty"};
  }
  return systems;
}

const std::vector<SystemProfile>& published_systems() {
  static const std::vector<SystemProfile> systems =
      parse_systems(embedded::systems_json(), "data/systems.json").value();
  return systems;
}

Result<SystemProfile> system_named(const std::string& name_or_file) {
  std::string known;
  for (const SystemProfile& system : published_systems()) {
    if (system.name == name_or_file) {
      return system;
    }
    known += (known.empty() ? "" : ", ") + system.name;
  }
  std::error_code code;
  if (!std::filesystem::is_regular_file(name_or_file, code)) {
    return Error{
        "--profile " + name_or_file + ": neither a file nor a known system (known: " + known + ")",
        ErrorCode::kNotFound};
  }
  const auto text = read_text(name_or_file);
  if (!text) {
    return text.error();
  }
  auto systems = parse_systems(*text, name_or_file);
  if (!systems) {
    return systems.error();
  }
  if (systems->size() != 1) {
    return Error{name_or_file + ": holds " + std::to_string(systems->size()) +
                 " systems, one needed"};
  }
  return std::move(systems->front());
}

}  // namespace orthonav::engine
