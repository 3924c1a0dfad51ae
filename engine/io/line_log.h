#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "base/mutex.h"
#include "base/result.h"

namespace orthonav::engine {

/// A text file that grows by whole lines as PATH.part and is named PATH by `finish`. A separate
/// thread writes each line in one piece, so a slow disk does not stall the caller, and a killed
/// process leaves whole lines. Existing files are not overwritten but renamed to PATH-1, PATH-2,
/// ... (before the extension).
class LineLog {
 public:
  /// Refuses a missing or unwritable folder, and a PATH.part that another process is writing. The
  /// new name is durable; if that fails, `finish` reports it.
  static Result<std::unique_ptr<LineLog>> create(const std::string& path);
  /// Without `finish`, the file stays as PATH.part, unless only the first line was written: then it
  /// is removed.
  ~LineLog();
  LineLog(const LineLog&) = delete;
  LineLog& operator=(const LineLog&) = delete;

  /// Whether the line must survive a loss of power as well.
  enum class Keep { kWritten, kDurable };
  /// Adds a line, given without its end. It is in the file when this returns, unless the disk takes
  /// longer than a millisecond.
  void add(std::string line, Keep keep = Keep::kWritten);
  /// Waits until every line is on the disk and names the file. An Error if a line could not be
  /// written, or may not survive a loss of power because a sync failed; the lines written are still
  /// there.
  Status finish();

  /// The new name of an earlier file; empty: there was none.
  [[nodiscard]] const std::string& earlier_kept_as() const { return earlier_kept_as_; }

 private:
  struct Line {
    std::string text;
    Keep keep = Keep::kWritten;
  };
  LineLog(std::string path, int file);
  void work();
  void sync(int (*how)(int));
  void note(const char* what, const Status& done);
  void stop_writing();
  Status take_its_name();

  std::string path_;
  int file_ = -1;  ///< written by the thread alone
  std::string earlier_kept_as_;
  bool finished_ = false;
  bool sync_failed_ = false;  ///< used by the thread, while there is one

  Mutex mutex_;
  ConditionVariable changed_;
  std::deque<Line> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::size_t told_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::size_t written_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  bool closing_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::optional<Error> failure_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread writer_;
};

}  // namespace orthonav::engine
