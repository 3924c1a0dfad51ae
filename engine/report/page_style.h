#pragma once

#include <string_view>

namespace orthonav::engine {

/// The style of every page: data/report.css.
[[nodiscard]] std::string_view page_style();

}  // namespace orthonav::engine
