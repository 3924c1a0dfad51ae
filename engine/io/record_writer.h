#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <thread>

#include "base/mutex.h"
#include "engine/io/record_log.h"

namespace orthonav::engine {

/// Writes to a log on a separate thread, so that a slow disk does not stall the caller.
class RecordWriter {
 public:
  enum class Waits : std::uint8_t {
    kNot,          ///< `add` returns at once
    kUntilDurable  ///< `add` waits for the disk: for simulations, whose time does not advance
                   ///< meanwhile
  };
  RecordWriter(std::unique_ptr<RecordLog> log, Waits waits);
  /// Writes everything added before.
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// Returns the record's number.
  std::uint64_t add(RecordLog::Entry entry);
  /// Waits until everything added is durable, or the log has failed.
  Status finish();

  // From any thread, without waiting.
  /// Number of the newest durable record.
  [[nodiscard]] std::uint64_t durable() const { return durable_.load(std::memory_order_acquire); }
  [[nodiscard]] bool failed() const { return failed_.load(std::memory_order_acquire); }

  [[nodiscard]] const std::string& path() const { return log_->path(); }
  [[nodiscard]] const std::string& earlier_kept_as() const { return log_->earlier_kept_as(); }

 private:
  void work();
  void wait_until_written(std::uint64_t number) ORTHONAV_REQUIRES(mutex_);

  std::unique_ptr<RecordLog> log_;  ///< used only by the thread, except for its names
  Waits waits_;
  std::atomic<std::uint64_t> durable_;
  std::atomic<bool> failed_;

  Mutex mutex_;
  ConditionVariable changed_;
  std::deque<RecordLog::Entry> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::uint64_t told_ ORTHONAV_GUARDED_BY(mutex_);
  std::uint64_t tried_ ORTHONAV_GUARDED_BY(mutex_);
  bool closing_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::optional<Error> failure_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread writer_;
};

}  // namespace orthonav::engine
