#include "engine/io/image_file.h"

#include <png.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "base/file_code.h"
#include "engine/io/atomic_file.h"

namespace orthonav::engine {
namespace {

// No picture of ours is larger; refusing it here keeps a forged header from allocating memory.
constexpr png_uint_32 kLargestSide_px = 16384;

Error error_of(const std::filesystem::path& path, const std::string& reason,
               ErrorCode code = ErrorCode::kInvalid) {
  return {path.string() + ": " + reason, code};
}

Result<std::vector<char>> bytes_of(const std::filesystem::path& path) {
  // Reading a folder throws, and reading a pipe may never end.
  std::error_code absent;
  if (!std::filesystem::is_regular_file(path, absent)) {
    return error_of(path, "can't be read", code_of_unopened(path));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return error_of(path, "can't be read", code_of_unopened(path));
  }
  std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (file.bad()) {
    return error_of(path, "can't be read", ErrorCode::kIo);
  }
  return bytes;
}

}  // namespace

Result<RgbaImage> read_png(const std::filesystem::path& path) {
  const Result<std::vector<char>> bytes = bytes_of(path);
  if (!bytes) {
    return bytes.error();
  }
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&header, bytes->data(), bytes->size())) {
    return error_of(path, std::string("not a readable PNG: ") + header.message);
  }
  if (header.width > kLargestSide_px || header.height > kLargestSide_px) {
    png_image_free(&header);
    return error_of(path, "is larger than 16384 px");
  }
  header.format = PNG_FORMAT_RGBA;
  RgbaImage image;
  image.width_px = static_cast<int>(header.width);
  image.height_px = static_cast<int>(header.height);
  image.pixels.resize(PNG_IMAGE_SIZE(header));
  if (!png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr)) {
    png_image_free(&header);
    return error_of(path, std::string("not a readable PNG: ") + header.message);
  }
  return image;
}

Result<std::string> png_bytes(const RgbaImage& image) {
  const auto pixels = static_cast<std::size_t>(image.width_px) * image.height_px;
  if (image.width_px <= 0 || image.height_px <= 0 || image.pixels.size() != 4 * pixels) {
    return Error{"image without pixels"};
  }
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width_px);
  header.height = static_cast<png_uint_32>(image.height_px);
  header.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0,
                                 nullptr)) {
    return Error{std::string("image can't be encoded: ") + header.message};
  }
  bytes.resize(size);
  return bytes;
}

Status write_png(const std::filesystem::path& path, const RgbaImage& image) {
  const Result<std::string> bytes = png_bytes(image);
  if (!bytes) {
    return error_of(path, bytes.error().message);
  }
  return write_file(path.string(), *bytes);
}

Result<RgbaImage> picture_of_labels(const LabelImage& labels) {
  RgbaImage picture;
  picture.width_px = labels.width_px;
  picture.height_px = labels.height_px;
  picture.pixels.reserve(4 * labels.labels.size());
  for (const std::uint32_t label : labels.labels) {
    if (label >> 24) {
      return Error{"label " + std::to_string(label) + ", limit 16777215"};
    }
    for (const unsigned shift : {0u, 8u, 16u}) {
      picture.pixels.push_back(static_cast<std::uint8_t>(label >> shift & 0xffu));
    }
    picture.pixels.push_back(255);
  }
  return picture;
}

LabelImage labels_of_picture(const RgbaImage& picture) {
  LabelImage labels;
  labels.width_px = picture.width_px;
  labels.height_px = picture.height_px;
  labels.labels.reserve(picture.pixels.size() / 4);
  for (std::size_t i = 0; i + 3 < picture.pixels.size(); i += 4) {
    labels.labels.push_back(picture.pixels[i] | std::uint32_t{picture.pixels[i + 1]} << 8u |
                            std::uint32_t{picture.pixels[i + 2]} << 16u);
  }
  return labels;
}

}  // namespace orthonav::engine
