#include "hal/replay/growing_files.h"

#include <archive.h>
#include <archive_entry.h>

#include <bit>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/file_code.h"
#include "hal/replay/frame_files.h"
#include "hal/replay/png_picture.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

std::string pgm_header(int width_px, int height_px, int maximum) {
  return "P5\n" + std::to_string(width_px) + " " + std::to_string(height_px) + "\n" +
         std::to_string(maximum) + "\n";
}

}  // namespace

Status LineFile::open(const std::filesystem::path& path, const char* header) {
  {
    const MutexLock lock(mutex_);
    path_ = path;
    file_.reset(std::fopen(path.c_str(), "wbe"));
    if (!file_) {
      return file_error(path,
                        std::string("cannot be written: ") + std::generic_category().message(errno),
                        file_code(errno));
    }
  }
  return header ? write(header) : Status{};
}

Status LineFile::write(const std::string& line) {
  const MutexLock lock(mutex_);
  if (!file_) {
    return file_error(path_, "is closed already");
  }
  const bool written = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() &&
                       std::fputc('\n', file_.get()) != EOF && std::fflush(file_.get()) == 0;
  if (!written) {
    return file_error(path_,
                      std::string("cannot be written: ") + std::generic_category().message(errno),
                      ErrorCode::kIo);
  }
  return {};
}

Status LineFile::close() {
  const MutexLock lock(mutex_);
  if (file_ && std::fclose(file_.release()) != 0) {
    return file_error(path_,
                      std::string("cannot be written: ") + std::generic_category().message(errno),
                      ErrorCode::kIo);
  }
  return {};
}

bool LineFile::is_open() const {
  const MutexLock lock(mutex_);
  return file_ != nullptr;
}

/// Without `close` nothing is added: the library would pad an incomplete image with zeros and write
/// the end mark of a complete archive.
void ImageTarWriter::FreeArchive::operator()(archive* a) const {
  archive_write_fail(a);
  archive_write_free(a);
}

void ImageTarWriter::FreeEntry::operator()(archive_entry* e) const { archive_entry_free(e); }

Status ImageTarWriter::open(const std::filesystem::path& path) {
  path_ = path;
  archive_.reset(archive_write_new());
  entry_.reset(archive_entry_new());
  archive_write_set_format_ustar(archive_.get());
  archive_write_set_bytes_per_block(archive_.get(), 0);  // no buffering
  if (archive_write_open_filename(archive_.get(), path.c_str()) != ARCHIVE_OK) {
    return failed();
  }
  return {};
}

Error ImageTarWriter::failed() const {
  const char* text = archive_error_string(archive_.get());
  const int number = archive_errno(archive_.get());
  // The library's own message for a failed write says no more than this.
  return file_error(
      path_,
      "cannot be written: " + (number > 0 ? std::generic_category().message(number)
                                          : std::string(text ? text : "unknown error")),
      ErrorCode::kIo);
}

Status ImageTarWriter::write(std::int64_t ticks, const GreyImage& image) {
  if (const Status encoded = encode_png(image, encoded_); !encoded) {
    return file_error(path_, "image " + std::to_string(ticks) + ": " + encoded.error().message);
  }
  return put(std::to_string(ticks) + ".png", "", encoded_.data(), encoded_.size());
}

Status ImageTarWriter::write(std::int64_t ticks, const char* suffix, const DepthImage& image) {
  constexpr int kMaximum = 65535;
  swapped_ = image.pixels;
  static_assert(std::endian::native == std::endian::little, "the file is big-endian");
  for (std::uint16_t& pixel : swapped_) {
    pixel = static_cast<std::uint16_t>(pixel << 8U | pixel >> 8U);
  }
  return put(std::to_string(ticks) + suffix + ".pgm",
             pgm_header(image.width_px, image.height_px, kMaximum), swapped_.data(),
             swapped_.size() * sizeof(std::uint16_t));
}

Status ImageTarWriter::put(const std::string& name, const std::string& header, const void* pixels,
                           std::size_t bytes) {
  archive_entry_clear(entry_.get());
  archive_entry_set_pathname(entry_.get(), name.c_str());
  archive_entry_set_filetype(entry_.get(), AE_IFREG);
  archive_entry_set_perm(entry_.get(), 0644);
  archive_entry_set_mtime(entry_.get(), 0, 0);
  archive_entry_set_size(entry_.get(), static_cast<la_int64_t>(header.size() + bytes));
  if (archive_write_header(archive_.get(), entry_.get()) != ARCHIVE_OK) {
    return failed();
  }
  const auto append = [this](const void* data, std::size_t count) {
    return archive_write_data(archive_.get(), data, count) == static_cast<la_ssize_t>(count);
  };
  if (!append(header.data(), header.size()) || !append(pixels, bytes)) {
    return failed();
  }
  if (archive_write_finish_entry(archive_.get()) != ARCHIVE_OK) {
    return failed();
  }
  return {};
}

Status ImageTarWriter::close() {
  if (archive_ && archive_write_close(archive_.get()) != ARCHIVE_OK) {
    return failed();
  }
  archive_.reset();
  return {};
}

Status FrameListWriter::open(const std::filesystem::path& frames, std::filesystem::path map,
                             const std::vector<std::filesystem::path>& poses) {
  map_path_ = std::move(map);
  for (const std::filesystem::path& path : poses) {
    if (Status s = poses_.emplace_back().open(path, nullptr); !s) {
      return s;
    }
  }
  return frames_.open(frames, kFramesHeader);
}

Status FrameListWriter::check(std::int64_t ticks) const {
  if (ticks >= 0 && ticks > last_ticks_) {
    return {};
  }
  return Error{"frame at " + std::to_string(ticks) +
               " ticks of 100 ns cannot be told from the one at " + std::to_string(last_ticks_)};
}

Status FrameListWriter::write(const FrameRow& row, std::int64_t map_epoch,
                              const std::optional<Transform<World, Rig>>& world_from_rig) {
  if (world_from_rig) {
    line_.clear();
    append_pose(line_, row.ticks, *world_from_rig);
    for (LineFile& file : poses_) {
      if (Status s = file.write(line_); !s) {
        return s;
      }
    }
  }
  if (map_epoch != map_epoch_) {
    if (!map_.is_open()) {
      if (Status s = map_.open(map_path_, kMapHeader); !s) {
        return s;
      }
    }
    map_epoch_ = map_epoch;
    line_.clear();
    append_map_move(line_, {row.sequence, map_epoch});
    if (Status s = map_.write(line_); !s) {
      return s;
    }
  }
  line_.clear();
  append_frame(line_, row);
  if (Status s = frames_.write(line_); !s) {
    return s;
  }
  last_ticks_ = row.ticks;
  return {};
}

Status FrameListWriter::close() {
  for (LineFile& file : poses_) {
    if (Status s = file.close(); !s) {
      return s;
    }
  }
  if (map_.is_open()) {
    if (Status s = map_.close(); !s) {
      return s;
    }
  }
  return frames_.close();
}

}  // namespace orthonav::replay
