#include "tools/orthonav/accuracy/accuracy_output.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/how_many.h"
#include "base/printed.h"
#include "engine/io/json_writer.h"

namespace orthonav::tools {
namespace {

using nlohmann::ordered_json;

double millimetres(double metres) { return metres * 1e3; }

ordered_json json_of(const nav::AccuracyPart& part) {
  ordered_json out = {{"verdict", to_text(part.verdict())},
                      {"start_s", part.start_s},
                      {"end_s", part.end_s},
                      {"limits", ordered_json::array()}};
  for (const nav::Judged& figure : part.judged) {
    out["limits"].push_back({{"what", figure.what},
                             {"value_mm", millimetres(figure.value_m)},
                             {"pass_to_mm", millimetres(figure.limits.pass_m)},
                             {"note_to_mm", millimetres(figure.limits.note_m)},
                             {"verdict", to_text(figure.verdict)}});
  }
  if (!part.failure.empty()) {
    out["failure"] = part.failure;
  }
  return out;
}

void add_spread(const nav::TipSpread& spread, ordered_json& out) {
  out["samples"] = spread.samples;
  out["rms_mm"] = millimetres(spread.rms_m);
  out["p95_mm"] = millimetres(spread.p95_m);
  out["max_mm"] = millimetres(spread.max_m);
}

ordered_json single_point_json(const nav::SinglePointPart& part) {
  ordered_json out = json_of(part);
  add_spread(part.spread, out);
  if (part.predicted_rms_m) {
    out["predicted_rms_mm"] = millimetres(*part.predicted_rms_m);
  }
  return out;
}

ordered_json turning_json(const nav::TurningPart& part) {
  ordered_json out = json_of(part);
  add_spread(part.spread, out);
  out["largest_tilt_deg"] = part.largest_tilt_rad * kDegreesPerRadian;
  out["tip_bias_mm"] = engine::vector_mm(part.tip_bias_m);
  out["tip_bias_sigma_mm"] = millimetres(part.tip_bias_sigma_m);
  out["residual_rms_mm"] = millimetres(part.residual_rms_m);
  out["by_tilt"] = ordered_json::array();
  for (const nav::TiltBin& bin : part.bins) {
    ordered_json entry = {{"from_deg", bin.from_rad * kDegreesPerRadian},
                          {"to_deg", bin.to_rad * kDegreesPerRadian},
                          {"samples", bin.samples}};
    if (bin.samples > 0) {
      entry["rms_mm"] = millimetres(bin.rms_m);
      entry["max_mm"] = millimetres(bin.max_m);
    }
    out["by_tilt"].push_back(std::move(entry));
  }
  return out;
}

ordered_json distances_json(const nav::DistancePart& part) {
  ordered_json out = json_of(part);
  out["distances"] = part.distances;
  out["mean_error_mm"] = millimetres(part.mean_error_m);
  out["sd_mm"] = millimetres(part.sd_m);
  out["rms_mm"] = millimetres(part.rms_m);
  out["max_error_mm"] = millimetres(part.max_error_m);
  out["fit_rmse_mm"] = millimetres(part.fit_rmse_m);
  out["stray_rests"] = part.stray_rests;
  out["points"] = ordered_json::array();
  for (const nav::TouchedPoint& point : part.points) {
    out["points"].push_back({{"time_s", point.time_s},
                             {"samples", point.samples},
                             {"known_mm", engine::vector_mm(point.known_m)},
                             {"residual_mm", engine::vector_mm(point.residual_m)}});
  }
  return out;
}

/// With as many digits as distinguish the figure from the limits on either side.
void append_judged(const nav::Judged& figure, std::string& text) {
  const double value = millimetres(figure.value_m);
  const double pass = millimetres(figure.limits.pass_m);
  const double note = millimetres(figure.limits.note_m);
  const double nearest = std::abs(value - pass) < std::abs(value - note) ? pass : note;
  append_printed(text, "  %s %s mm: %s (pass to %.2f, note to %.2f)\n", figure.what.c_str(),
                 value_beside(value, nearest, 2).c_str(),
                 std::string(to_text(figure.verdict)).c_str(), pass, note);
}

void append_part(const char* name, const nav::AccuracyPart& part, std::string& text) {
  append_printed(text, "%s: %s (%.1f-%.1f s)\n", name, std::string(to_text(part.verdict())).c_str(),
                 part.start_s, part.end_s);
  if (!part.failure.empty()) {
    text += "  " + part.failure + "\n";
  }
  for (const nav::Judged& figure : part.judged) {
    append_judged(figure, text);
  }
}

void append_spread(const nav::TipSpread& spread, std::string& text) {
  append_printed(text, "  RMS %.2f mm, max %.2f mm, %zu poses\n", millimetres(spread.rms_m),
                 millimetres(spread.max_m), spread.samples);
}

void append_turning(const nav::TurningPart& part, std::string& text) {
  append_part("sensitivity to orientation", part, text);
  append_spread(part.spread, text);
  const Vec3 bias = part.tip_bias_m;
  append_printed(text,
                 "  tip bias %+.2f %+.2f %+.2f mm in the marker's axes (SD %.2f mm), %.2f mm RMS "
                 "without it\n",
                 millimetres(bias.x), millimetres(bias.y), millimetres(bias.z),
                 millimetres(part.tip_bias_sigma_m), millimetres(part.residual_rms_m));
  for (const nav::TiltBin& bin : part.bins) {
    if (bin.samples > 0) {
      append_printed(text, "  tilt %2.0f-%2.0f°: RMS %.2f mm, max %.2f mm, %zu poses\n",
                     bin.from_rad * kDegreesPerRadian, bin.to_rad * kDegreesPerRadian,
                     millimetres(bin.rms_m), millimetres(bin.max_m), bin.samples);
    }
  }
}

void append_distances(const nav::DistancePart& part, std::string& text) {
  append_part("distances", part, text);
  append_printed(text,
                 "  %zu distances of %zu points: mean error %+.2f mm, SD %.2f mm, RMS %.2f mm\n",
                 part.distances, part.points.size(), millimetres(part.mean_error_m),
                 millimetres(part.sd_m), millimetres(part.rms_m));
  if (part.stray_rests > 0) {
    text += "  " + how_many(part.stray_rests, "rest") + " that touched no point left out\n";
  }
}

}  // namespace

ordered_json accuracy_json(const AccuracySubject& subject, const nav::AccuracyReport& report) {
  ordered_json out = {{"pointer", subject.pointer},
                      {subject.format.empty() ? "method" : "format",
                       subject.format.empty() ? subject.method : subject.format},
                      {"verdict", to_text(report.verdict())},
                      {"measured_poses", report.samples},
                      {"duration_s", report.duration_s},
                      {"single_point", single_point_json(report.single_point)},
                      {"turning", turning_json(report.turning)}};
  if (report.distances) {
    out["distances"] = distances_json(*report.distances);
  }
  return out;
}

std::string accuracy_text(const AccuracySubject& subject, const nav::AccuracyReport& report) {
  std::string text =
      "accuracy test of " + subject.pointer +
      (subject.format.empty() ? ", method " + subject.method
                              : ", another tracker's poses (" + subject.format + ")");
  append_printed(text, ": %zu measured poses in %.1f s\n", report.samples, report.duration_s);
  append_part("single-point repeatability", report.single_point, text);
  append_spread(report.single_point.spread, text);
  if (report.single_point.predicted_rms_m) {
    append_printed(text, "  predicted RMS %.2f mm\n",
                   millimetres(*report.single_point.predicted_rms_m));
  }
  append_turning(report.turning, text);
  if (report.distances) {
    append_distances(*report.distances, text);
  } else {
    text += "distances: not tested (--board)\n";
  }
  return text + "verdict: " + std::string(to_text(report.verdict())) + "\n";
}

}  // namespace orthonav::tools
