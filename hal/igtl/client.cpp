#include "hal/igtl/client.h"

#include <array>
#include <string>

#include "hal/net/allowed.h"

namespace orthonav::igtl {

bool TextReader::wants(const Header& header) const {
  if (header.type != "STRING") {
    return false;
  }
  return let_in_ ? listener_ != nullptr && (header.device == "Command" || header.device == "Plan")
                 : header.device == "Token";
}

Status TextReader::read(const Header& header, Bytes body) {
  if (!said_.allows(1, kMaxASecond, HostClock::now())) {
    return Error{"says more than " + std::to_string(kMaxASecond) + " things a second"};
  }
  const auto text = text_in(header, body);
  if (!text) {
    return text.error();
  }
  if (let_in_) {
    listener_->said(client_, header.device, *text);
    return {};
  }
  let_in_ = token_.is(*text);
  return let_in_ ? Status{} : Error{"invalid token"};
}

Client::Client(net::Socket socket, HostTime now, TextListener* listener, const net::Token& token)
    : socket_(std::move(socket)),
      taken_(now),
      reader_(std::make_unique<TextReader>(net::text_of(net::peer_of(socket_)), listener, token)),
      incoming_(reader_.get()) {}

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
    if (!came_.allows(*count, most_bytes_per_s, now)) {
      return Error{"sends more than " + std::to_string(most_bytes_per_s) + " bytes a second"};
    }
    if (Status s = incoming_.take(std::span(room).first(*count)); !s) {
      return s;
    }
  }
  return {};
}

}  // namespace orthonav::igtl
