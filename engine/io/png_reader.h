#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace orthonav::engine {

/// Decodes a PNG in memory to eight bits a channel, with libpng, which reports errors by longjmp:
/// after a failure the reader can only say why. Sixteen bits are scaled to eight, palettes are
/// looked up; levels are taken as stored, whatever the file says about their gamma, so that a
/// picture has the same levels in either depth.
class PngReader {
 public:
  /// `content` must outlive the reader.
  explicit PngReader(std::string_view content);
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader();

  [[nodiscard]] bool read_header();
  [[nodiscard]] int width_px() const;
  [[nodiscard]] int height_px() const;
  /// After the header: 1 grey, 2 grey and opacity, 3 RGB, 4 RGB and opacity.
  [[nodiscard]] int channels() const;
  /// After the header; `pixels` holds width · height · channels bytes.
  [[nodiscard]] bool read_pixels(std::uint8_t* pixels);
  [[nodiscard]] std::string message() const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace orthonav::engine
