#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/mean_interval.h"

namespace orthonav::engine {

/// A self-contained page about studies, in the style of an operation's report.
struct StudyPage {
  std::string title;  ///< plain text
  std::string intro;  ///< HTML
  std::string body;   ///< HTML: sections, with a `<div class=plots>` where the charts go
};

/// The page as a file. `charts`: the data that data/study.js draws, in this order: `histograms`
/// (title, values, step, of), `differences` (title, axis, values, mean, low, high) and `bars`
/// (title, axis, names, values, sds), each a list that may be absent.
[[nodiscard]] std::string framed(const StudyPage& page, const nlohmann::json& charts);

/// "0.51 to 1.20", its ends as `number` writes them; or why there is no interval.
[[nodiscard]] std::string interval_html(const MeanInterval& interval,
                                        std::string (*number)(double));

}  // namespace orthonav::engine
