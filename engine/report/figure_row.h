#pragma once

#include <string>

namespace orthonav::engine {

enum class Bound { kNone, kAtMost, kAtLeast };

/// A figure of a registration with its limit, both in the displayed unit.
struct JudgedFigure {
  double value = 0.0;
  int decimals = 2;
  Bound bound = Bound::kNone;
  double limit = 0.0;
  int limit_decimals = 1;

  /// Also false for NaN.
  [[nodiscard]] bool keeps_limit() const;
};

/// The figure's cell: a tick if it keeps its limit; otherwise a cross and "over the limit" or
/// "below the limit", with enough decimals to tell it from the limit. The colour matches.
[[nodiscard]] std::string judged_cell(const JudgedFigure& figure);
/// The same for an already judged text.
[[nodiscard]] std::string judged_cell(const std::string& text, Bound bound, bool keeps_limit);

/// A row of a table: name, figure, limit, meaning. The name may hold HTML.
[[nodiscard]] std::string figure_row(const std::string& name, const JudgedFigure& figure,
                                     const std::string& meaning);
[[nodiscard]] std::string figure_row(const std::string& name, const std::string& cell,
                                     const std::string& limit, const std::string& meaning);
/// "≤ 2.0"; empty where there is none.
[[nodiscard]] std::string limit_text(const JudgedFigure& figure);

}  // namespace orthonav::engine
