#include "engine/io/posix_env.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/write_all.h"
#include "engine/io/file_names.h"
#include "engine/io/folders.h"

namespace orthonav::engine {
namespace fs = std::filesystem;
namespace {

constexpr const char* kReading = "cannot be read";
constexpr const char* kWriting = "cannot be written";

/// A descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int file) : file_(file) {}
  ~Descriptor() {
    if (file_ >= 0) {
      ::close(file_);
    }
  }
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  [[nodiscard]] int get() const { return file_; }
  [[nodiscard]] bool open() const { return file_ >= 0; }

 private:
  int file_;
};

class PosixFile : public AppendFile {
 public:
  PosixFile(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  Status append(std::string_view bytes) override {
    const int problem = write_all(file_.get(), bytes);
    return problem == 0 ? Status{} : file_error(path_, kWriting, problem);
  }

  Status sync() override {
    return ::fsync(file_.get()) == 0 ? Status{} : file_error(path_, kWriting, errno);
  }

 private:
  std::string path_;
  Descriptor file_;
};

class PosixLock : public FolderLock {
 public:
  explicit PosixLock(Descriptor folder) : folder_(std::move(folder)) {}

 private:
  Descriptor folder_;
};

}  // namespace

Error folder_in_use(const std::string& folder) {
  return {folder + ": is in use by another operation", ErrorCode::kUnavailable};
}

Result<std::unique_ptr<AppendFile>> PosixEnv::open_append(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (!file.open()) {
    return file_error(path, kWriting, errno);
  }
  return std::unique_ptr<AppendFile>(std::make_unique<PosixFile>(path, std::move(file)));
}

Result<std::string> PosixEnv::read(const std::string& path, std::size_t most_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.open()) {
    return file_error(path, kReading, errno);
  }
  std::string bytes;
  std::array<char, 1u << 16u> block{};
  for (;;) {
    const ssize_t count = ::read(file.get(), block.data(), block.size());
    if (count == 0) {
      return bytes;
    }
    if (count < 0 && errno != EINTR) {
      return file_error(path, kReading, errno);
    }
    bytes.append(block.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (bytes.size() > most_bytes) {
      return Error{path + ": is larger than " + std::to_string(most_bytes >> 20u) + " MiB"};
    }
  }
}

Result<std::vector<std::string>> PosixEnv::list(const std::string& folder) {
  std::error_code problem;
  std::vector<std::string> names;
  fs::directory_iterator entry(folder, problem);
  for (; !problem && entry != fs::directory_iterator(); entry.increment(problem)) {
    names.push_back(entry->path().filename().string());
  }
  if (problem) {
    return file_error(folder, kReading, problem.value());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Status PosixEnv::rename(const std::string& from, const std::string& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? Status{} : file_error(to, kWriting, errno);
}

Status PosixEnv::truncate(const std::string& path, std::size_t bytes) {
  return ::truncate(path.c_str(), static_cast<off_t>(bytes)) == 0
             ? Status{}
             : file_error(path, kWriting, errno);
}

Status PosixEnv::remove(const std::string& path) {
  return ::unlink(path.c_str()) == 0 ? Status{} : file_error(path, "cannot be removed", errno);
}

Status PosixEnv::sync_folder(const std::string& folder) { return engine::sync_folder(folder); }

Result<std::unique_ptr<FolderLock>> PosixEnv::lock(const std::string& folder) {
  Descriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!file.open()) {
    return file_error(folder, "cannot be opened", errno);
  }
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    return errno == EWOULDBLOCK ? folder_in_use(folder)
                                : file_error(folder, "cannot be locked", errno);
  }
  return std::unique_ptr<FolderLock>(std::make_unique<PosixLock>(std::move(file)));
}

}  // namespace orthonav::engine
