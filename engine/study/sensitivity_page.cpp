#include "engine/study/sensitivity_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/study/study_page_frame.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kMostBars = 20;

void add_effects(const std::vector<Sensitivity>& found, std::string& html) {
  HtmlTable table({{"magnitude"}, {"range"}, {"entry", "mm"}, {"angle", "°"}});
  for (const Sensitivity& s : found) {
    table.row("<code>" + html_escaped(s.magnitude) + "</code>");
    table.cell(formatted("%g to %g ", s.low, s.high) + html_escaped(s.unit));
    table.cell(html_number(s.entry_mm, 2) + " ± " + html_number(s.entry_spread_mm, 2));
    table.cell(html_number(s.angle_deg, 2) + " ± " + html_number(s.angle_spread_deg, 2));
  }
  html += "<section><h2>All of them</h2>" + table.html() + "</section>";
}

nlohmann::json bars_of(const std::vector<Sensitivity>& found, const char* title, const char* axis,
                       double Sensitivity::*size, double Sensitivity::*sd) {
  nlohmann::json bars{{"title", title},
                      {"axis", axis},
                      {"names", nlohmann::json::array()},
                      {"values", nlohmann::json::array()},
                      {"sds", nlohmann::json::array()}};
  for (std::size_t i = 0; i < std::min(found.size(), kMostBars); ++i) {
    bars["names"].push_back(found[i].magnitude);
    bars["values"].push_back(found[i].*size);
    bars["sds"].push_back(found[i].*sd);
  }
  return bars;
}

}  // namespace

std::string sensitivity_html(const std::vector<Sensitivity>& found,
                             const SensitivityOptions& options) {
  StudyPage page{"sensitivity", "", ""};
  page.intro =
      "How far a magnitude of the simulated room moves a screw's mean error when it goes through "
      "its range: " +
      (options.points > 0
           ? std::to_string(options.points) +
                 " operations, one at each random place of all ranges, regressed."
           : std::to_string(options.trajectories) + " trajectories (Morris's method), " +
                 std::to_string(options.runs) + " operations at each point.");
  const std::size_t bars = std::min(found.size(), kMostBars);
  page.body = "<section><h2>What decides</h2><div class=plots></div><p class=notes>The " +
              std::to_string(bars) + " of " + std::to_string(found.size()) +
              " magnitudes that move entry and angle most. " +
              (options.points > 0
                   ? "Bars: the change of the mean error over the range. Whiskers: its 95 % "
                     "interval."
                   : "Bars: μ*, the mean of the absolute "
                     "effects. Whiskers: ± SD of the effects, large where a magnitude acts with "
                     "others or not in proportion; a whisker as long as its bar says that more "
                     "trajectories are needed, or that the effect changes its sign.") +
              "</p></section>";
  add_effects(found, page.body);
  return framed(page, {{"bars",
                        {bars_of(found, "Entry point error", "mm", &Sensitivity::entry_mm,
                                 &Sensitivity::entry_spread_mm),
                         bars_of(found, "Trajectory error", "degrees", &Sensitivity::angle_deg,
                                 &Sensitivity::angle_spread_deg)}}});
}

}  // namespace orthonav::engine
