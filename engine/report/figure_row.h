#pragma once

#include <string>

namespace orthonav::engine {

enum class Bound { kNone, kAtMost, kAtLeast };

/// A figure of a registration beside its limit, both in the unit shown.
struct JudgedFigure {
  double value = 0.0;
  int decimals = 2;
  Bound bound = Bound::kNone;
  double limit = 0.0;
  int limit_decimals = 1;

  /// False for what is not a number, too.
  [[nodiscard]] bool keeps_limit() const;
};

/// The figure's own cell: a tick where it keeps its limit; a cross and "over the limit" or "below
/// the limit" where it does not, with the decimals that tell it from the limit. Colour follows.
[[nodiscard]] std::string judged_cell(const JudgedFigure& figure);
/// For tables of many columns: the cross without the words.
[[nodiscard]] std::string narrow_judged_cell(const JudgedFigure& figure);
/// The same of a text that is judged already.
[[nodiscard]] std::string judged_cell(const std::string& text, Bound bound, bool keeps_limit);

/// A row of a table: name, figure, limit, meaning. The name may hold HTML.
[[nodiscard]] std::string figure_row(const std::string& name, const JudgedFigure& figure,
                                     const std::string& meaning);
[[nodiscard]] std::string figure_row(const std::string& name, const std::string& cell,
                                     const std::string& limit, const std::string& meaning);
/// "≤ 2.0"; empty where there is none.
[[nodiscard]] std::string limit_text(const JudgedFigure& figure);

}  // namespace orthonav::engine
