#include <fcntl.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <optional>
#include <system_error>

#include "base/file_code.h"
#include "base/printed.h"
#include "hal/desktop/key_events.h"

namespace orthonav::desktop {

namespace {

constexpr std::size_t kEventsPerRead = 256;

Error source_error(const std::string& path, const std::string& why,
                   ErrorCode code = ErrorCode::kInvalid) {
  return Error{"clicker " + path + ": " + why, code};
}

std::string seconds_text(Duration time) { return printed("%.3f s", seconds(time)); }

Duration read_clock(clockid_t id) {
  timespec now{};
  ::clock_gettime(id, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// The time of an event as it is stamped, by whichever clock. Refuses what no clock shows.
Result<Duration> stamp_of(const input_event& event, const std::string& path) {
  constexpr long kMaxSeconds = 4'000'000'000;  // a hundred years
  if (event.input_event_sec < 0 || event.input_event_sec > kMaxSeconds ||
      event.input_event_usec < 0 || event.input_event_usec >= 1'000'000) {
    return source_error(path, "time " + std::to_string(event.input_event_sec) + " s " +
                                  std::to_string(event.input_event_usec) +
                                  " us is not the time of an event");
  }
  return Duration(std::chrono::seconds(event.input_event_sec) +
                  std::chrono::microseconds(event.input_event_usec));
}

void append(const input_event& event, Duration at, std::vector<KeyEvent>& events) {
  // 2 is a keyboard's repeat.
  if (event.type == EV_KEY && event.value != 2) {
    events.push_back({event.code, event.value != 0, at});
  }
}

/// A file, read and checked as a whole when it is opened: what is wrong with it is said then, and
/// nothing can happen to it later.
class RecordedKeys : public KeyEvents {
 public:
  explicit RecordedKeys(std::string path) : path_(std::move(path)) {}

  Status load(int file, off_t size, const std::vector<int>& codes) {
    constexpr off_t kMaxSize = 16 << 20;
    if (size > kMaxSize) {
      return source_error(path_, "has " + std::to_string(size) + " bytes, limit 16 MiB");
    }
    std::string bytes(static_cast<std::size_t>(size), '\0');
    std::size_t have = 0;
    for (ssize_t got = 1; got > 0 && have < bytes.size(); have += static_cast<std::size_t>(got)) {
      got = ::read(file, bytes.data() + have, bytes.size() - have);
      if (got < 0) {
        return source_error(path_, "cannot be read: " + std::generic_category().message(errno),
                            ErrorCode::kIo);
      }
    }
    if (have == 0 || have % sizeof(input_event) != 0) {
      return source_error(path_, "holds " + std::to_string(have) + " bytes, not input events of " +
                                     std::to_string(sizeof(input_event)) + " bytes each");
    }
    std::optional<Duration> first;
    Duration last{};
    for (std::size_t i = 0; i < have; i += sizeof(input_event)) {
      input_event event{};
      std::memcpy(&event, bytes.data() + i, sizeof(event));
      const auto stamp = stamp_of(event, path_);
      if (!stamp) {
        return stamp.error();
      }
      first = first.value_or(*stamp);
      last = i == 0 ? *stamp : last;
      // Longer than any operation; between the kernel's clocks lie years.
      constexpr Duration kLongestPause = std::chrono::hours(24);
      if (*stamp < last || *stamp - last > kLongestPause) {
        return source_error(path_, "event " + std::to_string(i / sizeof(input_event) + 1) +
                                       " is stamped " + seconds_text(*stamp) +
                                       ", the one before it " + seconds_text(last) +
                                       ": the clock changed in between");
      }
      last = *stamp;
      append(event, *stamp - *first, events_);
    }
    if (std::ranges::none_of(events_, [&](const KeyEvent& event) {
          return event.down && std::ranges::find(codes, event.code) != codes.end();
        })) {
      return source_error(path_, "none of the chosen keys is pressed in it");
    }
    return {};
  }
  [[nodiscard]] bool live() const override { return false; }
  [[nodiscard]] std::string name() const override { return path_; }
  Status read(std::vector<KeyEvent>& events) override {
    const std::size_t end = std::min(events_.size(), next_ + kEventsPerRead);
    events.insert(events.end(), events_.begin() + static_cast<std::ptrdiff_t>(next_),
                  events_.begin() + static_cast<std::ptrdiff_t>(end));
    next_ = end;
    return {};
  }

 private:
  std::string path_;
  std::vector<KeyEvent> events_;
  std::size_t next_ = 0;
};

/// A FIFO, into which another program writes what it reads from a device.
class PipedKeys : public KeyEvents {
 public:
  PipedKeys(std::string path, int file) : path_(std::move(path)), file_(file) {}
  ~PipedKeys() override { ::close(file_); }
  PipedKeys(const PipedKeys&) = delete;
  PipedKeys& operator=(const PipedKeys&) = delete;

  [[nodiscard]] bool live() const override { return true; }
  [[nodiscard]] std::string name() const override { return path_; }
  Status read(std::vector<KeyEvent>& events) override {
    std::array<char, kEventsPerRead * sizeof(input_event)> bytes;
    const ssize_t count = ::read(file_, bytes.data(), bytes.size() - rest_size_);
    if (count == 0) {
      rest_size_ = 0;
      return source_error(path_, "nobody writes to it", ErrorCode::kUnavailable);
    }
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
      return source_error(path_, "cannot be read: " + std::generic_category().message(errno),
                          ErrorCode::kIo);
    }
    Status refused;
    for (ssize_t i = 0; i < count; ++i) {
      rest_[rest_size_++] = bytes[static_cast<std::size_t>(i)];
      if (rest_size_ < sizeof(input_event)) {
        continue;
      }
      rest_size_ = 0;
      if (Status taken = take(events); !taken && refused) {
        refused = taken;
      }
    }
    return refused;
  }

 private:
  std::string path_;
  int file_;
  std::array<char, sizeof(input_event)> rest_{};  ///< of an event that is still incomplete
  std::size_t rest_size_ = 0;

  Status take(std::vector<KeyEvent>& events) {
    input_event event{};
    std::memcpy(&event, rest_.data(), sizeof(event));
    const auto stamp = stamp_of(event, path_);
    if (!stamp) {
      return stamp.error();
    }
    const auto age = age_of(*stamp);
    if (!age) {
      return age.error();
    }
    append(event, read_clock(CLOCK_MONOTONIC) - *age, events);
    return {};
  }
  /// A device stamps by CLOCK_REALTIME unless its reader asks for another clock, which the writer
  /// may have done: the clock that the stamp is nearest to is the one.
  [[nodiscard]] Result<Duration> age_of(Duration stamp) const {
    constexpr Duration kOldest = std::chrono::seconds(10);
    // Of another machine whose clock is set by the network.
    constexpr Duration kAhead = std::chrono::seconds(1);
    std::optional<Duration> age;
    for (const clockid_t id : {CLOCK_MONOTONIC, CLOCK_REALTIME, CLOCK_BOOTTIME}) {
      const Duration by_this = read_clock(id) - stamp;
      age = age && std::chrono::abs(*age) <= std::chrono::abs(by_this) ? *age : by_this;
    }
    if (*age > kOldest || *age < -kAhead) {
      return source_error(path_, "an event stamped " + seconds_text(stamp) +
                                     " is not of the last 10 s, neither by the realtime clock (" +
                                     seconds_text(read_clock(CLOCK_REALTIME)) +
                                     ") nor since the start of the machine (" +
                                     seconds_text(read_clock(CLOCK_MONOTONIC)) + ")");
    }
    return std::max(*age, Duration::zero());
  }
};

}  // namespace

Result<std::unique_ptr<KeyEvents>> open_recorded_keys(const std::string& path,
                                                      const std::vector<int>& codes) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return source_error(path, std::generic_category().message(errno), file_code(errno));
  }
  const bool fifo = S_ISFIFO(status.st_mode);
  if (!fifo && !S_ISREG(status.st_mode)) {
    return source_error(path, "is neither an event device nor a file of events nor a FIFO");
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    return source_error(path, "cannot be opened: " + std::generic_category().message(errno),
                        file_code(errno));
  }
  if (fifo) {
    return std::unique_ptr<KeyEvents>(std::make_unique<PipedKeys>(path, file));
  }
  auto keys = std::make_unique<RecordedKeys>(path);
  const Status loaded = keys->load(file, status.st_size, codes);
  ::close(file);
  if (!loaded) {
    return loaded.error();
  }
  return std::unique_ptr<KeyEvents>(std::move(keys));
}

}  // namespace orthonav::desktop
