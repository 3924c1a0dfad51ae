#pragma once

#include <span>
#include <string>

#include "base/image.h"
#include "base/result.h"
#include "engine/print/sheet.h"

namespace orthonav::engine {

/// The sheets as the pages of a PDF file, each of its own size, all edges as vectors; the bytes are
/// reproducible. Refuses an empty list.
Result<std::string> pdf_of(std::span<const Sheet> sheets, const std::string& title);

/// The same drawing as an image; the page's corner is the image's. Refuses more than 200
/// megapixels.
Result<GreyImage> image_of(const Sheet& sheet, double px_per_mm);

}  // namespace orthonav::engine
