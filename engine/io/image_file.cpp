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
#include "engine/io/png_reader.h"

namespace orthonav::engine {
namespace {

// No picture of ours is larger; refusing it here keeps a forged header from allocating memory.
constexpr int kLargestSide_px = 16384;

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
  PngReader reader(std::string_view(bytes->data(), bytes->size()));
  if (!reader.read_header()) {
    return error_of(path, "not a readable PNG: " + reader.message());
  }
  if (reader.width_px() > kLargestSide_px || reader.height_px() > kLargestSide_px) {
    return error_of(path, "is larger than 16384 px");
  }
  RgbaImage image;
  image.width_px = reader.width_px();
  image.height_px = reader.height_px();
  const std::size_t count =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  const auto channels = static_cast<std::size_t>(reader.channels());
  std::vector<std::uint8_t> pixels(channels * count);
  if (!reader.read_pixels(pixels.data())) {
    return error_of(path, "not a readable PNG: " + reader.message());
  }
  if (channels == 4) {
    image.pixels = std::move(pixels);
    return image;
  }
  image.pixels.resize(4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* from = &pixels[channels * i];
    std::uint8_t* to = &image.pixels[4 * i];
    const bool coloured = channels == 3;
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = from[coloured ? k : 0];
    }
    to[3] = channels == 2 ? from[1] : 255;
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
