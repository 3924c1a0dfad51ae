#include "tools/orthonav/shared/unblocked_output.h"

#include <poll.h>
#include <unistd.h>
#include <ext/stdio_sync_filebuf.h>

#include <cerrno>
#include <chrono>
#include <deque>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "base/check.h"
#include "base/guarded.h"
#include "base/how_many.h"
#include "base/mutex.h"
#include "base/stopwatch.h"

namespace orthonav::tools {

namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 10U;
/// How long an end waits for an output that takes nothing.
constexpr auto kMoment = std::chrono::milliseconds(500);

}  // namespace

struct UnblockedOutput::State {
  State(int file, Closes after) : descriptor(file), closes(after) {}

  const int descriptor;
  const Closes closes;
  Mutex mutex;
  ConditionVariable changed;
  std::deque<std::string> waiting ORTHONAV_GUARDED_BY(mutex);
  std::size_t bytes ORTHONAV_GUARDED_BY(mutex) = 0;  ///< that wait
  bool writing ORTHONAV_GUARDED_BY(mutex) = false;
  bool over ORTHONAV_GUARDED_BY(mutex) = false;
  std::int64_t lost ORTHONAV_GUARDED_BY(mutex) = 0;
  std::int64_t lost_here ORTHONAV_GUARDED_BY(mutex) = 0;  ///< and not yet said
  int error_number ORTHONAV_GUARDED_BY(mutex) = 0;

  void lose(std::int64_t count) ORTHONAV_REQUIRES(mutex) {
    lost += count;
    lost_here += count;
  }
  void work() {
    while (const std::optional<std::string> text = next()) {
      const int problem = write(*text);
      const MutexLock lock(mutex);
      if (problem != 0) {
        lose(1);
        error_number = error_number == 0 ? problem : error_number;
      }
      writing = false;
      changed.notify_all();
    }
    if (closes == Closes::kAtTheEnd) {
      ::close(descriptor);
    }
  }
  /// Waits for it; absent at the end.
  std::optional<std::string> next() {
    const MutexLock lock(mutex);
    while (waiting.empty() && !over) {
      changed.wait(mutex);
    }
    if (waiting.empty()) {
      return std::nullopt;
    }
    std::string text = std::move(waiting.front());
    waiting.pop_front();
    bytes -= text.size();
    writing = true;
    if (lost_here > 0) {
      text = "orthonav: missing here, since they could not be written in time: " +
             how_many(std::exchange(lost_here, 0), "line") + "\n" + text;
    }
    return text;
  }
  /// 0, or the number of the error. May wait for ever.
  int write(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
      if (n >= 0) {
        done += static_cast<std::size_t>(n);
      } else if (errno == EAGAIN) {
        pollfd taken{descriptor, POLLOUT, 0};
        ::poll(&taken, 1, -1);
      } else if (errno != EINTR) {
        return errno;
      }
    }
    return 0;
  }
};

UnblockedOutput::UnblockedOutput(int descriptor, Closes closes)
    : state_(std::make_shared<State>(descriptor, closes)) {
  std::thread([state = state_] {
    const Status worked = guarded("output", [&] { state->work(); });
    static_cast<void>(worked);  // what waits is lost, and there is nowhere to say it
  }).detach();
}

UnblockedOutput::~UnblockedOutput() {
  settle();
  const MutexLock lock(state_->mutex);
  state_->over = true;
  state_->changed.notify_all();
}

void UnblockedOutput::add(std::string_view text) noexcept {
  const MutexLock lock(state_->mutex);
  try {
    auto& waiting = state_->waiting;
    if (text.starts_with('\r') && !waiting.empty() && waiting.back().starts_with('\r')) {
      state_->bytes -= waiting.back().size();
      waiting.pop_back();
    }
    waiting.emplace_back(text);
    state_->bytes += text.size();
    while (state_->bytes > kMostBytes) {
      state_->bytes -= waiting.front().size();
      waiting.pop_front();
      state_->lose(1);
    }
  } catch (...) {
    state_->lose(1);  // out of memory
  }
  state_->changed.notify_all();
}

bool UnblockedOutput::settle() {
  const auto latest = Stopwatch().after(kMoment);
  const MutexLock lock(state_->mutex);
  while ((!state_->waiting.empty() || state_->writing) &&
         state_->changed.wait_until(state_->mutex, latest)) {
  }
  return state_->waiting.empty() && !state_->writing;
}

std::int64_t UnblockedOutput::lost() const {
  const MutexLock lock(state_->mutex);
  return state_->lost;
}

int UnblockedOutput::error_number() const {
  const MutexLock lock(state_->mutex);
  return state_->error_number;
}

UnblockedStandardError::UnblockedStandardError()
    : output_(STDERR_FILENO, UnblockedOutput::Closes::kNever), stderr_before_(stderr) {
  cookie_io_functions_t calls{};
  calls.write = [](void* output, const char* text, std::size_t size) -> ssize_t {
    static_cast<UnblockedOutput*>(output)->add({text, size});
    return static_cast<ssize_t>(size);
  };
  file_ = ::fopencookie(&output_, "w", calls);
  ORTHONAV_CHECK(file_ != nullptr);
  std::setvbuf(file_, nullptr, _IONBF, 0);
  stderr = file_;
  buffer_ = std::make_unique<__gnu_cxx::stdio_sync_filebuf<char>>(file_);
  cerr_before_ = std::cerr.rdbuf(buffer_.get());
}

UnblockedStandardError::~UnblockedStandardError() {
  std::cerr.rdbuf(cerr_before_);
  stderr = stderr_before_;
  std::fclose(file_);
}

}  // namespace orthonav::tools
