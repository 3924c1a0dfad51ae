#pragma once

#include <string>
#include <string_view>

#include "base/image.h"
#include "base/result.h"

namespace orthonav::engine {

/// Reads a PNG, JPEG or binary PGM (P5, up to 8 bits) as 8-bit grey; colour by BT.601 luma. Levels
/// are those stored (`PngReader`), and the pixels are taken as they are stored: an orientation
/// noted by the camera is not applied, so that corner coordinates belong to the file. Refuses, in
/// one line that names the file, unreadable, truncated or damaged files, other formats, and more
/// than 100 megapixels.
Result<GreyImage> load_grey(const std::string& path);

/// The same from a file's content.
Result<GreyImage> parse_grey(std::string_view content, const std::string& name);

}  // namespace orthonav::engine
