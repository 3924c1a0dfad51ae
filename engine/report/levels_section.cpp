#include "engine/report/levels_section.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_values.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

/// Accepted, not accepted after a number of attempts, or never tried.
std::string verdict_on(const json& level) {
  if (value_of(level, "attempts").value_or(0.0) <= 0.0) {
    return "<span>not registered</span>";
  }
  return std::string(is_true(level, "accepted") ? "<span class=good>accepted</span>"
                                                : "<span class=bad>refused</span>") +
         " <small>attempt " + figure(level, "attempts", 0) + "</small>";
}

/// How the rod was to be cut and bent, and where its seats were taken to lie; or why nothing says
/// so.
std::string instructions_of(const json& rod) {
  if (const std::string why = text_in(rod, "no_instructions"); !why.empty()) {
    return "<p class=notes>No instructions to bend it: " + html_escaped(why) + ".</p>";
  }
  if (!value_of(rod, "cut_length_mm")) {
    return "";
  }
  HtmlTable table({{"bend"},
                   {"place from its first end", "mm"},
                   {"roll", "\u00b0"},
                   {"set", "\u00b0"},
                   {"to remain", "\u00b0"}});
  std::size_t number = 0;
  for (const json& bend : rod.value("instructions", json::array())) {
    table.row(std::to_string(++number));
    table.cell(figure(bend, "arc_length_mm", 1));
    table.cell(figure(bend, "roll_deg", 0));
    table.cell(figure(bend, "set_deg", 1));
    table.cell(figure(bend, "angle_deg", 1));
  }
  std::string html = "<p>Cut to <b>" + figure(rod, "cut_length_mm", 1) + " mm</b>, " +
                     how_many(number, "bend") + ".</p>" + (table.empty() ? "" : table.html());
  if (const auto seat_mm = value_of(rod, "seat_by_pointer_mm")) {
    html += "<p class=notes>The middle of the rod is taken to lie " +
            html_number(std::abs(*seat_mm), 1) + (*seat_mm < 0.0 ? " mm above" : " mm below") +
            " the touched places, square to the rod at each head. Down is where the pointer "
            "pointed, since no registered screw tells it.</p>";
  }
  return html;
}

}  // namespace

std::string levels_section(const json& report) {
  HtmlTable table({{"level"},
                   {"registration"},
                   {"RMSE", "mm"},
                   {"error to expect at the screws", "mm"},
                   {"true error at the screws", "mm"},
                   {"points"},
                   {"time", "s"}});
  for (const json& level : report["levels"]) {
    const bool tried = value_of(level, "attempts").value_or(0.0) > 0.0;
    const auto cell = [&](const char* key, int decimals, const char* note = "") {
      table.cell(tried ? figure(level, key, decimals) + note : "");
    };
    table.row(html_escaped(text_in(level, "label")));
    table.cell(verdict_on(level));
    cell("rmse_mm", 2);
    cell("predicted_tre_mm", 2, is_true(level, "registration_only") ? kRegistrationOnlyHtml : "");
    cell("tre_mm", 2);
    cell("points", 0);
    cell("digitization_s", 1);
  }
  return table.empty() ? ""
                       : "<section id=levels><h2>Registration</h2>" + table.html() +
                             "<p class=notes>To expect: root mean square at the worst entry "
                             "or target, as the registration says. True: mean over entries "
                             "and targets, against the simulation\u2019s truth. RMSE is of "
                             "the points and a poor indicator of either.</p></section>";
}

std::string rods_section(const json& report) {
  std::string rods;
  const json& first = object_in(report, "rod");
  for (const json& rod : first.value("sides", json::array({first}))) {
    const auto put = [&rods, &rod](const char* what, const char* key, int decimals) {
      if (value_of(rod, key)) {
        rods += what + figure(rod, key, decimals) + " mm";
      }
    };
    const auto heads = value_of(rod, "heads");
    if (!value_of(rod, "length_mm") && heads.value_or(0.0) <= 0.0) {
      continue;
    }
    rods += "<p>" + html_escaped(text_in(rod, "side")) + ": ";
    if (value_of(rod, "length_mm")) {
      rods += "length <b>" + figure(rod, "length_mm", 1) + " mm</b>";
    } else {
      rods += "no template";
    }
    if (heads) {
      rods += ", heads touched " + figure(rod, "heads", 0);
    }
    put(", length error ", "length_error_mm", 2);
    put(", error of the heads ", "head_error_mm", 2);
    if (value_of(rod, "time_s")) {
      rods += ", in " + figure(rod, "time_s", 0) + " s";
    }
    rods += ".</p>" + instructions_of(rod);
  }
  return "<section id=rods><h2>Rods</h2>" + (rods.empty() ? "<p>No rod was templated.</p>" : rods) +
         "</section>";
}

}  // namespace orthonav::engine
