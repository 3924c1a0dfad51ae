#pragma once

#include <linux/input.h>

#include <chrono>
#include <string>

namespace orthonav::test {

/// Input events as the kernel writes them, byte by byte.
class EventBytes {
 public:
  /// A key at a time, followed by the report that ends an event.
  EventBytes& key(int code, int value, std::chrono::microseconds at) {
    add(EV_KEY, code, value, at);
    return add(EV_SYN, SYN_REPORT, 0, at);
  }
  EventBytes& add(int type, int code, int value, std::chrono::microseconds at) {
    input_event event{};
    event.input_event_sec = static_cast<decltype(event.input_event_sec)>(at.count() / 1'000'000);
    event.input_event_usec = static_cast<decltype(event.input_event_usec)>(at.count() % 1'000'000);
    event.type = static_cast<unsigned short>(type);
    event.code = static_cast<unsigned short>(code);
    event.value = value;
    bytes_.append(reinterpret_cast<const char*>(&event), sizeof(event));
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace orthonav::test
