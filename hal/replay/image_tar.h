#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "hal/replay/layout.h"
#include "hal/replay/pgm_header.h"

namespace orthonav::replay {

/// One image of a tar: its sensor time, and where its pixels, or its PNG, begin and how long they
/// are.
struct ImageMember {
  std::int64_t ticks = 0;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  bool png = false;
};

enum class PixelKind { kGrey8, kBigEndian16, kLittleEndian16 };

/// The layout of an archive's members.
struct ImageLayout {
  std::string prefix;  ///< before the ticks in a name; HoloLens 1 writes "vlc_lf" and a backslash
  PixelKind pixels = PixelKind::kGrey8;
  int width_px = kImageWidthPx;  ///< 0: as in the first image
  int height_px = kImageHeightPx;
  bool with_brightness = false;  ///< `<ticks>_ab.pgm` beside `<ticks>.pgm`
};

/// The images of one sensor: a ustar archive of `<ticks>.pgm`, or of `<ticks>.png` where they have
/// eight bits. Only the index is held in memory; pixels are read on demand.
class ImageTar {
 public:
  /// Reads every header. Refuses an archive without a whole image, with anything other than such
  /// images, or with data after its end mark. From a truncated archive, the whole images are
  /// available.
  static Result<ImageTar> open(const std::filesystem::path& path, ImageLayout layout = {});

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// By time, each time once.
  [[nodiscard]] const std::vector<ImageMember>& members() const { return members_; }
  /// The same for the `_ab` images.
  [[nodiscard]] const std::vector<ImageMember>& brightness() const { return brightness_; }
  [[nodiscard]] int width_px() const { return layout_.width_px; }
  [[nodiscard]] int height_px() const { return layout_.height_px; }
  /// In one line, where the archive was truncated; empty: it has its end mark.
  [[nodiscard]] const std::string& cut() const { return cut_; }
  /// Up to the end of its last whole image.
  [[nodiscard]] std::uint64_t whole_bytes() const { return whole_bytes_; }
  /// Up to the end of this one.
  [[nodiscard]] std::uint64_t end_of(const ImageMember& member) const;
  /// Images left out because of a repeated time.
  [[nodiscard]] std::int64_t repeated() const { return repeated_; }
  /// Reads a member of an archive with 8 or 16 bits per pixel.
  Status read(const ImageMember& member, GreyImage& image);
  Status read(const ImageMember& member, DepthImage& image);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Name {
    std::int64_t ticks = 0;
    bool brightness = false;
    bool png = false;
  };

  std::filesystem::path path_;
  ImageLayout layout_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<ImageMember> members_;
  std::vector<ImageMember> brightness_;
  std::int64_t repeated_ = 0;
  std::string cut_;
  std::uint64_t whole_bytes_ = 0;
  std::string encoded_;  ///< the PNG in work

  Status index();
  [[nodiscard]] std::optional<Name> parsed(std::string_view name) const;
  Status index_member(const char* name, bool plain, std::uint64_t offset, std::uint64_t size);
  /// Where the pixels or the PNG of a member lie, checked against the layout.
  Result<ImageMember> image_of(const Name& name, std::uint64_t offset, std::uint64_t size);
  Status check_size(std::int64_t width_px, std::int64_t height_px);
  [[nodiscard]] std::size_t image_bytes() const;
  template <class Value>
  Status read_pixels(const ImageMember& member, PlainImage<Value>& image);
  [[nodiscard]] Error no_whole_image(std::uint64_t file_size) const;
  Status check_end(std::uint64_t file_size);
  bool read_at(std::uint64_t offset, void* bytes, std::size_t count);
};

}  // namespace orthonav::replay
