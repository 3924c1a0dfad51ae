#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace orthonav::engine {

/// Decodes a JPEG in memory to grey, row by row, with libjpeg, which reports errors by longjmp:
/// after a failure the reader can only say why. A file about which libjpeg merely warns (truncated,
/// damaged codes) counts as failed too, since libjpeg would fill it with grey.
class JpegReader {
 public:
  /// `content` must outlive the reader.
  explicit JpegReader(std::string_view content);
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader();

  [[nodiscard]] bool read_header();
  [[nodiscard]] int width_px() const;
  [[nodiscard]] int height_px() const;
  /// After the header; `pixels` holds width · height bytes.
  [[nodiscard]] bool read_rows(std::uint8_t* pixels);
  [[nodiscard]] std::string message() const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace orthonav::engine
