#include "engine/golden/golden_review.h"

#include <algorithm>
#include <string_view>

#include "engine/io/image_file.h"

namespace orthonav::engine {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8u | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padding = i + k > bytes.size();
      text += padding ? '=' : kDigits[group >> (18 - 6 * k) & 63u];
    }
  }
  return text;
}

/// Labels in colours that tell neighbours apart.
RgbaImage coloured(const LabelImage& labels) {
  RgbaImage image;
  image.width_px = labels.width_px;
  image.height_px = labels.height_px;
  for (const render::Label label : labels.labels) {
    const std::uint32_t mixed = label * 2654435761u;
    for (const unsigned shift : {8u, 16u, 24u}) {
      const std::uint32_t value = label == 0 ? 0u : 96u + (mixed >> shift & 0xffu) * 5u / 8u;
      image.pixels.push_back(static_cast<std::uint8_t>(value));
    }
    image.pixels.push_back(255);
  }
  return image;
}

Result<std::string> cell(const RgbaImage& image) {
  if (image.pixels.empty()) {
    return std::string("<td>none</td>");
  }
  const Result<std::string> png = png_bytes(image);
  if (!png) {
    return png.error();
  }
  return "<td><img src=\"data:image/png;base64," + base64(*png) + "\"></td>";
}

Result<std::string> row(const std::string& name, const RgbaImage& expected,
                        const RgbaImage& actual) {
  std::string html = "<tr><th>" + name + "</th>";
  const RgbaImage difference = render::difference_image(expected, actual);
  for (const RgbaImage* image : {&expected, &actual, &difference}) {
    const Result<std::string> part = cell(*image);
    if (!part) {
      return part.error();
    }
    html += *part;
  }
  return html + "</tr>\n";
}

Result<std::string> section(const GoldenVerdict& verdict) {
  const GoldenImages none;
  const GoldenImages& expected = verdict.expected ? *verdict.expected : none;
  const GoldenImages& actual = verdict.actual;
  std::string html = "<h2>" + verdict.scene.name + "</h2><p>" + verdict.scene.what + "</p>\n";
  for (const std::string& problem : verdict.problems) {
    html += "<p class=\"bad\">" + problem + "</p>\n";
  }
  if (verdict.problems.empty()) {
    html += "<p>alike</p>\n";
  }
  html += "<table><tr><th></th><th>expected</th><th>actual</th><th>difference × 16</th></tr>\n";
  for (const auto& [name, was, is] :
       {std::tuple("additive", expected.additive, actual.additive),
        std::tuple("over", expected.over, actual.over),
        std::tuple("labels", coloured(expected.labels), coloured(actual.labels))}) {
    const Result<std::string> part = row(name, was, is);
    if (!part) {
      return part.error();
    }
    html += *part;
  }
  return html + "</table>\n";
}

}  // namespace

Result<GoldenVerdict> judge(GoldenPainter& painter, const GoldenScene& scene,
                            const std::filesystem::path& folder) {
  Result<GoldenImages> actual = painter.paint(scene);
  if (!actual) {
    return actual.error();
  }
  GoldenVerdict verdict{scene, std::nullopt, std::move(*actual), {}};
  Result<GoldenImages> expected = read_goldens(folder, scene.name);
  if (expected) {
    verdict.problems = differences(*expected, verdict.actual);
    verdict.expected = std::move(*expected);
  } else {
    verdict.problems = {expected.error().message};
  }
  for (const std::string& message : painter.validation_messages()) {
    verdict.problems.push_back("validation: " + message);
  }
  return verdict;
}

Result<std::string> review_page(const std::vector<GoldenVerdict>& verdicts,
                                const std::vector<std::string>& orphans) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Golden images</title>\n"
      "<style>body{font:16px sans-serif;background:#222;color:#ddd}.bad{color:#f66}"
      "img{image-rendering:pixelated;border:1px solid #555;max-width:31vw}"
      "td,th{padding:4px;vertical-align:top}</style>\n<h1>Golden images</h1>\n";
  for (const std::string& orphan : orphans) {
    html += "<p class=\"bad\">" + orphan + " belongs to no scene</p>\n";
  }
  for (const bool differing : {true, false}) {
    for (const GoldenVerdict& verdict : verdicts) {
      if (verdict.problems.empty() == differing) {
        continue;
      }
      const Result<std::string> part = section(verdict);
      if (!part) {
        return part.error();
      }
      html += *part;
    }
  }
  return html + "</html>\n";
}

}  // namespace orthonav::engine
