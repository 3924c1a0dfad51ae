#pragma once

#include <filesystem>
#include <string>

#include "base/image.h"
#include "base/result.h"

namespace orthonav::engine {

/// Reads any PNG as 8-bit RGBA (`PngReader`). Refuses, by name, a file that is absent, truncated or
/// not a PNG.
Result<RgbaImage> read_png(const std::filesystem::path& path);

/// The image as the bytes of a PNG file.
Result<std::string> png_bytes(const RgbaImage& image);

/// Writes to a temporary file and then renames it to `path`, so that a partly written image is
/// never visible.
Status write_png(const std::filesystem::path& path, const RgbaImage& image);

/// A label image as a picture and back, without loss: the label's three low bytes as red, green,
/// blue. Labels of 2^24 and more are refused.
Result<RgbaImage> picture_of_labels(const LabelImage& labels);
LabelImage labels_of_picture(const RgbaImage& picture);

}  // namespace orthonav::engine
