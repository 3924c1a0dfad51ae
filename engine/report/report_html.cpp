#include "engine/report/report_html.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "embedded/chart_js.h"
#include "embedded/report_css.h"
#include "embedded/report_js.h"
#include "engine/report/base64.h"
#include "engine/report/clearance_section.h"
#include "engine/report/html_text.h"
#include "engine/report/operation_result.h"
#include "engine/report/paper_table.h"
#include "engine/report/registration_page.h"
#include "engine/report/report_values.h"
#include "engine/report/script_json.h"
#include "engine/report/tracked_section.h"
#include "engine/report/wire_section.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

/// A figure of the report, or a dash where it is absent (no truth, not reached).
std::string figure(const json& object, const char* key, int decimals) {
  const auto value = value_of(object, key);
  return value ? html_number(*value, decimals) : "\u2013";
}

std::string text_of(const json& object, const char* key) {
  return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : "";
}

void table_against_paper(const json& report, std::string& html) {
  html +=
      "<section><h2>Against the published system</h2><table><thead><tr><th></th>"
      "<th>Liebmann et al. 2019</th><th>this run</th><th>min\u2013max</th><th>n</th></tr>"
      "</thead><tbody>";
  for (const PaperRow& row : kPaperTable) {
    const std::vector<double> values = values_of(report, row.key, row.per_screw);
    const nav::Summary s = nav::summarize(values);
    html += "<tr><th scope=row>" + std::string(row.name) + " <small>" + std::string(row.unit) +
            "</small></th><td>" + html_number(row.mean, row.decimals) + " \u00b1 " +
            html_number(row.sd, row.decimals) + "</td>";
    if (s.count == 0) {
      html += "<td>\u2013</td><td>\u2013</td><td>0</td></tr>";
      continue;
    }
    html += "<td class=ours>" + html_number(s.mean, row.decimals);
    if (s.count > 1) {
      html += " \u00b1 " + html_number(s.sd, row.decimals);
    }
    html += "</td><td>" + html_number(s.min, row.decimals) + "\u2013" +
            html_number(s.max, row.decimals) + "</td><td>" + std::to_string(s.count) + "</td></tr>";
  }
  html += "</tbody></table></section>";
}

/// Accepted, not accepted after a number of attempts, or never tried.
std::string verdict_on(const json& level) {
  const json attempts = level.value("attempts", json());
  const bool tried = attempts.is_number() && attempts.get<double>() > 0.0;
  const json accepted = level.value("accepted", json());
  if (!tried) {
    return "<span>not reached</span>";
  }
  return std::string(accepted == true ? "<span class=good>accepted</span>"
                                      : "<span class=bad>refused</span>") +
         " <small>attempt " + figure(level, "attempts", 0) + "</small>";
}

void table_of_levels(const json& report, std::string& html) {
  html +=
      "<section><h2>Levels and screws</h2><table><thead><tr><th>level</th><th>registration</th>"
      "<th>RMSE <small>mm</small></th><th>TRE at the screws <small>mm</small></th>"
      "<th>predicted <small>mm</small></th><th>points</th><th>time <small>s</small></th>"
      "<th>screw</th><th>angle error <small>\u00b0</small></th>"
      "<th>entry error <small>mm</small></th><th>wire as placed</th></tr></thead><tbody>";
  for (const json& level : report["levels"]) {
    const json screws = level.value("screws", json::array());
    const std::size_t rows = std::max<std::size_t>(1, screws.size());
    for (std::size_t i = 0; i < rows; ++i) {
      html += "<tr>";
      if (i == 0) {
        const std::string span = "<td rowspan=" + std::to_string(rows) + ">";
        html += span + html_escaped(text_of(level, "label")) + "</td>" + span + verdict_on(level) +
                "</td>" + span + figure(level, "rmse_mm", 2) + "</td>" + span +
                figure(level, "tre_mm", 2) + "</td>" + span + figure(level, "predicted_tre_mm", 2) +
                (level.value("registration_only", false) ? kRegistrationOnlyHtml : "") + "</td>" +
                span + figure(level, "points", 0) + "</td>" + span +
                figure(level, "digitization_s", 1) + "</td>";
      }
      if (i < screws.size()) {
        html += "<td>" + html_escaped(text_of(screws[i], "side")) + "</td><td>" +
                figure(screws[i], "angle_error_deg", 2) + "</td><td>" +
                figure(screws[i], "entry_error_mm", 2) + "</td><td>" + wire_as_placed(screws[i]) +
                "</td>";
      } else {
        html += "<td>\u2013</td><td>\u2013</td><td>\u2013</td><td>\u2013</td>";
      }
      html += "</tr>";
    }
  }
  html += "</tbody></table></section>";
}

void rod_and_frames(const json& report, std::string& html) {
  html += "<section class=pair><div><h2>Rod template</h2>";
  if (const json rod = report.value("rod", json::object()); !rod.empty()) {
    html += "<p>Length <b>" + figure(rod, "length_mm", 1) + " mm</b>, length error " +
            figure(rod, "length_error_mm", 2) + " mm, error of the heads " +
            figure(rod, "head_error_mm", 2) + " mm.</p>";
  } else {
    html += "<p>No rod was templated.</p>";
  }
  html += "</div><div><h2>Frames</h2>";
  const json frames = report.value("frames", json::object());
  html += "<p>" + figure(frames, "displayed", 0) + " displayed, " + figure(frames, "median_ms", 1) +
          " ms apart (median), " + figure(frames, "p99_ms", 1) +
          " ms (99th percentile), on the headset's clock.</p></div></section>";
}

void pictures_and_video(const ReportContent& content, std::string& html) {
  if (!content.video.empty()) {
    html += "<section><h2>The surgeon's view</h2><video controls preload=metadata src=\"" +
            html_escaped(content.video) + "\"></video></section>";
  }
  if (content.pictures.empty()) {
    return;
  }
  html += "<section><h2>Step by step</h2><div class=gallery>";
  for (const ReportPicture& picture : content.pictures) {
    html += "<figure><img alt=\"" + html_escaped(picture.title) +
            "\" src=\"data:image/png;base64," + base64(picture.png) + "\"><figcaption><b>" +
            html_escaped(picture.title) + "</b> " + html_escaped(picture.caption) +
            "</figcaption></figure>";
  }
  html += "</div></section>";
}

json curve_json(const ReportCurve& curve) {
  json points = json::array();
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    points.push_back({{"x", curve.x[i]}, {"y", curve.y[i]}});
  }
  return {{"name", curve.name}, {"points", std::move(points)}};
}

/// Wall time over the run: at most a thousand points per curve, each the slowest frame of its bin,
/// so that no hitch is hidden.
ReportPlot timing_plot(const std::vector<ReportTiming>& timings) {
  ReportPlot plot{"Cost of each frame on this machine", "frame", "ms of wall time", {}, 0.0};
  for (const ReportTiming& timing : timings) {
    ReportCurve curve{timing.name, {}, {}};
    const std::size_t bin = std::max<std::size_t>(1, timing.ms.size() / 1000);
    for (std::size_t i = 0; i < timing.ms.size(); i += bin) {
      const auto last =
          timing.ms.begin() + static_cast<std::ptrdiff_t>(std::min(i + bin, timing.ms.size()));
      curve.x.push_back(static_cast<double>(i));
      curve.y.push_back(
          *std::max_element(timing.ms.begin() + static_cast<std::ptrdiff_t>(i), last));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

void timing_table(const std::vector<ReportTiming>& timings, std::string& html) {
  html +=
      "<section><h2>Frame timing</h2><table><thead><tr><th></th><th>median "
      "<small>ms</small></th><th>99 % <small>ms</small></th><th>n</th></tr></thead><tbody>";
  for (const ReportTiming& timing : timings) {
    const auto at = [&timing](double fraction) {
      const auto value = quantile(timing.ms, fraction);
      return value ? html_number(*value, 2) : std::string("\u2013");
    };
    html += "<tr><th scope=row>" + html_escaped(timing.name) + "</th><td>" + at(0.5) + "</td><td>" +
            at(0.99) + "</td><td>" + std::to_string(timing.ms.size()) + "</td></tr>";
  }
  html += "</tbody></table></section>";
}

json plots_json(const ReportContent& content) {
  std::vector<ReportPlot> plots = content.plots;
  if (!content.timings.empty()) {
    plots.push_back(timing_plot(content.timings));
  }
  json out = json::array();
  for (const ReportPlot& plot : plots) {
    json curves = json::array();
    for (const ReportCurve& curve : plot.curves) {
      curves.push_back(curve_json(curve));
    }
    out.push_back({{"title", plot.title},
                   {"x", plot.x_axis},
                   {"y", plot.y_axis},
                   {"limit", plot.limit},
                   {"curves", std::move(curves)}});
  }
  return out;
}

/// What the page's script draws as bars: every screw with its errors, beside the published rows.
json error_bars(const json& report) {
  json rows = json::array();
  for (const PaperRow& row : kPaperTable) {
    if (row.per_screw) {
      rows.push_back({{"name", row.name},
                      {"unit", row.unit},
                      {"key", row.key},
                      {"mean", row.mean},
                      {"sd", row.sd}});
    }
  }
  json screws = json::array();
  for (const json& level : report["levels"]) {
    for (json screw : level.value("screws", json::array())) {
      if (!screw.contains("angle_error_deg")) {
        continue;
      }
      screw["name"] = text_of(level, "label") + " " + text_of(screw, "side");
      screws.push_back(std::move(screw));
    }
  }
  return {{"rows", std::move(rows)}, {"screws", std::move(screws)}};
}

/// The page up to its first section.
std::string head(const json& report) {
  return "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: operation "
         "report</title><meta name=viewport content=\"width=device-width\"><style>" +
         std::string(embedded::report_css()) +
         "</style></head><body><header><h1>orthonav <span>operation report</span></h1><p>Case <b>" +
         html_escaped(text_of(report, "case")) + "</b>, method <b>" +
         html_escaped(text_of(report, "method")) + "</b>, seed <b>" + figure(report, "seed", 0) +
         "</b>, relative to <b>" +
         (report.value("patient_reference", json()) == true ? "the patient reference"
                                                            : "the headset\u2019s map") +
         "</b></p></header><main>";
}

void add_notes(const json& report, const std::vector<std::string>& notes, std::string& html) {
  html += "<ul class=notes>";
  if (const std::string why = text_of(report, "why_not"); !why.empty()) {
    html += "<li><b>Operation incomplete</b>: " + html_escaped(why) + "</li>";
  }
  for (const std::string& note : notes) {
    html += "<li>" + html_escaped(note) + "</li>";
  }
  html += "</ul>";
}

/// What is plotted, and the scripts that plot it.
std::string scripts(const json& report, const ReportContent& content) {
  std::string html = "<script type=\"application/json\" id=plot-data>" +
                     script_json(plots_json(content)) +
                     "</script><script type=\"application/json\" id=error-data>" +
                     script_json(error_bars(report)) + "</script><script>";
  return html.append(embedded::chart_js())
      .append("</script><script>")
      .append(embedded::report_js())
      .append("</script>");
}

}  // namespace

Result<std::string> report_html(const ReportContent& content) {
  const json report = json::parse(content.report_json, nullptr, false);
  if (report.is_discarded() || !report.is_object() || !report.contains("levels") ||
      !report["levels"].is_array()) {
    return Error{"report: the figures are no report of this program (\"levels\" is missing)"};
  }
  std::string html = head(report);
  table_against_paper(report, html);
  add_notes(report, content.notes, html);
  table_of_levels(report, html);
  html += clearance_section(report) + tracked_section(report);
  for (const RegisteredLevel& level : content.registrations) {
    const auto section = registration_section(level);
    if (!section) {
      return section;
    }
    html += *section;
  }
  html += "<section id=plots><h2>Errors and readings</h2><div class=plots></div></section>";
  rod_and_frames(report, html);
  pictures_and_video(content, html);
  if (!content.timings.empty()) {
    timing_table(content.timings, html);
  }
  html += "</main>" + scripts(report, content) + "</body></html>\n";
  return html;
}

}  // namespace orthonav::engine
