#include "engine/print/sheet_drawing.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "base/printed.h"
#include "engine/print/text_outline.h"

namespace orthonav::engine {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kCutWidthMm = 0.1;
// Short, so that a notch of 2 mm has several.
constexpr double kCutDashMm = 0.5;
constexpr double kCutGrey = 0.6;
constexpr double kMaxPixels = 200e6;
// A file says when it was made; ours must not depend on that.
constexpr const char* kCreated = "2000-01-01T00:00:00Z";

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Context = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

Status status_of(cairo_status_t status, const std::string& what) {
  if (status == CAIRO_STATUS_SUCCESS) {
    return {};
  }
  return Error{what + " cannot be drawn: " + cairo_status_to_string(status)};
}

void set_ink(cairo_t* context, bool white) {
  const double grey = white ? 1.0 : 0.0;
  cairo_set_source_rgb(context, grey, grey, grey);
}

void draw(cairo_t* context, const SheetShape& shape) {
  set_ink(context, /*white=*/false);
  for (const SheetRect& r : shape.rects) {
    cairo_rectangle(context, r.x_mm, r.y_mm, r.width_mm, r.height_mm);
  }
  cairo_fill(context);
}

void draw(cairo_t* context, const SheetCut& cut) {
  cairo_set_source_rgb(context, kCutGrey, kCutGrey, kCutGrey);
  cairo_set_line_width(context, kCutWidthMm);
  cairo_set_dash(context, &kCutDashMm, 1, 0.0);
  for (const Vec2& corner : cut.corners_mm) {
    cairo_line_to(context, corner.x, corner.y);
  }
  cairo_close_path(context);
  cairo_stroke(context);
}

void draw(cairo_t* context, const SheetLine& line) {
  set_ink(context, line.white);
  cairo_set_line_width(context, line.width_mm);
  cairo_set_dash(context, nullptr, 0, 0.0);
  cairo_move_to(context, line.from_x_mm, line.from_y_mm);
  cairo_line_to(context, line.to_x_mm, line.to_y_mm);
  cairo_stroke(context);
}

void draw(cairo_t* context, const SheetText& text, const PrintFont& font) {
  const TextOutline outline = font.outline(text.text);
  const double fraction = text.align == SheetAlign::kLeft     ? 0.0
                          : text.align == SheetAlign::kCentre ? 0.5
                                                              : 1.0;
  cairo_save(context);
  set_ink(context, text.white);
  cairo_translate(context, text.x_mm, text.y_mm);
  if (text.upward) {
    cairo_rotate(context, -std::numbers::pi / 2);
  }
  cairo_scale(context, text.height_mm, text.height_mm);
  cairo_translate(context, -fraction * outline.advance, 0.0);
  for (const TextOutline::Step& step : outline.steps) {
    const auto& to = step.to;
    if (step.kind == TextOutline::Kind::kMove) {
      cairo_move_to(context, to[0].x, to[0].y);
    }
    if (step.kind == TextOutline::Kind::kLine) {
      cairo_line_to(context, to[0].x, to[0].y);
    }
    if (step.kind == TextOutline::Kind::kCubic) {
      cairo_curve_to(context, to[0].x, to[0].y, to[1].x, to[1].y, to[2].x, to[2].y);
    }
  }
  cairo_fill(context);
  cairo_restore(context);
}

void draw(cairo_t* context, const Sheet& sheet, const PrintFont& font) {
  for (const SheetCut& cut : sheet.cuts) {
    draw(context, cut);
  }
  for (const SheetShape& shape : sheet.shapes) {
    draw(context, shape);
  }
  for (const SheetLine& line : sheet.lines) {
    draw(context, line);
  }
  for (const SheetText& text : sheet.texts) {
    draw(context, text, font);
  }
}

cairo_status_t append(void* closure, const unsigned char* bytes, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Result<std::string> pdf_of(std::span<const Sheet> sheets, const std::string& title) {
  if (sheets.empty()) {
    return Error{"nothing to print"};
  }
  const auto font = PrintFont::open();
  if (!font) {
    return font.error();
  }
  std::string bytes;
  const Surface surface(
      cairo_pdf_surface_create_for_stream(append, &bytes, sheets[0].width_mm * kPointsPerMm,
                                          sheets[0].height_mm * kPointsPerMm),
      cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "orthonav");
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, kCreated);
  for (const Sheet& sheet : sheets) {
    cairo_pdf_surface_set_size(surface.get(), sheet.width_mm * kPointsPerMm,
                               sheet.height_mm * kPointsPerMm);
    const Context context(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(context.get(), kPointsPerMm, kPointsPerMm);
    draw(context.get(), sheet, *font);
    cairo_show_page(context.get());
    if (Status s = status_of(cairo_status(context.get()), title); !s) {
      return s.error();
    }
  }
  cairo_surface_finish(surface.get());
  if (Status s = status_of(cairo_surface_status(surface.get()), title); !s) {
    return s.error();
  }
  return bytes;
}

Result<GreyImage> image_of(const Sheet& sheet, double px_per_mm) {
  const double width = std::round(sheet.width_mm * px_per_mm);
  const double height = std::round(sheet.height_mm * px_per_mm);
  if (!(width >= 1 && height >= 1 && width * height <= kMaxPixels)) {
    return Error{"page image: " + printed("%f", px_per_mm) +
                 " px/mm, must give 1 pixel to 200 megapixels"};
  }
  const auto font = PrintFont::open();
  if (!font) {
    return font.error();
  }
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                                   static_cast<int>(height)),
                        cairo_surface_destroy);
  {
    const Context context(cairo_create(surface.get()), cairo_destroy);
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    cairo_scale(context.get(), px_per_mm, px_per_mm);
    draw(context.get(), sheet, *font);
    if (Status s = status_of(cairo_status(context.get()), "page image"); !s) {
      return s.error();
    }
  }
  cairo_surface_flush(surface.get());
  GreyImage image(static_cast<int>(width), static_cast<int>(height));
  const unsigned char* pixels = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  // Everything drawn is grey: any of the three channels will do.
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      image.at(x, y) =
          pixels[static_cast<std::size_t>(y) * stride + 4 * static_cast<std::size_t>(x) + 1];
    }
  }
  return image;
}

}  // namespace orthonav::engine
