#include "hal/igtl/client.h"

#include <array>
#include <string>

namespace orthonav::igtl {

void Client::add(std::span<const std::uint8_t> bytes, HostTime now) {
  if (idle()) {
    waiting_.clear();
    sent_ = 0;
    taken_ = now;
  }
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

Status Client::write(HostTime now) {
  while (!idle()) {
    const auto count = net::send_some(socket_, std::span(waiting_).subspan(sent_));
    if (!count) {
      return count.error();
    }
    if (*count == 0) {
      return {};
    }
    sent_ += *count;
    taken_ = now;
  }
  return {};
}

Status Client::read(HostTime now, std::size_t most_bytes_per_s) {
  if (now - counted_since_ >= std::chrono::seconds(1)) {
    counted_since_ = now;
    counted_ = 0;
  }
  std::array<std::uint8_t, 16384> room{};
  // What a client may send while others wait for their turn.
  constexpr int kMostReads = 16;
  for (int i = 0; i < kMostReads; ++i) {
    const auto count = net::receive_some(socket_, room);
    if (!count) {
      return count.error();
    }
    if (*count == 0) {
      return {};
    }
    counted_ += *count;
    if (counted_ > most_bytes_per_s) {
      return Error{"sends more than " + std::to_string(most_bytes_per_s) + " bytes a second"};
    }
    if (Status s = incoming_.take(std::span(room).first(*count)); !s) {
      return s;
    }
  }
  return {};
}

}  // namespace orthonav::igtl
