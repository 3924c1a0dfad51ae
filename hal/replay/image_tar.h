#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/api/image.h"
#include "hal/api/result.h"

namespace orthonav::replay {

/// One image of a tar: its sensor time and where its pixels begin.
struct ImageMember {
  std::int64_t ticks = 0;
  std::uint64_t pixels_offset = 0;
};

/// What the members of an archive are.
struct ImageLayout {
  std::string prefix;  ///< before the ticks in a name; HoloLens 1 writes "vlc_lf" and a backslash
};

/// The images of one sensor: a ustar archive of `<ticks>.pgm`, 640×480, 8 bits. Only the index is
/// held in memory; pixels are read where they lie.
class ImageTar {
 public:
  /// Reads every header. Refuses an archive that is truncated, holds anything else than such
  /// images, or goes on after its end mark.
  static Result<ImageTar> open(const std::filesystem::path& path, ImageLayout layout = {});

  /// By time, each time once.
  [[nodiscard]] const std::vector<ImageMember>& members() const { return members_; }
  /// Images left out because their time had come already.
  [[nodiscard]] std::int64_t repeated() const { return repeated_; }
  Status read(const ImageMember& member, GreyImage& image);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  ImageLayout layout_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<ImageMember> members_;
  std::int64_t repeated_ = 0;

  Status index();
  [[nodiscard]] std::optional<std::int64_t> ticks_in(std::string_view name) const;
  Status index_member(const char* name, bool plain, std::uint64_t offset, std::uint64_t size,
                      std::uint64_t file_size);
  Result<std::uint64_t> pgm_header_bytes(const std::string& name, std::uint64_t offset,
                                         std::uint64_t size);
  Status check_end(std::uint64_t end, std::uint64_t file_size);
  bool read_at(std::uint64_t offset, void* bytes, std::size_t count);
};

}  // namespace orthonav::replay
