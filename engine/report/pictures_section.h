#pragma once

#include <string>

#include "engine/report/report_html.h"

namespace orthonav::engine {

/// The film with its poster; empty where there is none.
[[nodiscard]] std::string film_section(const ReportContent& content);
/// The pictures step by step; empty where there are none.
[[nodiscard]] std::string pictures_section(const ReportContent& content);

}  // namespace orthonav::engine
