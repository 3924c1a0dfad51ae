#include "engine/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/sync_path.h"
#include "engine/io/file_names.h"
#include "engine/io/folders.h"

namespace orthonav::engine {
namespace fs = std::filesystem;
namespace {

/// The file at the end of a chain of symbolic links; the name itself where there is no link.
fs::path followed(fs::path path) {
  std::error_code ignored;
  for (int links = 0; links < 16 && fs::is_symlink(path, ignored); ++links) {
    const fs::path target = fs::read_symlink(path, ignored);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

std::string way_to(int file) { return "/proc/self/fd/" + std::to_string(file); }

/// `name` stands for it in an Error.
Status made_durable(const std::string& path, const std::string& name) {
  const PathSync synced = sync_path(path);
  if (synced.error_number == 0) {
    return {};
  }
  return file_error(name, synced.opened ? "cannot be written" : "cannot be opened",
                    synced.error_number);
}

/// The descriptor of a file without a name in that folder, which /proc lets us open and link by
/// its number; -1 where that can't be had.
int nameless_file(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (file >= 0 && ::access(way_to(file).c_str(), W_OK) != 0) {
    ::close(file);
    return -1;
  }
  return file;
}

/// A free name beside the target: "report.part-4711-0.json".
std::string name_beside(const fs::path& target, int attempt) {
  const std::string name = target.stem().string() + ".part-" + std::to_string(::getpid()) + "-" +
                           std::to_string(attempt) + target.extension().string();
  return (target.parent_path() / name).string();
}

constexpr int kMaxAttempts = 1000;

Error too_many_beside(const std::string& path) {
  return Error{path + ": 1000 unfinished writes lie beside it, remove them"};
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::string& path, Staging staging) {
  if (path.empty()) {
    return Error{"a file to write has no name"};
  }
  std::error_code ignored;
  const fs::path target = followed(path);
  if (fs::is_directory(target, ignored)) {
    return Error{path + ": is a folder, not a file"};
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    return AtomicFile(target.string(), target.string());
  }
  const fs::path folder = folder_of(target.string());
  if (!fs::is_directory(folder, ignored)) {
    return Error{path + ": folder " + folder.string() + " does not exist", ErrorCode::kNotFound};
  }
  if (staging == Staging::kNameless) {
    if (const int file = nameless_file(folder); file >= 0) {
      return AtomicFile(way_to(file), target.string(), file);
    }
  }
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    const std::string beside = name_beside(target, attempt);
    const int file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      return AtomicFile(beside, target.string());
    }
    if (errno != EEXIST) {
      return file_error(path, "cannot be written", errno);
    }
  }
  return too_many_beside(path);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : temporary_path_(std::move(other.temporary_path_)),
      final_path_(std::move(other.final_path_)),
      nameless_(std::exchange(other.nameless_, -1)),
      open_(std::exchange(other.open_, false)) {}

AtomicFile::~AtomicFile() { drop(); }

void AtomicFile::drop() noexcept {
  if (nameless_ >= 0) {
    ::close(std::exchange(nameless_, -1));
  } else if (open_ && temporary_path_ != final_path_) {
    ::unlink(temporary_path_.c_str());
  }
  open_ = false;
}

bool AtomicFile::keep() {
  if (!open_ || nameless_ >= 0) {
    return false;
  }
  open_ = false;
  return true;
}

/// A link replaces no file, a rename does: where the target exists, the file takes a name beside it
/// for that moment.
Status AtomicFile::take_a_name() {
  for (int attempt = -1; attempt < kMaxAttempts; ++attempt) {
    const std::string name = attempt < 0 ? final_path_ : name_beside(final_path_, attempt);
    if (::linkat(AT_FDCWD, temporary_path_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) ==
        0) {
      temporary_path_ = name;
      ::close(std::exchange(nameless_, -1));
      return {};
    }
    if (errno != EEXIST) {
      return file_error(final_path_, "cannot be written", errno);
    }
  }
  return too_many_beside(final_path_);
}

Status AtomicFile::commit() {
  if (!open_) {
    return Error{final_path_ + ": was committed before"};
  }
  if (temporary_path_ == final_path_) {
    open_ = false;
    return {};
  }
  if (Status durable = made_durable(temporary_path_, final_path_); !durable) {
    return durable;
  }
  if (nameless_ >= 0) {
    if (Status named = take_a_name(); !named) {
      return named;
    }
  }
  if (temporary_path_ != final_path_ &&
      ::rename(temporary_path_.c_str(), final_path_.c_str()) != 0) {
    return file_error(final_path_, "cannot be written", errno);
  }
  open_ = false;
  return sync_folder(folder_of(final_path_));
}

Status check_place(const std::string& path) {
  const auto file = AtomicFile::create(path);
  return file ? Status{} : Status{file.error()};
}

Status write_file(const std::string& path, std::string_view content) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) {
    return file.error();
  }
  std::ofstream out(file->temporary_path(), std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) {
    return Error{path + ": cannot be written whole (disk full?)", ErrorCode::kIo};
  }
  return file->commit();
}

}  // namespace orthonav::engine
