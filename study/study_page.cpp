#include "study/study_page.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "base/how_many.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_values.h"
#include "study/study_page_frame.h"
#include "study/study_statistics.h"

namespace orthonav::engine {
namespace {

constexpr std::array<ReportQuantity, 5> kShown = {{
    {"Trajectory error", "°", "angle_error_deg", true},
    {"Entry point error", "mm", "entry_error_mm", true},
    {"Error at the screws (TRE)", "mm", "tre_mm", false},
    {"The same, predicted", "mm", "predicted_tre_mm", false},
    {"Registration RMSE", "mm", "rmse_mm", false},
}};
constexpr std::size_t kWorst = 10;

/// One screw of an operation, for the list of the worst.
struct WorstScrew {
  std::string place;
  std::string case_name;
  std::uint64_t seed = 0;
  double angle_deg = 0.0;
  std::optional<double> entry_mm;
};

std::vector<WorstScrew> screws_of(const nlohmann::json& study) {
  std::vector<WorstScrew> screws;
  for (const auto& run : study["runs"]) {
    for (const auto& level : run["levels"]) {
      for (const auto& screw : level.value("screws", nlohmann::json::array())) {
        const auto angle_deg = value_of(screw, "angle_error_deg");
        if (!angle_deg) {
          continue;
        }
        screws.push_back({level.value("label", "") + " " + screw.value("side", ""),
                          run.value("case", ""), run.value("seed", std::uint64_t{0}), *angle_deg,
                          value_of(screw, "entry_error_mm")});
      }
    }
  }
  return screws;
}

std::string plain_number(double value) { return html_number(value, 2); }

void add_means(const nlohmann::json& study, std::string& html) {
  HtmlTable table({{""}, {"mean ± SD"}, {"95 % interval of the mean"}, {"n"}, {"operations"}});
  for (const ReportQuantity& shown : kShown) {
    const auto mean = mean_over(study, shown.key, shown.per_screw);
    if (!mean) {
      continue;
    }
    table.row(std::string(shown.name) + " <small>" + std::string(shown.unit) + "</small>");
    table.cell(html_number(mean->mean, 2) + " ± " + html_number(mean->sd, 2));
    table.cell(interval_html(mean_interval(mean->mean, mean->standard_error, mean->operations),
                             plain_number));
    table.cell(std::to_string(mean->values));
    table.cell(std::to_string(mean->operations));
  }
  html +=
      "<section><h2>Means</h2>" + table.html() +
      "<p class=notes>The screws of one operation share errors: intervals are from the means of "
      "operations, by Student's t.</p></section>";
}

void add_registrations(const nlohmann::json& study, std::string& html) {
  if (!study.contains("registrations")) {
    return;
  }
  const auto& quality = study["registrations"];
  const auto& silent = quality["silent_failures"];
  html += "<section><h2>Accepted registrations</h2><p>" +
          html_number(100.0 * quality["coverage"]["68"].get<double>(), 0) + " % of " +
          std::to_string(quality["coverage"]["places"].get<int>()) +
          " entries and targets lie where 68 % were predicted, " +
          html_number(100.0 * quality["coverage"]["95"].get<double>(), 0) +
          " % where 95 % were. More than 2 mm off at a screw: " +
          std::to_string(silent["n"].get<int>()) + " of " +
          how_many(silent["of"].get<int>(), "level") + ", with 95 % certainty at most " +
          html_number(100.0 * silent["upper_95"].get<double>(), 1) + " %.</p></section>";
}

/// The guide as shown when the wires pierced the bone, against its true pose.
void add_guided(const nlohmann::json& study, std::string& html) {
  if (!study.contains("guided")) {
    return;
  }
  const auto& guided = study["guided"];
  const auto count_of = [](const nlohmann::json& counted) {
    return std::to_string(counted["n"].get<int>()) + " of " +
           how_many(counted["of"].get<int>(), "screw") + ", with 95 % certainty at most " +
           html_number(100.0 * counted["upper_95"].get<double>(), 1) + " %";
  };
  html +=
      "<section><h2>As the guide was shown</h2><p>When the wires pierced the bone, tip and "
      "axis were shown " +
      html_number(guided["across_mm"]["mean"].get<double>(), 2) +
      " mm off across the plan (95 % within " +
      html_number(guided["across_mm"]["p95"].get<double>(), 2) + " mm) and " +
      html_number(guided["angle_deg"]["mean"].get<double>(), 2) +
      "° off. More than 2 mm, shown as sure and without a warning: " +
      count_of(guided["silent_failures"]) +
      "; shown as unsure: " + count_of(guided["shown_unsure"]) + ". Breaches of the cortex: " +
      std::to_string(guided["unwarned_breaches"]["breaches"].get<int>()) +
      ", without a warning: " + count_of(guided["unwarned_breaches"]) + ".</p></section>";
}

TableColumn to_repeat() { return {"to repeat it", "", true}; }

/// A command with line breaks only before its options, so that it reads well and is copied whole.
std::string command_html(const std::string& command) {
  std::string html = "<code>";
  std::size_t from = 0;
  for (std::size_t next = 0; next != std::string::npos; from = next + 1) {
    next = command.find(" --", from);
    html += "<span>" + html_escaped(command.substr(from, next - from)) +
            (next == std::string::npos ? "</span>" : "</span> ");
  }
  return html + "</code>";
}

/// In the preview, on the phantom.
ReplayCommand preview_of(const std::string& method) {
  return [method](const std::string& /*case_name*/, std::uint64_t seed) {
    return "orthonav preview --replay " + std::to_string(seed) +
           (method == "stated" ? "" : " --method " + method);
  };
}

void add_worst(std::vector<WorstScrew> screws, const ReplayCommand& replay, std::string& html) {
  std::stable_sort(screws.begin(), screws.end(), [](const WorstScrew& a, const WorstScrew& b) {
    return a.angle_deg > b.angle_deg;
  });
  screws.resize(std::min(screws.size(), kWorst));
  HtmlTable table({{""}, {"seed"}, {"angle", "°"}, {"entry", "mm"}, to_repeat()});
  for (const WorstScrew& screw : screws) {
    table.row(html_escaped(screw.case_name + ", " + screw.place));
    table.cell(std::to_string(screw.seed));
    table.cell(html_number(screw.angle_deg, 2));
    table.cell(screw.entry_mm ? html_number(*screw.entry_mm, 2) : "–");
    table.cell(command_html(replay(screw.case_name, screw.seed)), "again");
  }
  html += "<section><h2>The worst screws</h2>" + table.html() + "</section>";
}

void add_not_completed(const nlohmann::json& study, const ReplayCommand& replay,
                       std::string& html) {
  std::size_t count = 0;
  HtmlTable table({{""}, {"seed"}, {"why", "", true}, to_repeat()});
  for (const auto& run : study["runs"]) {
    if (run.value("completed", true) || ++count > kWorst) {
      continue;
    }
    const std::string name = run.value("case", "");
    const auto seed = run.value("seed", std::uint64_t{0});
    table.row(html_escaped(name));
    table.cell(std::to_string(seed));
    table.cell(html_escaped(run.value("why_not", "")));
    table.cell(command_html(replay(name, seed)), "again");
  }
  if (count == 0) {
    return;
  }
  html += "<section><h2>Not completed</h2>" + table.html();
  if (count > kWorst) {
    html += "<p class=notes>The first " + std::to_string(kWorst) + " of " + std::to_string(count) +
            ".</p>";
  }
  html += "</section>";
}

nlohmann::json histograms_of(const std::vector<WorstScrew>& screws) {
  nlohmann::json angles = nlohmann::json::array();
  nlohmann::json entries = nlohmann::json::array();
  for (const WorstScrew& screw : screws) {
    angles.push_back(screw.angle_deg);
    if (screw.entry_mm) {
      entries.push_back(*screw.entry_mm);
    }
  }
  return {{{"title", "Trajectory error"},
           {"axis", "degrees, from"},
           {"values", angles},
           {"step", 0.5},
           {"of", "screws"}},
          {{"title", "Entry point error"},
           {"axis", "mm, from"},
           {"values", entries},
           {"step", 0.5},
           {"of", "screws"}}};
}

}  // namespace

std::string study_html(const std::string& text, const ReplayCommand& replay) {
  const nlohmann::json study = nlohmann::json::parse(text, nullptr, false);
  StudyPage page{"study", "", ""};
  if (!study.is_object() || !study.contains("runs")) {
    page.body = "<p>This is not a study.</p>";
    return framed(page, nlohmann::json::object());
  }
  const std::string method = study.value("method", "");
  const ReplayCommand again = replay ? replay : preview_of(method);
  page.intro = "Method <b>" + html_escaped(method) +
               "</b>: " + std::to_string(study.value("operations", 0)) + " simulated operations, " +
               std::to_string(study.value("completed", 0)) + " of them completed.";
  add_means(study, page.body);
  add_registrations(study, page.body);
  add_guided(study, page.body);
  page.body += "<section><h2>How the errors spread</h2><div class=plots></div></section>";
  const std::vector<WorstScrew> screws = screws_of(study);
  add_worst(screws, again, page.body);
  add_not_completed(study, again, page.body);
  return framed(page, {{"histograms", histograms_of(screws)}});
}

}  // namespace orthonav::engine
