#include <fcntl.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/file_code.h"
#include "hal/desktop/key_events.h"

namespace orthonav::desktop {

namespace {

constexpr std::size_t kMaxEventsPerRead = 256;

class RecordedKeys : public KeyEvents {
 public:
  RecordedKeys(std::string path, int file, bool live)
      : path_(std::move(path)), file_(file), live_(live) {}
  ~RecordedKeys() override { ::close(file_); }
  RecordedKeys(const RecordedKeys&) = delete;
  RecordedKeys& operator=(const RecordedKeys&) = delete;

  [[nodiscard]] bool live() const override { return live_; }
  [[nodiscard]] std::string name() const override { return path_; }
  Status read(std::vector<KeyEvent>& events) override {
    std::array<char, kMaxEventsPerRead * sizeof(input_event)> bytes;
    const ssize_t count = ::read(file_, bytes.data(), bytes.size() - rest_size_);
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
      return Error{
          "clicker " + path_ + ": cannot be read: " + std::generic_category().message(errno),
          ErrorCode::kIo};
    }
    for (ssize_t i = 0; i < count; ++i) {
      rest_[rest_size_++] = bytes[static_cast<std::size_t>(i)];
      if (rest_size_ < sizeof(input_event)) {
        continue;
      }
      rest_size_ = 0;
      if (Status taken = take(events); !taken) {
        return taken;
      }
    }
    return {};
  }

 private:
  std::string path_;
  int file_;
  bool live_;
  std::array<char, sizeof(input_event)> rest_{};  ///< of an event that is still incomplete
  std::size_t rest_size_ = 0;
  std::optional<Duration> first_;

  Status take(std::vector<KeyEvent>& events) {
    input_event event{};
    std::memcpy(&event, rest_.data(), sizeof(event));
    constexpr long kMaxSeconds = 4'000'000'000;  // a hundred years
    if (event.input_event_sec < 0 || event.input_event_sec > kMaxSeconds ||
        event.input_event_usec < 0 || event.input_event_usec >= 1'000'000) {
      return Error{"clicker " + path_ + ": time " + std::to_string(event.input_event_sec) + " s " +
                   std::to_string(event.input_event_usec) + " us is not the time of an event"};
    }
    const Duration at = std::chrono::seconds(event.input_event_sec) +
                        std::chrono::microseconds(event.input_event_usec);
    if (!first_) {
      first_ = at;
    }
    // 2 is a keyboard's repeat.
    if (event.type == EV_KEY && event.value != 2) {
      events.push_back({event.code, event.value != 0, live_ ? at : at - *first_});
    }
    return {};
  }
};

}  // namespace

Result<std::unique_ptr<KeyEvents>> open_recorded_keys(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return Error{"clicker " + path + ": " + std::generic_category().message(errno),
                 file_code(errno)};
  }
  const bool fifo = S_ISFIFO(status.st_mode);
  if (!fifo && !S_ISREG(status.st_mode)) {
    return Error{"clicker " + path +
                 ": is neither an event device nor a file of events nor a FIFO"};
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    return Error{
        "clicker " + path + ": cannot be opened: " + std::generic_category().message(errno),
        file_code(errno)};
  }
  return std::unique_ptr<KeyEvents>(std::make_unique<RecordedKeys>(path, file, fifo));
}

}  // namespace orthonav::desktop
