#pragma once

#include <string_view>

namespace orthonav::engine {

/// The style of every page: data/report.css.
[[nodiscard]] std::string_view page_style();
/// The library that draws the plots of a page, as a script.
[[nodiscard]] std::string_view plotting_script();

}  // namespace orthonav::engine
