#include "engine/report/report_html.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "embedded/report_js.h"
#include "engine/report/clearance_section.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/levels_section.h"
#include "engine/report/operation_result.h"
#include "engine/report/page_style.h"
#include "engine/report/paper_section.h"
#include "engine/report/paper_table.h"
#include "engine/report/pictures_section.h"
#include "engine/report/registration_page.h"
#include "engine/report/report_values.h"
#include "engine/report/screws_section.h"
#include "engine/report/script_json.h"
#include "engine/report/tracked_section.h"
#include "engine/report/verdict.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

/// Values above the axis are drawn at its edge, and their true values are kept.
json curve_json(const ReportCurve& curve, double y_max) {
  json points = json::array();
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (y_max > 0.0 && curve.y[i] > y_max) {
      points.push_back({{"x", curve.x[i]}, {"y", y_max}, {"was", curve.y[i]}});
    } else {
      points.push_back({{"x", curve.x[i]}, {"y", curve.y[i]}});
    }
  }
  return {{"name", curve.name}, {"points", std::move(points)}};
}

/// For each plot that cuts something off: what, and how far up it went.
std::string cut_off_text(const std::vector<ReportPlot>& plots) {
  std::string html;
  for (const ReportPlot& plot : plots) {
    std::string curves;
    for (const ReportCurve& curve : plot.curves) {
      const auto most = std::max_element(curve.y.begin(), curve.y.end());
      if (plot.y_max > 0.0 && most != curve.y.end() && *most > plot.y_max) {
        curves += (curves.empty() ? "" : ", ") + html_escaped(curve.name) + " up to " +
                  html_number(*most, 1) + (plot.y_axis == "\u00b0" ? "" : " ") +
                  html_escaped(plot.y_axis);
      }
    }
    if (!curves.empty()) {
      html += "<p class=notes>" + html_escaped(plot.title) +
              ": above the axis (triangles at its "
              "edge) " +
              curves + ".</p>";
    }
  }
  return html;
}

std::string timing_section(const json& report, const std::vector<ReportTiming>& timings) {
  const json& frames = object_in(report, "frames");
  std::string html =
      "<section id=timing><h2>Frame timing</h2><p>" + figure(frames, "displayed", 0) +
      " frames displayed, " + figure(frames, "median_ms", 1) + " ms apart (median), " +
      figure(frames, "p99_ms", 1) + " ms (99th percentile), on the headset\u2019s clock.</p>";
  HtmlTable table(
      {{"on this machine"}, {"median", "ms"}, {"99 %", "ms"}, {"slowest", "ms"}, {"n"}});
  for (const ReportTiming& timing : timings) {
    const auto at = [&timing](double fraction) {
      const auto value = timing.ms.quantile(fraction);
      return value ? html_number(*value, 2) : std::string(kNoValue);
    };
    table.row(html_escaped(timing.name));
    table.cell(at(0.5));
    table.cell(at(0.99));
    table.cell(at(1.0));
    table.cell(std::to_string(timing.ms.count()));
  }
  return html + (table.empty() ? "" : table.html()) + "</section>";
}

json plot_json(const ReportPlot& plot, const char* place) {
  json curves = json::array();
  for (const ReportCurve& curve : plot.curves) {
    curves.push_back(curve_json(curve, plot.y_max));
  }
  json lines = json::array();
  for (const ReportLine& line : plot.lines) {
    lines.push_back({{"y", line.y}, {"name", line.name}});
  }
  return {{"place", place},
          {"title", plot.title},
          {"x", plot.x_axis},
          {"y", plot.y_axis},
          {"y_max", plot.y_max},
          {"lines", std::move(lines)},
          {"curves", std::move(curves)}};
}

/// Each plot with the id of its element.
json plots_json(const ReportContent& content) {
  json out = json::array();
  for (const ReportPlot& plot : content.plots) {
    out.push_back(plot_json(plot, "reading-plots"));
  }
  return out;
}

/// The bars that the page's script draws: every screw with its errors, beside the published rows.
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
  for_each_screw(report, [&](const json&, const std::string& name, const json& screw) {
    if (has_truth(screw)) {
      screws.push_back(screw);
      screws.back()["name"] = name;
    }
  });
  return {{"rows", std::move(rows)}, {"screws", std::move(screws)}};
}

/// The page up to its first section.
std::string head(const json& report, const std::string& date) {
  const auto fact = [](const char* name, const std::string& value) {
    return "<span>" + std::string(name) + " <b>" + html_escaped(value) + "</b></span> ";
  };
  const bool patient = is_true(report, "patient_reference");
  return "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: operation "
         "report</title><meta name=viewport content=\"width=device-width, "
         "initial-scale=1\"><style>" +
         std::string(page_style()) +
         "</style></head><body><header><h1>orthonav <span>operation report</span></h1><p "
         "class=facts>" +
         fact("date", date.empty() ? "not recorded" : date) +
         fact("case", text_in(report, "case")) + fact("method", text_in(report, "method")) +
         (report.contains("seed") ? fact("simulated, seed", figure(report, "seed", 0)) : "") +
         fact("relative to", patient ? "the patient reference" : "the headset\u2019s map") +
         "</p></header><main>";
}

std::string notes_section(const std::vector<std::string>& notes) {
  std::string html = "<section id=notes><h2>Notes</h2><ul class=notes>";
  for (const std::string& note : notes) {
    html += "<li>" + html_escaped(note) + "</li>";
  }
  return notes.empty() ? "" : html + "</ul></section>";
}

/// Of screws alone.
std::string plots_section(const json& report, const ReportContent& content) {
  return is_of_rods_alone(report)
             ? ""
             : "<section id=plots><h2>Errors and readings</h2><div class=plots "
               "id=error-plots></div><div class=plots id=reading-plots></div>" +
                   cut_off_text(content.plots) + "</section>";
}

/// The data of the plots, and the scripts that draw them.
std::string scripts(const json& report, const ReportContent& content) {
  std::string html = "<script type=\"application/json\" id=plot-data>" +
                     script_json(plots_json(content)) +
                     "</script><script type=\"application/json\" id=error-data>" +
                     script_json(error_bars(report)) + "</script><script>";
  return html.append(plotting_script())
      .append("</script><script>")
      .append(embedded::report_js())
      .append("</script>");
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

/// Sections of which only the headings show until they are opened.
std::string folded(std::string sections) {
  replace_all(sections, "<section", "<details");
  replace_all(sections, "</section>", "</details>");
  replace_all(sections, "<h2>", "<summary><h2>");
  replace_all(sections, "</h2>", "</h2></summary>");
  return sections;
}

}  // namespace

Result<std::string> report_html(const ReportContent& content) {
  const json report = json::parse(content.report_json, nullptr, false);
  if (report.is_discarded() || !report.is_object() || !report.contains("levels") ||
      !report["levels"].is_array()) {
    return Error{"report: the figures are not a report of this program (\"levels\" is missing)"};
  }
  const auto registrations = registration_sections(content.registrations);
  if (!registrations) {
    return registrations;
  }
  const std::string rods = rods_section(report);
  return head(report, content.date) + verdict_section(report) + film_section(content) +
         content.spine.section("The spine with its screws", html_escaped(content.spine_note)) +
         screws_section(report) + (is_of_rods_alone(report) ? rods : "") +
         folded(clearance_section(report) + levels_section(report) + *registrations +
                (is_of_rods_alone(report) ? "" : rods) + pictures_section(content) +
                paper_section(report, json::parse(content.beside_json, nullptr, false),
                              content.beside_page) +
                plots_section(report, content) + tracked_section(report) +
                timing_section(report, content.timings) + notes_section(content.notes)) +
         "</main>" + scripts(report, content) + "</body></html>\n";
}

}  // namespace orthonav::engine
