#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "hal/api/devices.h"
#include "hal/replay/event_files.h"
#include "hal/replay/recording.h"

struct archive;
struct archive_entry;

namespace orthonav::replay {

/// A text file that grows by whole lines, each on the disk's side once written, so that a crash
/// loses none. Thread-safe.
class LineFile {
 public:
  Status open(const std::filesystem::path& path, const char* header);
  Status write(const std::string& line);
  Status close();
  [[nodiscard]] bool is_open() const { return file_ != nullptr; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::mutex mutex_;
};

/// A ustar archive of `<ticks>.pgm` that grows image by image.
class ImageTarWriter {
 public:
  Status open(const std::filesystem::path& path);
  Status write(std::int64_t ticks, const GreyImage& image);
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

  Error failed() const;
};

/// Writes a recording's folder; the counterpart of read_recording. frame() and close() belong to
/// one thread, the others to any.
class RecordingWriter {
 public:
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& folder,
                                                         const StereoCalibration& calibration,
                                                         const RecordedDevice& device,
                                                         const std::string& tools_json);
  Status frame(const StereoFrame& frame, Timestamp clock);
  Status event(const Delivered<ClickerEvent>& event);
  Status event(const Delivered<Phrase>& event);
  Status head_answer(std::int64_t sequence, const Tracked<Transform<World, Rig>>& answer);
  /// Finishes every file and renames the folder.
  Status close();

 private:
  Status note_map(const StereoFrame& frame);

  std::filesystem::path folder_;
  std::filesystem::path part_;
  std::int64_t epoch_ticks_ = 0;
  std::int64_t pairs_ = 0;
  std::int64_t last_ticks_ = -1;
  ImageTarWriter left_;
  ImageTarWriter right_;
  LineFile left_poses_;
  LineFile right_poses_;
  LineFile frames_;
  LineFile map_;  ///< opened by the first move
  std::int64_t map_epoch_ = 0;
  LineFile events_;
  LineFile head_;
  std::string line_;

  Status open_files();
};

}  // namespace orthonav::replay
