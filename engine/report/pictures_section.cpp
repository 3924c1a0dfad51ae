#include "engine/report/pictures_section.h"

#include "engine/report/base64.h"
#include "engine/report/html_text.h"

namespace orthonav::engine {
namespace {

std::string data_uri(const std::vector<std::uint8_t>& png) {
  return "data:image/png;base64," + base64(png);
}

}  // namespace

std::string film_section(const ReportContent& content) {
  if (content.video.empty()) {
    return "";
  }
  const std::string file = html_escaped(content.video);
  return "<section id=film><h2>Film: the surgeon\u2019s view</h2><video controls "
         "preload=metadata src=\"" +
         file + "\"" +
         (content.poster.empty() ? "" : " poster=\"" + data_uri(content.poster) + "\"") +
         "></video><p class=notes>" + file +
         ", beside this page; the holograms as the surgeon saw them, the hand as if of "
         "glass.</p></section>";
}

std::string pictures_section(const ReportContent& content) {
  if (content.pictures.empty()) {
    return "";
  }
  std::string html = "<section id=steps><h2>Step by step</h2><div class=gallery>";
  for (const ReportPicture& picture : content.pictures) {
    const std::string title = html_escaped(picture.title);
    html += "<figure><img alt=\"" + title + "\" src=\"" + data_uri(picture.png) +
            "\"><figcaption><b>" + title + "</b> " + html_escaped(picture.caption) +
            "</figcaption></figure>";
  }
  return html + "</div></section>";
}

}  // namespace orthonav::engine
