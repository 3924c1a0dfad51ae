#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/igtl/incoming.h"
#include "hal/igtl/text_message.h"
#include "hal/net/rate_limit.h"
#include "hal/net/socket.h"
#include "hal/net/token.h"

namespace orthonav::igtl {

/// Passes a client's texts to the listener, if there is one: STRING messages of the devices
/// `Command` and `Plan`. Where a token is asked for, that of `Token` must be the first.
class TextReader : public MessageReader {
 public:
  /// A client that sends more texts within a second is dropped.
  static constexpr int kMaxASecond = 20;

  /// Both are borrowed; `listener` may be null.
  TextReader(std::string client, TextListener* listener, const net::Token& token)
      : client_(std::move(client)), listener_(listener), token_(token) {}
  /// It has brought the token, or none is asked for.
  [[nodiscard]] bool let_in() const { return let_in_; }

 private:
  [[nodiscard]] bool wants(const Header& header) const override;
  Status read(const Header& header, Bytes body) override;

  std::string client_;
  TextListener* listener_;
  const net::Token& token_;
  bool let_in_ = !token_.is_asked_for();
  net::RateLimit said_;
};

/// One connected client: its messages are skipped, unless there is a listener or a token is asked
/// for; messages to it wait until it takes them.
class Client {
 public:
  /// `listener` and `token` are borrowed; `listener` may be null.
  Client(net::Socket socket, HostTime now, TextListener* listener, const net::Token& token);

  [[nodiscard]] int fd() const { return socket_.fd(); }
  /// Whether it may be sent anything.
  [[nodiscard]] bool let_in() const { return reader_->let_in(); }
  /// Whether no bytes are waiting.
  [[nodiscard]] bool idle() const { return sent_ == waiting_.size(); }
  /// When the client last took bytes, or was last idle.
  [[nodiscard]] HostTime taken() const { return taken_; }

  /// Appends these bytes to those waiting.
  void add(std::span<const std::uint8_t> bytes, HostTime now);
  /// Sends as much as the client takes now. An Error if it is gone.
  Status write(HostTime now);
  /// Reads the available bytes. An Error if the client is gone (`ErrorCode::kLost` if it closed the
  /// connection), sends something other than OpenIGTLink, or more than this many bytes within a
  /// second.
  Status read(HostTime now, std::size_t most_bytes_per_s);

 private:
  net::Socket socket_;
  std::vector<std::uint8_t> waiting_;
  std::size_t sent_ = 0;
  HostTime taken_;
  std::unique_ptr<TextReader> reader_;  ///< never null
  Incoming incoming_;
  net::RateLimit came_;
};

}  // namespace orthonav::igtl
