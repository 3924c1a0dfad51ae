#pragma once

#include <cstdint>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/mutex.h"
#include "base/result.h"
#include "base/transform.h"
#include "hal/replay/frame_files.h"

struct archive;
struct archive_entry;

namespace orthonav::replay {

/// A text file that grows by whole lines, each handed to the operating system once written, so that
/// a crash of the program loses none. Thread-safe.
class LineFile {
 public:
  Status open(const std::filesystem::path& path, const char* header);
  Status write(const std::string& line);
  Status close();
  [[nodiscard]] bool is_open() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  mutable Mutex mutex_;
  std::filesystem::path path_ ORTHONAV_GUARDED_BY(mutex_);
  std::unique_ptr<std::FILE, Close> file_ ORTHONAV_GUARDED_BY(mutex_);
};

/// A ustar archive of images that grows image by image.
class ImageTarWriter {
 public:
  Status open(const std::filesystem::path& path);
  /// `<ticks>.png`.
  Status write(std::int64_t ticks, const GreyImage& image);
  /// `<ticks><suffix>.pgm`, 16 bits big-endian.
  Status write(std::int64_t ticks, const char* suffix, const DepthImage& image);
  /// Writes the end mark.
  Status close();

 private:
  struct FreeArchive {
    void operator()(archive* a) const;
  };
  struct FreeEntry {
    void operator()(archive_entry* e) const;
  };
  std::filesystem::path path_;
  std::unique_ptr<archive, FreeArchive> archive_;
  std::unique_ptr<archive_entry, FreeEntry> entry_;
  std::vector<std::uint16_t> swapped_;
  std::vector<std::uint8_t> encoded_;

  Status put(const std::string& name, const std::string& header, const void* pixels,
             std::size_t bytes);
  [[nodiscard]] Error failed() const;
};

/// The files that accompany a stream's images: the frames and their times, the headset's poses, and
/// the maps.
class FrameListWriter {
 public:
  /// The poses are written to each of the given files; the map's file is created at the first move.
  Status open(const std::filesystem::path& frames, std::filesystem::path map,
              const std::vector<std::filesystem::path>& poses);
  /// Whether a frame of that time can be distinguished from the one before it.
  [[nodiscard]] Status check(std::int64_t ticks) const;
  Status write(const FrameRow& row, std::int64_t map_epoch,
               const std::optional<Transform<World, Rig>>& world_from_rig);
  Status close();

 private:
  LineFile frames_;
  std::deque<LineFile> poses_;
  LineFile map_;
  std::filesystem::path map_path_;
  std::int64_t map_epoch_ = 0;
  std::int64_t last_ticks_ = -1;
  std::string line_;
};

}  // namespace orthonav::replay
