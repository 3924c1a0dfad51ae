#include "hal/replay/recording_writer.h"

#include <archive.h>
#include <archive_entry.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "hal/replay/calibration_files.h"
#include "hal/replay/frame_files.h"
#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

constexpr char kPgmHeader[] = "P5\n640 480\n255\n";
constexpr std::size_t kPgmHeaderBytes = sizeof(kPgmHeader) - 1;

Status check_free(const std::filesystem::path& folder, const std::filesystem::path& part) {
  std::error_code code;
  if (std::filesystem::exists(part, code))
    return file_error(part, "was left by a recording that was cut off; move it away first");
  if (!std::filesystem::exists(folder, code)) return {};
  if (!std::filesystem::is_directory(folder, code) || !std::filesystem::is_empty(folder, code))
    return file_error(folder, "exists already; a recording needs a new or empty folder");
  return {};
}

}  // namespace

Status LineFile::open(const std::filesystem::path& path, const char* header) {
  path_ = path;
  file_.reset(std::fopen(path.c_str(), "wbe"));
  if (!file_) return file_error(path, std::string("cannot be written: ") + std::strerror(errno));
  return header ? write(header) : Status{};
}

Status LineFile::write(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (!file_) return file_error(path_, "is closed already");
  const bool written = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() &&
                       std::fputc('\n', file_.get()) != EOF && std::fflush(file_.get()) == 0;
  if (!written) return file_error(path_, std::string("cannot be written: ") + std::strerror(errno));
  return {};
}

Status LineFile::close() {
  const std::lock_guard lock(mutex_);
  if (file_ && std::fclose(file_.release()) != 0)
    return file_error(path_, std::string("cannot be written: ") + std::strerror(errno));
  return {};
}

void ImageTarWriter::FreeArchive::operator()(archive* a) const { archive_write_free(a); }

void ImageTarWriter::FreeEntry::operator()(archive_entry* e) const { archive_entry_free(e); }

Status ImageTarWriter::open(const std::filesystem::path& path) {
  path_ = path;
  archive_.reset(archive_write_new());
  entry_.reset(archive_entry_new());
  archive_write_set_format_ustar(archive_.get());
  archive_write_set_bytes_per_block(archive_.get(), 0);  // nothing waits in a buffer
  if (archive_write_open_filename(archive_.get(), path.c_str()) != ARCHIVE_OK) return failed();
  return {};
}

Error ImageTarWriter::failed() const {
  const char* text = archive_error_string(archive_.get());
  return file_error(path_, std::string("cannot be written: ") + (text ? text : "unknown error"));
}

Status ImageTarWriter::write(std::int64_t ticks, const GreyImage& image) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%lld.pgm", static_cast<long long>(ticks));
  archive_entry_clear(entry_.get());
  archive_entry_set_pathname(entry_.get(), name.data());
  archive_entry_set_filetype(entry_.get(), AE_IFREG);
  archive_entry_set_perm(entry_.get(), 0644);
  archive_entry_set_mtime(entry_.get(), 0, 0);
  archive_entry_set_size(entry_.get(), static_cast<la_int64_t>(kPgmHeaderBytes + kImageBytes));
  if (archive_write_header(archive_.get(), entry_.get()) != ARCHIVE_OK) return failed();
  const auto put = [this](const void* bytes, std::size_t count) {
    return archive_write_data(archive_.get(), bytes, count) == static_cast<la_ssize_t>(count);
  };
  if (!put(kPgmHeader, kPgmHeaderBytes) || !put(image.pixels.data(), kImageBytes)) return failed();
  if (archive_write_finish_entry(archive_.get()) != ARCHIVE_OK) return failed();
  return {};
}

Status ImageTarWriter::close() {
  if (archive_ && archive_write_close(archive_.get()) != ARCHIVE_OK) return failed();
  archive_.reset();
  return {};
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(
    const std::filesystem::path& folder, const StereoCalibration& calibration,
    const RecordedDevice& device, const std::string& tools_json) {
  auto writer = std::make_unique<RecordingWriter>();
  // "DIR/" and "DIR" are one folder, whose temporary name lies beside it.
  writer->folder_ = folder.has_filename() ? folder : folder.parent_path();
  if (writer->folder_.empty()) return file_error(folder, "is no name for a recording");
  writer->part_ = writer->folder_;
  writer->part_ += ".part";
  writer->epoch_ticks_ = device.epoch_ticks_100ns.value_or(0);
  if (Status s = check_free(writer->folder_, writer->part_); !s) return s.error();
  std::error_code code;
  std::filesystem::create_directories(writer->part_, code);
  if (code) return file_error(writer->part_, "cannot be made: " + code.message());
  const auto filled = [&]() -> Status {
    if (Status s = write_calibration(writer->part_, calibration); !s) return s;
    if (Status s = write_bytes(writer->part_ / kDeviceFile, device_text(device)); !s) return s;
    if (!tools_json.empty())
      if (Status s = write_bytes(writer->part_ / kToolsFile, tools_json); !s) return s;
    return writer->open_files();
  }();
  if (!filled) {
    std::filesystem::remove_all(writer->part_, code);  // nothing was recorded in it yet
    return filled.error();
  }
  return writer;
}

Status RecordingWriter::open_files() {
  if (Status s = left_.open(tar_of(part_, kLeftSensor)); !s) return s;
  if (Status s = right_.open(tar_of(part_, kRightSensor)); !s) return s;
  if (Status s = left_poses_.open(poses_of(part_, kLeftSensor), nullptr); !s) return s;
  if (Status s = right_poses_.open(poses_of(part_, kRightSensor), nullptr); !s) return s;
  if (Status s = frames_.open(part_ / kFramesFile, kFramesHeader); !s) return s;
  if (Status s = events_.open(part_ / kEventsFile, kEventsHeader); !s) return s;
  return head_.open(part_ / kHeadFile, kHeadHeader);
}

Status RecordingWriter::frame(const StereoFrame& frame, Timestamp clock) {
  const std::int64_t ticks = epoch_ticks_ + ticks_100ns(frame.time);
  if (ticks < 0 || ticks <= last_ticks_)
    return file_error(part_, "pair at " + std::to_string(ticks) +
                                 " ticks of 100 ns cannot be told from the one at " +
                                 std::to_string(last_ticks_));
  if (Status s = left_.write(ticks, frame.left); !s) return s;
  if (Status s = right_.write(ticks, frame.right); !s) return s;
  if (frame.world_from_rig) {
    line_.clear();
    append_pose(line_, ticks, *frame.world_from_rig);
    if (Status s = left_poses_.write(line_); !s) return s;
    if (Status s = right_poses_.write(line_); !s) return s;
  }
  if (Status s = note_map(frame); !s) return s;
  line_.clear();
  append_frame(line_, {frame.sequence, frame.time, ticks, clock});
  if (Status s = frames_.write(line_); !s) return s;
  last_ticks_ = ticks;
  ++pairs_;
  return {};
}

Status RecordingWriter::note_map(const StereoFrame& frame) {
  if (frame.map_epoch == map_epoch_) return {};
  if (!map_.is_open())
    if (Status s = map_.open(part_ / kMapFile, kMapHeader); !s) return s;
  map_epoch_ = frame.map_epoch;
  line_.clear();
  append_map_move(line_, {frame.sequence, frame.map_epoch});
  return map_.write(line_);
}

Status RecordingWriter::event(const Delivered<ClickerEvent>& event) {
  std::string line;
  append_event(line, event);
  return events_.write(line);
}

Status RecordingWriter::event(const Delivered<Phrase>& event) {
  std::string line;
  append_event(line, event);
  return events_.write(line);
}

Status RecordingWriter::head_answer(std::int64_t sequence,
                                    const Tracked<Transform<World, Rig>>& answer) {
  std::string line;
  append_head_answer(line, sequence, answer);
  return head_.write(line);
}

Status RecordingWriter::close() {
  if (Status s = left_.close(); !s) return s;
  if (Status s = right_.close(); !s) return s;
  for (LineFile* file : {&left_poses_, &right_poses_, &frames_, &events_, &head_})
    if (Status s = file->close(); !s) return s;
  if (pairs_ == 0) return file_error(part_, "holds no pair: not a recording");
  if (map_.is_open())
    if (Status s = map_.close(); !s) return s;
  std::error_code code;
  std::filesystem::rename(part_, folder_, code);
  if (code) return file_error(part_, "cannot be renamed: " + code.message());
  return {};
}

}  // namespace orthonav::replay
