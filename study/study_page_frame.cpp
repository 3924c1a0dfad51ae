#include "study/study_page_frame.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "embedded/study_js.h"
#include "engine/report/html_text.h"
#include "engine/report/page_style.h"
#include "engine/report/script_json.h"

namespace orthonav::engine {

std::string framed(const StudyPage& page, const nlohmann::json& charts) {
  const std::string title = html_escaped(page.title);
  std::string html =
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: " + title +
      "</title><meta name=viewport content=\"width=device-width, initial-scale=1\"><style>" +
      std::string(page_style()) + "</style></head><body><header><h1>orthonav <span>" + title +
      "</span></h1><p>" + page.intro + "</p></header><main>" + page.body +
      "</main><script type=\"application/json\" id=study-data>" + script_json(charts) +
      "</script><script>";
  return html.append(plotting_script())
      .append("</script><script>")
      .append(embedded::study_js())
      .append("</script></body></html>\n");
}

std::string interval_html(const MeanInterval& interval, std::string (*number)(double)) {
  return std::isfinite(interval.low) ? number(interval.low) + " to " + number(interval.high)
                                     : "<small>too few operations</small>";
}

}  // namespace orthonav::engine
