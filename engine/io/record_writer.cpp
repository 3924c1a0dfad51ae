#include "engine/io/record_writer.h"

#include <utility>

#include "base/guarded.h"

namespace orthonav::engine {

RecordWriter::RecordWriter(std::unique_ptr<RecordLog> log, Waits waits)
    : log_(std::move(log)),
      waits_(waits),
      durable_(log_->durable()),
      failed_(log_->failure().has_value()),
      told_(log_->durable()),
      tried_(log_->durable()),
      failure_(log_->failure()) {
  writer_ = std::thread([this] { work(); });
}

RecordWriter::~RecordWriter() {
  {
    const MutexLock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  writer_.join();
}

std::uint64_t RecordWriter::add(RecordLog::Entry entry) {
  const MutexLock lock(mutex_);
  waiting_.push_back(std::move(entry));
  const std::uint64_t number = ++told_;
  changed_.notify_all();
  if (waits_ == Waits::kUntilDurable) {
    wait_until_written(number);
  }
  return number;
}

void RecordWriter::wait_until_written(std::uint64_t number) {
  while (tried_ < number) {
    changed_.wait(mutex_);
  }
}

Status RecordWriter::finish() {
  const MutexLock lock(mutex_);
  wait_until_written(told_);
  return failure_ ? Status(*failure_) : Status{};
}

void RecordWriter::work() {
  for (;;) {
    RecordLog::Entry entry;
    {
      const MutexLock lock(mutex_);
      while (waiting_.empty() && !closing_) {
        changed_.wait(mutex_);
      }
      if (waiting_.empty()) {
        return;
      }
      entry = std::move(waiting_.front());
      waiting_.pop_front();
    }
    const Status written = guarded("operation log", [&] { return log_->append(entry); });
    {
      const MutexLock lock(mutex_);
      ++tried_;
      if (written) {
        durable_.store(log_->durable(), std::memory_order_release);
      } else {
        failure_ = written.error();
        failed_.store(true, std::memory_order_release);
      }
    }
    changed_.notify_all();
  }
}

}  // namespace orthonav::engine
