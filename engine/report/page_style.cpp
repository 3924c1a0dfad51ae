#include "engine/report/page_style.h"

#include "embedded/chart_js.h"
#include "embedded/report_css.h"

namespace orthonav::engine {

std::string_view page_style() { return embedded::report_css(); }
std::string_view plotting_script() { return embedded::chart_js(); }

}  // namespace orthonav::engine
