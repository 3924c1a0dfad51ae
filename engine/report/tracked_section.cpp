#include "engine/report/tracked_section.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_values.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

constexpr const char* kNoMeasurement = "not measured";
constexpr const char* kNoRecord = "not recorded";

/// Why this figure is missing.
const char* why_none(const json& screw, const char* what) {
  const auto names = screw.find("not_measured");
  const bool known = names != screw.end() && names->is_array() &&
                     std::find(names->begin(), names->end(), json(what)) != names->end();
  return known ? kNoMeasurement : kNoRecord;
}

/// The root mean square SD over `axes` of a 3x3 matrix by rows; nothing if the value is not one.
std::optional<double> axis_sd_of(const json& object, const char* key, double axes) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 9) {
    return std::nullopt;
  }
  double trace = 0.0;
  for (const std::size_t i : {0U, 4U, 8U}) {
    trace += (*found)[i].is_number() ? (*found)[i].get<double>() : 0.0;
  }
  return std::sqrt(std::max(0.0, trace) / axes);
}

std::string numbers_under(const json& object, const char* key, int decimals) {
  const auto found = object.find(key);
  std::string out;
  if (found != object.end() && found->is_array()) {
    for (const json& value : *found) {
      out += (out.empty() ? "" : ", ") +
             (value.is_number() ? html_number(value.get<double>(), decimals) : "–");
    }
  }
  return out;
}

std::string plus_minus(const std::string& value, std::optional<double> sd, int decimals) {
  return value + " ± " + (sd ? html_number(*sd, decimals) : "unknown");
}

void put_tracked_way(HtmlTable& table, const json& screw) {
  const auto found = screw.find("executed");
  if (found == screw.end() || !found->is_object()) {
    for (int i = 0; i < 4; ++i) {
      table.cell(why_none(screw, "executed"));
    }
    return;
  }
  const auto direction_sd = axis_sd_of(*found, "direction_covariance_rad2", 2.0);
  table.cell(plus_minus(numbers_under(*found, "entry_mm", 1),
                        axis_sd_of(*found, "entry_covariance_mm2", 3.0), 2));
  table.cell(plus_minus(numbers_under(*found, "direction", 3),
                        direction_sd ? std::optional(degrees(*direction_sd)) : std::nullopt, 2));
  table.cell(figure(*found, "depth_mm", 1));
  table.cell(figure(*found, "pairs", 0));
}

std::string grades_at_depth(const json& screw) {
  if (const json& tracked = object_in(screw, "tracked"); tracked.contains("grade_probability")) {
    return likely_grades(tracked["grade_probability"]);
  }
  const char* why = why_none(screw, "grade_probability");
  return why == kNoMeasurement ? why : why_none(screw, "clearance");
}

std::string table_of_tools(const json& report) {
  HtmlTable table({{"screw"},
                   {"entry in the vertebra", "mm, LPS, \u00b1 SD of an axis"},
                   {"direction into the bone", "\u00b1 SD \u00b0"},
                   {"depth", "mm"},
                   {"pairs"},
                   {"grade, probability"}});
  for_each_screw(report, [&](const json&, const std::string& name, const json& screw) {
    const bool done = screw.value("done", json(true)) != json(false);
    if (done && (screw.contains("executed") || screw.contains("not_measured"))) {
      table.row(html_escaped(name));
      put_tracked_way(table, screw);
      table.cell(grades_at_depth(screw));
    }
  });
  return table.empty() ? "<p>Where the tools went: not recorded.</p>" : table.html();
}

std::string table_of_tags(const json& found) {
  if (!found.contains("tags")) {
    return "<p>Sizes of the tags: not measured.</p>";
  }
  HtmlTable table({{"tags of"}, {"larger than stated, as seen", "%"}, {"taken into account", "%"}});
  for (const json& size : found["tags"]) {
    table.row(html_escaped(text_in(size, "tool")));
    table.cell(plus_minus(figure(size, "measured_percent", 2), value_of(size, "sd_percent"), 2));
    table.cell(figure(size, "applied_percent", 2));
  }
  return table.html();
}

std::string cameras_text(const json& found) {
  if (!found.contains("cameras")) {
    return "<p>Cameras against their calibration: not measured.</p>";
  }
  const json& cameras = found["cameras"];
  return "<p>Cameras against their calibration, from " + figure(cameras, "pairs", 0) +
         " sightings: turned by " + figure(cameras, "rotation_deg", 3) + "°" +
         (is_true(cameras, "rotation_applied") ? ", taken into account"
                                               : ", not taken into account") +
         "; focal lengths differ by " +
         plus_minus(figure(cameras, "focal_percent", 2), value_of(cameras, "focal_sd_percent"), 2) +
         " %, baseline by " +
         plus_minus(figure(cameras, "baseline_percent", 2),
                    value_of(cameras, "baseline_sd_percent"), 2) +
         " %, neither taken into account.</p>";
}

/// "tip 0.40 (assumed)".
std::string error_text(const json& errors, const char* name, const char* key, const char* unit) {
  const json& error = object_in(errors, name);
  return figure(error, key, 2) + unit + " (" + html_escaped(text_in(error, "source")) + ")";
}

/// With which errors the expected ones count, and who says so.
std::string errors_text(const json& report) {
  const json& errors = object_in(report, "common_errors");
  if (errors.empty()) {
    return "<p>Errors that all strokes share: not recorded.</p>";
  }
  const bool drifts =
      value_of(object_in(errors, "map_drift"), "sd_mm_per_sqrt_s").value_or(0.0) > 0.0;
  const std::string counted =
      "tip " + error_text(errors, "tip", "sd_mm", " mm") + ", cameras " +
      error_text(errors, "cameras", "sd_mm", " mm") + ", map " +
      (drifts ? error_text(errors, "map_drift", "sd_mm_per_sqrt_s", " mm/\u221as")
              : error_text(errors, "map", "sd_mm", " mm"));
  const bool assumes = counted.find("(assumed)") != std::string::npos;
  return "<p>Errors that all strokes share, SD along an axis, as counted with: " + counted + "." +
         (assumes ? " Assumed: usual for such devices, none was given." : "") + "</p>";
}

}  // namespace

std::string tracked_section(const json& report) {
  std::string html = "<section id=tracked><h2>As tracked, without a truth</h2>" +
                     table_of_tools(report) + errors_text(report);
  const auto found = report.find("calibration");
  if (found == report.end() || !found->is_object()) {
    return html + "<p>Tags and cameras in use: not recorded.</p></section>";
  }
  return html + table_of_tags(*found) + cameras_text(*found) + "</section>";
}

}  // namespace orthonav::engine
