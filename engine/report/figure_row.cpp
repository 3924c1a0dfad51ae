#include "engine/report/figure_row.h"

#include "engine/report/html_text.h"

namespace orthonav::engine {

bool JudgedFigure::keeps_limit() const {
  switch (bound) {
    case Bound::kNone:
      return true;
    case Bound::kAtMost:
      return value <= limit;
    case Bound::kAtLeast:
      return value >= limit;
  }
  return false;
}

namespace {

/// With as many decimals as distinguish it from the limit.
std::string text_of_figure(const JudgedFigure& figure) {
  return figure.bound == Bound::kNone
             ? html_number(figure.value, figure.decimals)
             : html_number_beside(figure.value, figure.limit, figure.decimals);
}

}  // namespace

std::string judged_cell(const JudgedFigure& figure) {
  return judged_cell(text_of_figure(figure), figure.bound, figure.keeps_limit());
}

std::string judged_cell(const std::string& text, Bound bound, bool keeps_limit) {
  if (bound == Bound::kNone) {
    return "<td>" + text + "</td>";
  }
  if (keeps_limit) {
    return "<td class=good>" + text + " ✓</td>";
  }
  return "<td class=bad>" + text + " ✗ <b>" +
         (bound == Bound::kAtMost ? "over the limit" : "below the limit") + "</b></td>";
}

std::string limit_text(const JudgedFigure& figure) {
  if (figure.bound == Bound::kNone) {
    return {};
  }
  return (figure.bound == Bound::kAtMost ? "≤ " : "≥ ") +
         html_number(figure.limit, figure.limit_decimals);
}

std::string figure_row(const std::string& name, const JudgedFigure& figure,
                       const std::string& meaning) {
  return figure_row(name, judged_cell(figure), limit_text(figure), meaning);
}

std::string figure_row(const std::string& name, const std::string& cell, const std::string& limit,
                       const std::string& meaning) {
  return "<tr><th scope=row>" + name + "</th>" + cell + "<td>" + limit + "</td><td class=why>" +
         meaning + "</td></tr>";
}

}  // namespace orthonav::engine
