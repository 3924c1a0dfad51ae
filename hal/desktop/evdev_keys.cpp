#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>

#include "base/file_code.h"
#include "hal/desktop/key_events.h"

namespace orthonav::desktop {

namespace {

// A hand presses a few keys per second; more in one call means a device that floods.
constexpr int kMaxEventsPerPoll = 256;

Error device_error(const std::string& path, const std::string& why,
                   ErrorCode code = ErrorCode::kInvalid) {
  return Error{"clicker " + path + ": " + why, code};
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

struct FreeEvdev {
  void operator()(libevdev* device) const { libevdev_free(device); }
};

bool is_full_keyboard(const libevdev* device) {
  return libevdev_has_event_code(device, EV_KEY, KEY_Q) == 1 &&
         libevdev_has_event_code(device, EV_KEY, KEY_M) == 1;
}

bool has_one_of(const libevdev* device, const std::vector<int>& codes) {
  return std::any_of(codes.begin(), codes.end(), [&](int code) {
    return libevdev_has_event_code(device, EV_KEY, static_cast<unsigned>(code)) == 1;
  });
}

class EvdevKeys : public KeyEvents {
 public:
  explicit EvdevKeys(std::string path)
      : path_(std::move(path)), file_(::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}

  Status start() {
    if (file_.number() < 0) {
      return device_error(path_,
                          std::string("cannot be opened: ") +
                              std::generic_category().message(errno) +
                              (errno == EACCES ? " (usermod -aG input $USER)" : ""),
                          file_code(errno));
    }
    libevdev* device = nullptr;
    if (const int code = libevdev_new_from_fd(file_.number(), &device); code < 0) {
      return device_error(
          path_, std::string("is not an event device: ") + std::generic_category().message(-code));
    }
    device_.reset(device);
    if (const int code = libevdev_set_clock_id(device, CLOCK_MONOTONIC); code < 0) {
      return device_error(
          path_, std::string("keeps no monotonic time: ") + std::generic_category().message(-code));
    }
    return {};
  }
  Status choose(const KeyChoice& choice) {
    if (!has_one_of(device_.get(), choice.codes)) {
      return device_error(path_, "\"" + name() + "\" has none of the chosen keys");
    }
    if (!choice.grab || is_full_keyboard(device_.get())) {
      return {};
    }
    if (const int code = libevdev_grab(device_.get(), LIBEVDEV_GRAB); code < 0) {
      return device_error(
          path_, std::string("cannot be grabbed: ") + std::generic_category().message(-code),
          ErrorCode::kUnavailable);
    }
    return {};
  }
  [[nodiscard]] libevdev* device() const { return device_.get(); }
  [[nodiscard]] bool live() const override { return true; }
  [[nodiscard]] std::string name() const override {
    const char* text = libevdev_get_name(device_.get());
    return text ? text : "";
  }
  Status read(std::vector<KeyEvent>& events) override {
    for (int i = 0; i < kMaxEventsPerPoll; ++i) {
      input_event event{};
      // After a flood the kernel drops events; libevdev then reports the state of every key.
      const int code = libevdev_next_event(
          device_.get(), syncing_ ? LIBEVDEV_READ_FLAG_SYNC : LIBEVDEV_READ_FLAG_NORMAL, &event);
      if (code == -EAGAIN && !syncing_) {
        return {};
      }
      if (code == -EAGAIN) {
        syncing_ = false;
        continue;
      }
      if (code < 0) {
        return device_error(path_,
                            std::string("is gone: ") + std::generic_category().message(-code),
                            ErrorCode::kLost);
      }
      syncing_ = code == LIBEVDEV_READ_STATUS_SYNC;
      if (event.type == EV_KEY && event.value != kRepeat) {
        events.push_back({event.code, event.value != 0,
                          std::chrono::seconds(event.input_event_sec) +
                              std::chrono::microseconds(event.input_event_usec)});
      }
    }
    return {};
  }

 private:
  static constexpr int kRepeat = 2;
  std::string path_;
  FileDescriptor file_;  // outlives the device that reads it
  std::unique_ptr<libevdev, FreeEvdev> device_;
  bool syncing_ = false;
};

}  // namespace

const std::vector<int>& clicker_keys() {
  static const std::vector<int> codes = {
      KEY_VOLUMEUP, KEY_VOLUMEDOWN, KEY_ENTER, KEY_KPENTER, KEY_PAGEUP, KEY_PAGEDOWN, KEY_SPACE,
      KEY_CAMERA,   BTN_0,          BTN_1,     BTN_LEFT,    BTN_SOUTH,  BTN_TRIGGER};
  return codes;
}

int key_code(const std::string& name) {
  std::string upper;
  for (const char c : name) {
    upper += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  }
  const int code = libevdev_event_code_from_name(EV_KEY, upper.c_str());
  return code >= 0 ? code : libevdev_event_code_from_name(EV_KEY, ("KEY_" + upper).c_str());
}

Result<std::unique_ptr<KeyEvents>> open_evdev_keys(const std::string& path,
                                                   const KeyChoice& choice) {
  auto keys = std::make_unique<EvdevKeys>(path);
  if (Status started = keys->start(); !started) {
    return started.error();
  }
  if (Status chosen = keys->choose(choice); !chosen) {
    return chosen.error();
  }
  return std::unique_ptr<KeyEvents>(std::move(keys));
}

Result<KeyDevice> describe_evdev(const std::string& path) {
  EvdevKeys keys(path);
  if (Status started = keys.start(); !started) {
    return started.error();
  }
  return KeyDevice{path, keys.name(), is_full_keyboard(keys.device())};
}

}  // namespace orthonav::desktop
