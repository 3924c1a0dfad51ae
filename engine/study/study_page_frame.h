#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// A page about studies that needs nothing else, in the style of the report of an operation.
struct StudyPage {
  std::string title;  ///< plain text
  std::string intro;  ///< HTML
  std::string body;   ///< HTML: sections, with a `<div class=plots>` where the charts go
};

/// The page as a file. `charts`: what data/study.js draws, in this order: `histograms` (title,
/// values, step, of), `differences` (title, axis, values, mean, low, high) and `bars` (title, axis,
/// names, values, sds), each a list that may be absent.
[[nodiscard]] std::string framed(const StudyPage& page, const nlohmann::json& charts);

}  // namespace orthonav::engine
