#include "engine/report/page_style.h"

#include "embedded/report_css.h"

namespace orthonav::engine {

std::string_view page_style() { return embedded::report_css(); }

}  // namespace orthonav::engine
