#include "hal/desktop/evdev_clicker.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "base/joined.h"

namespace orthonav::desktop {

namespace {

/// More undelivered changes of a button than this do not come from a hand.
constexpr std::size_t kMaxChanges = 1024;

/// CLOCK_MONOTONIC, by which the kernel stamps events.
Duration monotonic_now() { return std::chrono::steady_clock::now().time_since_epoch(); }

bool is_device(const std::string& path) {
  std::error_code code;
  return std::filesystem::is_character_file(path, code);
}

/// Whether a clicker is named by its place and not by its name: by a path, or by a file or FIFO of
/// the working directory.
bool is_place(const std::string& name) {
  std::error_code code;
  const auto status = std::filesystem::status(name, code);
  return name.find('/') != std::string::npos || std::filesystem::is_regular_file(status) ||
         std::filesystem::is_fifo(status);
}

}  // namespace

std::vector<std::string> ClickerOptions::check() const {
  std::vector<std::string> problems;
  constexpr Duration kLongest = std::chrono::seconds(2);
  if (keys.codes.empty()) {
    problems.push_back("clicker: no key is chosen");
  }
  if (debounce < Duration::zero() || debounce > std::chrono::milliseconds(100)) {
    problems.push_back("clicker: debounce must lie in [0, 100] ms");
  }
  if (double_within <= Duration::zero() || double_within > kLongest) {
    problems.push_back("clicker: double_within must lie in (0, 2000] ms");
  }
  if (hold_after <= Duration::zero() || hold_after > kLongest) {
    problems.push_back("clicker: hold_after must lie in (0, 2000] ms");
  }
  return problems;
}

EvdevClicker::EvdevClicker(const ClickerOptions& options, const Clock& clock)
    : options_(options), clock_(clock), opened_at_(clock.now()) {
  timer_.double_within = options.double_within;
  timer_.hold_after = options.hold_after;
}

Result<std::unique_ptr<EvdevClicker>> EvdevClicker::open(const ClickerOptions& options,
                                                         const Clock& clock) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  std::unique_ptr<EvdevClicker> clicker(new EvdevClicker(options, clock));
  std::error_code code;
  const bool place = is_place(options.device);
  // Only the kernel's folder of devices gets new ones: a file that is missing elsewhere is an
  // error.
  const bool later = options.device.starts_with("/dev/") &&
                     !std::filesystem::exists(options.device, code) && !code;
  if (place && !later) {
    if (Status taken = clicker->take_up(options.device); !taken) {
      return taken.error();
    }
    if (!is_device(options.device)) {
      return clicker;
    }
  }
  auto folder = InputFolder::watch(options.folder);
  if (!folder) {
    return folder.error();
  }
  clicker->folder_.emplace(std::move(*folder));
  if (!clicker->keys_) {
    clicker->find();
  }
  return clicker;
}

Status EvdevClicker::take_up(const std::string& path) {
  auto keys = is_device(path) ? open_evdev_keys(path, options_.keys)
                              : open_recorded_keys(path, options_.keys.codes);
  if (!keys) {
    return keys.error();
  }
  keys_ = std::move(*keys);
  return {};
}

/// Takes up the first device that suits, or remembers why none could be. One that can't be opened
/// yet (udev sets its permissions a moment after it appears) is tried again at the next change of
/// the folder.
void EvdevClicker::find() {
  std::error_code code;
  if (is_place(options_.device)) {
    if (!std::filesystem::exists(options_.device, code)) {
      absent_ =
          Error{"clicker " + options_.device + ": is not plugged in", ErrorCode::kUnavailable};
    } else if (const Status taken = take_up(options_.device); !taken) {
      absent_ = Error{taken.error().message, ErrorCode::kUnavailable};
    }
    return;
  }
  absent_ =
      Error{"clicker: no device in " + options_.folder +
                (options_.device.empty() ? " suits" : " is called \"" + options_.device + "\""),
            ErrorCode::kUnavailable};
  std::string refused;
  for (const std::string& path : folder_->devices()) {
    const auto device = describe_evdev(path);
    if (!device) {
      refused = refused.empty() ? device.error().message : refused;
      continue;
    }
    const bool suits = options_.full_keyboard == device->full_keyboard;
    if (device->name.find(options_.device) == std::string::npos ||
        (options_.device.empty() && !suits)) {
      continue;
    }
    if (const Status taken = take_up(path); taken) {
      return;
    } else {
      refused = taken.error().message;
    }
  }
  if (!refused.empty()) {
    absent_ = Error{absent_.error().message + "; " + refused, ErrorCode::kUnavailable};
  }
}

Status EvdevClicker::read_keys() {
  if (folder_ && folder_->changed() && !keys_) {
    find();
  }
  if (!keys_) {
    return absent_;
  }
  // A recording is read no faster than it is played, since only so much is kept.
  if (!keys_->live() && changes_.size() > kMaxChanges / 2) {
    return {};
  }
  read_.clear();
  const Status read = keys_->read(read_);
  const Timestamp now = clock_.now();
  const Duration offset =
      keys_->live() ? now.time_since_epoch() - monotonic_now() : opened_at_.time_since_epoch();
  for (const KeyEvent& event : read_) {
    const auto& codes = options_.keys.codes;
    if (std::find(codes.begin(), codes.end(), event.code) != codes.end()) {
      press_or_release(event.code, event.down, Timestamp(event.at + offset));
    }
  }
  if (read) {
    return {};
  }
  // Keys held when the source disappeared, or when an event of it was refused, count as released.
  for (const int code : std::vector<int>(down_)) {
    press_or_release(code, false, now);
  }
  if (folder_) {
    keys_.reset();
    absent_ = Error{read.error().message, ErrorCode::kUnavailable};
  }
  return read;
}

void EvdevClicker::press_or_release(int code, bool down, Timestamp time) {
  const bool was_down = !down_.empty();
  std::erase(down_, code);
  if (down) {
    down_.push_back(code);
  }
  if (was_down == !down_.empty() || changes_.size() >= kMaxChanges) {
    return;
  }
  if (!changes_.empty()) {
    time = std::max(time, changes_.back().time);
  }
  // Pressed again within the debounce time: the release before it was a bounce of the contact.
  if (down && !changes_.empty() && !changes_.back().down &&
      time - changes_.back().time < options_.debounce) {
    changes_.pop_back();
  } else {
    changes_.push_back({down, time});
  }
}

void EvdevClicker::tell(Timestamp until, std::vector<ClickerEvent>& events) {
  std::size_t told = 0;
  for (; told < changes_.size(); ++told) {
    Change change = changes_[told];
    const bool last = told + 1 == changes_.size();
    if (change.time > until) {
      break;
    }
    if (!change.down && last && until - change.time < options_.debounce) {
      break;
    }
    change.time = std::max(change.time, told_until_);
    timer_.advance(change.time, events);
    timer_.button(change.down, change.time, events);
    told_until_ = change.time;
  }
  changes_.erase(changes_.begin(), changes_.begin() + static_cast<std::ptrdiff_t>(told));
  const Timestamp quiet_until =
      changes_.empty() || changes_.front().time > until ? until : changes_.front().time;
  timer_.advance(quiet_until, events);
  // A hold carries its own time; nothing earlier may follow it.
  if (!events.empty()) {
    told_until_ = std::max(told_until_, events.back().time);
  }
}

Status EvdevClicker::do_poll(Timestamp until, std::vector<ClickerEvent>& events) {
  if (Status read = read_keys(); !read && untold_) {
    untold_ = std::move(read);
  }
  const std::size_t before = events.size();
  tell(until, events);
  // With an error no event is passed on: those from before come first, and the next call says it.
  return events.size() == before ? std::exchange(untold_, Status()) : Status();
}

}  // namespace orthonav::desktop
