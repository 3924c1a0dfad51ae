#include "engine/io/grey_image_file.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/io/jpeg_reader.h"
#include "engine/io/json_document.h"
#include "engine/io/png_reader.h"

namespace orthonav::engine {
namespace {

constexpr std::int64_t kMaxPixels = 100'000'000;
constexpr std::size_t kMostBytes = 512u << 20u;

struct ImageSize {
  std::int64_t width_px = 0;
  std::int64_t height_px = 0;
};

Status check(const ImageSize& size) {
  if (size.width_px <= 0 || size.height_px <= 0) {
    return Error{"image is empty (" + std::to_string(size.width_px) + " x " +
                 std::to_string(size.height_px) + " px)"};
  }
  if (size.width_px > kMaxPixels || size.height_px > kMaxPixels / size.width_px) {
    return Error{"image of " + std::to_string(size.width_px) + " x " +
                 std::to_string(size.height_px) + " px, limit 100 megapixels"};
  }
  return {};
}

// A number of a PGM's header, after white space and comments.
std::optional<std::int64_t> pgm_number(std::string_view& text) {
  for (;;) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) {
      return std::nullopt;
    }
    text.remove_prefix(start);
    if (text.front() != '#') {
      break;
    }
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    text.remove_prefix(end);
  }
  std::int64_t value = 0;
  const auto [rest, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || rest == text.data() + text.size()) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return value;
}

Result<GreyImage> parse_pgm(std::string_view content) {
  std::string_view rest = content.substr(2);
  const auto width = pgm_number(rest);
  const auto height = width ? pgm_number(rest) : std::nullopt;
  const auto brightest = height ? pgm_number(rest) : std::nullopt;
  if (!brightest || std::string_view(" \t\r\n").find(rest.front()) == std::string_view::npos) {
    return Error{"PGM header is damaged"};
  }
  rest.remove_prefix(1);
  if (Status status = check({*width, *height}); !status) {
    return status.error();
  }
  if (*brightest < 1 || *brightest > 255) {
    return Error{"PGM with a largest value of " + std::to_string(*brightest) + ", must be 1-255"};
  }
  const auto pixels = static_cast<std::size_t>(*width * *height);
  if (rest.size() < pixels) {
    return Error{"PGM is cut short (" + std::to_string(rest.size()) + " of " +
                 std::to_string(pixels) + " bytes)"};
  }
  GreyImage image(static_cast<int>(*width), static_cast<int>(*height));
  const auto scale = static_cast<int>(*brightest);
  std::transform(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(pixels),
                 image.pixels.begin(), [scale](char c) {
                   const int value = std::min<int>(static_cast<std::uint8_t>(c), scale);
                   return static_cast<std::uint8_t>((value * 255 + scale / 2) / scale);
                 });
  return image;
}

std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
}

Result<GreyImage> parse_png(std::string_view content) {
  PngReader reader(content);
  const auto damaged = [&reader] { return Error{"PNG is damaged: " + reader.message()}; };
  if (!reader.read_header()) {
    return damaged();
  }
  if (Status status = check({reader.width_px(), reader.height_px()}); !status) {
    return status.error();
  }
  GreyImage grey(reader.width_px(), reader.height_px());
  const auto channels = static_cast<std::size_t>(reader.channels());
  std::vector<std::uint8_t> pixels(channels * grey.pixels.size());
  if (!reader.read_pixels(pixels.data())) {
    return damaged();
  }
  const bool coloured = channels >= 3;
  const bool transparent = channels % 2 == 0;
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
    const std::uint8_t* pixel = &pixels[channels * i];
    const int level = coloured ? luma(pixel) : pixel[0];
    // Under transparent pixels it is black.
    const int opacity = transparent ? pixel[channels - 1] : 255;
    grey.pixels[i] = static_cast<std::uint8_t>((level * opacity + 127) / 255);
  }
  return grey;
}

Result<GreyImage> parse_jpeg(std::string_view content) {
  JpegReader reader(content);
  const auto damaged = [&reader] { return Error{"JPEG is damaged: " + reader.message()}; };
  if (!reader.read_header()) {
    return damaged();
  }
  if (Status status = check({reader.width_px(), reader.height_px()}); !status) {
    return status.error();
  }
  GreyImage grey(reader.width_px(), reader.height_px());
  if (!reader.read_rows(grey.pixels.data())) {
    return damaged();
  }
  return grey;
}

Result<GreyImage> parse(std::string_view content) {
  if (content.starts_with("P5")) {
    return parse_pgm(content);
  }
  if (content.starts_with(std::string_view("\x89PNG\r\n\x1a\n", 8))) {
    return parse_png(content);
  }
  if (content.starts_with("\xff\xd8\xff")) {
    return parse_jpeg(content);
  }
  return Error{content.empty() ? "file is empty" : "not a PNG, JPEG or binary PGM image"};
}

}  // namespace

Result<GreyImage> parse_grey(std::string_view content, const std::string& name) {
  Result<GreyImage> image = parse(content);
  if (!image) {
    return Error{name + ": " + image.error().message};
  }
  return image;
}

Result<GreyImage> load_grey(const std::string& path) {
  Result<std::string> content = read_text(path, kMostBytes);
  if (!content) {
    return content.error();
  }
  return parse_grey(*content, path);
}

}  // namespace orthonav::engine
