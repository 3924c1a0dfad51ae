#include "tools/orthonav/evaluate/evaluate_page.h"

#include <array>

#include "base/angle.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/page_style.h"
#include "engine/report/spine_view.h"
#include "tools/orthonav/evaluate/evaluate_figures.h"
#include "tools/orthonav/evaluate/scan_slice.h"

namespace orthonav::tools {
namespace {

using engine::formatted;
using engine::html_escaped;
using engine::html_number;

constexpr const char* kStyle =
    ".slices{display:grid;grid-template-columns:repeat(3,1fr);gap:14px}"
    ".slices svg{width:100%;display:block;background:#000;border-radius:6px}"
    ".slices path,.slices circle{fill:none;stroke-width:.35}"
    ".slices .bone{stroke:#37c26b;stroke-width:.25}"
    ".slices .plan *{stroke:#4cc2ff;stroke-dasharray:1.4 .9}"
    ".slices .placed *{stroke:#ffb000}"
    ".key b{display:inline-block;width:22px;border-top:3px solid;vertical-align:middle;"
    "margin:0 6px 0 14px}";

std::string cell(const std::string& text) { return "<td>" + text + "</td>"; }

std::string with_bound(double value, double sd) {
  return html_number(value, 1) + " <small>±" + html_number(k95 * sd, 1) + "</small>";
}

void put_grade(engine::HtmlTable& table, const engine::ScrewInScan& placed) {
  const std::string grades = grade_text(placed);
  table.cell(grades, grades == nav::name_of(nav::PedicleGrade::kA) ? "good" : "bad");
}

void put_clearance(engine::HtmlTable& table, const engine::ScrewInScan& placed, Side side) {
  if (!placed.clearance) {
    table.cell(kBarelyIn);
    table.cell("–");
    table.cell("–");
    return;
  }
  const double mm = placed.clearance->clearance_m * 1e3;
  table.cell(
      html_number(mm, 1) + " <small>" + nav::direction_of(*placed.clearance, side) + "</small>",
      mm < 0.0 ? "bad" : "");
  table.cell(placed.spread ? html_number(placed.spread->lower_95_m * 1e3, 1) : "–");
  put_grade(table, placed);
}

void put_empty_row(engine::HtmlTable& table, const std::string& name, const std::string& why) {
  table.row(name);
  for (int i = 0; i < 9; ++i) {
    table.cell("–");
  }
  table.below(why, "bad");
}

void put_row(engine::HtmlTable& table, const std::string& label,
             const engine::EvaluatedScrew& screw) {
  const std::string name = html_escaped(label) + " " + name_of(screw.plan.side);
  if (!screw.placed) {
    put_empty_row(table, name, kNotFound);
    return;
  }
  const engine::ScrewInScan& placed = *screw.placed;
  table.row(name);
  table.cell(
      with_bound(placed.angle_rad * kDegreesPerRadian, placed.angle_sd_rad * kDegreesPerRadian));
  table.cell(html_number(placed.entry_m * 1e3, 1));
  table.cell(with_bound(placed.entry_axis_m * 1e3, placed.entry_axis_sd_m * 1e3));
  for (const double value_m : {placed.target_m, placed.depth_m}) {
    table.cell(placed.tip_seen ? html_number(value_m * 1e3, 1) : "–");
  }
  table.cell(html_number(2e3 * placed.measured_radius_m, 1));
  put_clearance(table, placed, screw.plan.side);
  if (placed.touched) {
    table.below(kTouched);
  }
  if (!placed.tip_seen) {
    table.below(kTipNotSeen, "bad");
  }
  if (placed.as_planned_screw) {
    const nav::PedicleGrade grade = nav::grade_of(placed.as_planned_screw->clearance_m);
    table.below("the same axis as a screw of " + html_number(2e3 * screw.plan.radius_m, 1) +
                    " mm: clearance " + html_number(placed.as_planned_screw->clearance_m * 1e3, 1) +
                    " mm, grade " + nav::name_of(grade),
                grade == nav::PedicleGrade::kA ? "" : "bad");
  }
}

std::string table_of(const engine::Evaluation& evaluation) {
  engine::HtmlTable table({{"Screw"},
                           {"Angle", "°"},
                           {"Entry", "mm"},
                           {"Entry (axis)", "mm"},
                           {"Target", "mm"},
                           {"Depth", "mm"},
                           {"Diameter", "mm"},
                           {"Clearance", "mm"},
                           {"95 % above", "mm"},
                           {"Grade"}});
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    if (!level.registration) {
      put_empty_row(table, html_escaped(level.label),
                    "not evaluated: " + html_escaped(level.refusal));
      continue;
    }
    for (const engine::EvaluatedScrew& screw : level.screws) {
      put_row(table, level.label, screw);
    }
  }
  const std::string slices = slices_text(evaluation);
  return "<section><h2>Planned and placed</h2>" + table.html() +
         (slices.empty() ? "" : "<p class=bad>" + html_escaped(slices) + "</p>") +
         "<p class=notes>± and \"95 % above\": of the errors of this measurement alone (axis and "
         "registration to the scan). " +
         html_escaped(engine::kEvaluationDefinitions) + ". " + html_escaped(nav::kPedicleScale) +
         ".</p></section>";
}

struct NamedPlane {
  engine::SlicePlane plane;
  const char* name;
};

/// `across` lies where the screw is nearest to the cortex.
std::array<NamedPlane, 3> planes_of(const nav::ScrewCylinder& cylinder, double arc_length_m) {
  const auto slices =
      engine::slices_of({cylinder.entry, cylinder.direction}, cylinder.length_m, arc_length_m);
  return {{{slices.axial, "along the screw, from below; front is up"},
           {slices.sagittal, "along the screw, from the side; head is up"},
           {slices.across, "across the screw where it is nearest to the cortex, from the front"}}};
}

Result<std::string> figures_of(const engine::ScanField& scan, const nav::TriangleMesh& bone,
                               const engine::BoneRegistration& laid,
                               const engine::EvaluatedScrew& screw) {
  std::vector<DrawnCylinder> drawn;
  if (const auto plan = nav::cylinder_of(screw.plan)) {
    drawn.push_back({*plan, "plan"});
  }
  double arc_length_m = 0.02;
  if (screw.placed) {
    drawn.push_back({screw.placed->cylinder, "placed"});
    arc_length_m = screw.placed->clearance ? screw.placed->clearance->arc_length_m : arc_length_m;
  }
  std::string html = "<div class=slices>";
  if (drawn.empty()) {
    return html + "</div>";
  }
  for (const NamedPlane& named : planes_of(drawn.back().cylinder, arc_length_m)) {
    const auto svg = slice_svg(scan, bone, laid.scan_from_vertebra, named.plane, drawn);
    if (!svg) {
      return svg.error();
    }
    html += "<figure>" + *svg + "<figcaption>" + named.name + "</figcaption></figure>";
  }
  return html + "</div>";
}

Result<std::string> section_of(const engine::ScanField& scan, const nav::TriangleMesh& bone,
                               const engine::EvaluatedLevel& level) {
  std::string html;
  for (const engine::EvaluatedScrew& screw : level.screws) {
    const auto figures = figures_of(scan, bone, *level.registration, screw);
    if (!figures) {
      return figures.error();
    }
    html += "<section><h2>" + html_escaped(level.label) + " " + name_of(screw.plan.side) +
            (screw.placed ? "" : ": <span class=bad>not found</span>") + "</h2>" + *figures +
            "</section>";
  }
  return html;
}

std::string unassigned_of(const engine::Evaluation& evaluation) {
  if (evaluation.unassigned.empty()) {
    return "";
  }
  std::string html = "<section><h2>Metal that is not a planned screw</h2><ul>";
  for (const engine::UnassignedMetal& metal : evaluation.unassigned) {
    html += "<li>" + html_escaped(text_of(metal, evaluation)) + "</li>";
  }
  return html + "</ul></section>";
}

std::string registrations_of(const engine::Evaluation& evaluation) {
  std::string html =
      "<section><h2>Vertebrae laid on the scan</h2><table><thead><tr><th>Level<th>Off the bone "
      "<small>mm, median</small><th>Surface within 1 mm <small>%</small><th>Seen clear of metal "
      "<small>places</small></tr></thead><tbody>";
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    html += "<tr>" + cell(html_escaped(level.label));
    if (level.registration) {
      html += cell(html_number(level.registration->residual_m * 1e3, 2)) +
              cell(html_number(level.registration->coverage * 1e2, 0)) +
              cell(html_number(static_cast<double>(level.registration->edges), 0)) + "</tr>";
    } else {
      html += "<td colspan=3 class=bad>" + html_escaped(level.refusal) + "</td></tr>";
    }
  }
  return html + "</tbody></table></section>";
}

/// The spine as it lay in the scan.
std::string spine_of(const engine::Case& subject, const engine::Evaluation& evaluation) {
  engine::SpineView view;
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    const engine::CaseLevel* const model = subject.find(level.label);
    if (!level.registration || model == nullptr) {
      continue;
    }
    const auto& pose = level.registration->scan_from_vertebra;
    view.add_bone(model->mesh, pose);
    for (const engine::EvaluatedScrew& screw : level.screws) {
      if (const auto plan = nav::cylinder_of(screw.plan)) {
        view.add_planned(*plan, pose);
      }
      if (screw.placed) {
        view.add_placed(screw.placed->cylinder, pose);
      }
    }
  }
  return view.section("As it lies in the scan", "");
}

}  // namespace

Result<std::string> evaluate_page(const engine::Case& subject, const engine::Volume& scan,
                                  const engine::Evaluation& evaluation, const std::string& source) {
  std::string html =
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: evaluation"
      "</title><meta name=viewport content=\"width=device-width, initial-scale=1\"><style>";
  html += engine::page_style();
  html += std::string(kStyle) +
          "</style></head><body><header><h1>orthonav <span>planned and placed screws</span></h1>"
          "<p>Case <b>" +
          html_escaped(subject.name) + "</b>, scan <b>" + html_escaped(source) +
          "</b></p></header><main>" + table_of(evaluation) +
          "<p class=key><b style=\"color:#4cc2ff\"></b>planned<b style=\"color:#ffb000\"></b>placed"
          "<b style=\"color:#37c26b\"></b>surface of the case’s model, laid on the scan</p>" +
          spine_of(subject, evaluation);
  const engine::ScanField field(scan);
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    const engine::CaseLevel* const source_level = subject.find(level.label);
    if (!level.registration || source_level == nullptr) {
      continue;
    }
    const auto section = section_of(field, source_level->mesh, level);
    if (!section) {
      return section;
    }
    html += *section;
  }
  return html + unassigned_of(evaluation) + registrations_of(evaluation) +
         "<ul class=notes><li>Not a medical device.</li></ul></main></body></html>\n";
}

}  // namespace orthonav::tools
