#include "engine/io/line_log.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/guarded.h"
#include "base/stopwatch.h"
#include "engine/io/file_names.h"
#include "engine/io/folders.h"

namespace orthonav::engine {
namespace fs = std::filesystem;
namespace {

/// The frame loop waits no longer than this for a slow disk.
constexpr auto kMostWait = std::chrono::milliseconds(1);

Error log_error(const std::string& path, int error_number) {
  return file_error(path, "cannot be written", error_number);
}

std::string unfinished(const std::string& path) { return path + ".part"; }

/// 0, or the number of the error: EEXIST where the name is taken.
int renamed_to_free(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
    return 0;
  }
  if (errno != EINVAL) {
    return errno;
  }
  // A file system without that flag.
  std::error_code ignored;
  if (fs::exists(to, ignored)) {
    return EEXIST;
  }
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// Moves a file to the first free name of earlier ones; returns that name.
Result<std::string> moved_aside(const std::string& file, const std::string& path) {
  for (int number = 1; number <= kMostEarlier; ++number) {
    std::string name = earlier_name(path, number);
    const int problem = renamed_to_free(file, name);
    if (problem == 0) {
      return name;
    }
    if (problem != EEXIST) {
      return log_error(file, problem);
    }
  }
  return too_many_earlier(path);
}

/// A process that writes a log holds a lock on it as long as it runs.
Status refuse_if_written(const std::string& part) {
  const int file = ::open(part.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return {};
  }
  const bool free = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  ::close(file);
  return free ? Status{} : Error{part + ": is being written by another process"};
}

/// All of it or nothing, so that a full disk leaves no torn line for the next one to follow.
bool write_whole(int file, const std::string& text) {
  const off_t before = ::lseek(file, 0, SEEK_END);
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n >= 0) {
      done += static_cast<std::size_t>(n);
    } else if (errno != EINTR) {
      const int why = errno;
      const bool taken_back = ::ftruncate(file, before) == 0;
      errno = taken_back ? why : EIO;
      return false;
    }
  }
  return true;
}

}  // namespace

Result<std::unique_ptr<LineLog>> LineLog::create(const std::string& path) {
  const std::string part = unfinished(path);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return Error{path + ": is a folder, not a file"};
  }
  std::string earlier;
  Status durable;
  if (fs::is_regular_file(part, ignored)) {
    if (const Status free = refuse_if_written(part); !free) {
      return free.error();
    }
    auto moved = moved_aside(part, path);
    if (!moved) {
      return moved.error();
    }
    earlier = std::move(*moved);
    durable = sync_folder(folder_of(path));
  }
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) {
    return log_error(part, errno);
  }
  ::flock(file, LOCK_EX | LOCK_NB);
  durable = durable ? sync_folder(folder_of(path)) : durable;
  std::unique_ptr<LineLog> log(new LineLog(path, file));
  log->earlier_kept_as_ = std::move(earlier);
  log->note("its name may not outlast a loss of power: ", durable);
  return log;
}

LineLog::LineLog(std::string path, int file) : path_(std::move(path)), file_(file) {
  writer_ = std::thread([this] { work(); });
}

LineLog::~LineLog() {
  stop_writing();
  ::close(file_);
  const MutexLock lock(mutex_);
  if (!finished_ && told_ <= 1) {
    ::unlink(unfinished(path_).c_str());
  }
}

void LineLog::add(std::string line, Keep keep) {
  line += '\n';
  const auto latest = Stopwatch().after(kMostWait);
  const MutexLock lock(mutex_);
  waiting_.push_back({std::move(line), keep});
  const std::size_t number = ++told_;
  changed_.notify_all();
  while (written_ < number && changed_.wait_until(mutex_, latest)) {
  }
}

void LineLog::work() {
  for (;;) {
    Line line;
    {
      const MutexLock lock(mutex_);
      while (waiting_.empty() && !closing_) {
        changed_.wait(mutex_);
      }
      if (waiting_.empty()) {
        return;
      }
      line = std::move(waiting_.front());
      waiting_.pop_front();
    }
    const Status whole = guarded("journal", [&] {
      return write_whole(file_, line.text) ? Status{} : log_error(unfinished(path_), errno);
    });
    note("not every line could be written: ", whole);
    {
      const MutexLock lock(mutex_);
      ++written_;
    }
    changed_.notify_all();
    if (whole && line.keep == Keep::kDurable) {
      sync(::fdatasync);
    }
  }
}

/// After a failed sync no other is tried: it could succeed without the data that the first one
/// lost.
void LineLog::sync(int (*how)(int)) {
  if (!sync_failed_ && how(file_) != 0) {
    sync_failed_ = true;
    note("not every line may outlast a loss of power: ", log_error(unfinished(path_), errno));
  }
}

/// Keeps the first failure, which `finish` returns.
void LineLog::note(const char* what, const Status& done) {
  const MutexLock lock(mutex_);
  if (!done && !failure_) {
    failure_ = Error{what + done.error().message, done.error().code};
  }
}

void LineLog::stop_writing() {
  {
    const MutexLock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  if (writer_.joinable()) {
    writer_.join();
  }
}

Status LineLog::take_its_name() {
  std::error_code ignored;
  if (fs::is_regular_file(path_, ignored)) {
    auto moved = moved_aside(path_, path_);
    if (!moved) {
      return moved.error();
    }
    earlier_kept_as_ += (earlier_kept_as_.empty() ? "" : ", ") + *moved;
    // This must be durable before the new file takes the name, otherwise a crash could leave only
    // the new one.
    if (Status durable = sync_folder(folder_of(path_)); !durable) {
      return durable;
    }
  }
  if (::rename(unfinished(path_).c_str(), path_.c_str()) != 0) {
    return log_error(path_, errno);
  }
  return sync_folder(folder_of(path_));
}

Status LineLog::finish() {
  if (std::exchange(finished_, true)) {
    return Error{path_ + ": was finished before"};
  }
  stop_writing();
  sync(::fsync);
  Status named = take_its_name();
  const MutexLock lock(mutex_);
  return failure_ ? Status(*failure_) : named;
}

}  // namespace orthonav::engine
