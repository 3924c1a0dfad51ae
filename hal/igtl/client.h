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

namespace orthonav::igtl {

/// Hands what a client says on to who listens: STRING of the devices `Command` and `Plan`.
class TextReader : public MessageReader {
 public:
  /// A client that says more within a second is dropped.
  static constexpr int kMostASecond = 20;

  TextReader(std::string client, TextListener& listener)
      : client_(std::move(client)), listener_(listener) {}

 private:
  [[nodiscard]] bool wants(const Header& header) const override;
  Status read(const Header& header, Bytes body) override;

  std::string client_;
  TextListener& listener_;
  net::RateLimit said_;
};

/// One connected client: what it sends is skipped, unless somebody listens; what it is sent waits
/// until it takes it.
class Client {
 public:
  /// `listener` is borrowed; null: nobody listens.
  Client(net::Socket socket, HostTime now, TextListener* listener = nullptr);

  [[nodiscard]] int fd() const { return socket_.fd(); }
  /// Nothing waits to be taken.
  [[nodiscard]] bool idle() const { return sent_ == waiting_.size(); }
  /// When it last took something, or was last idle.
  [[nodiscard]] HostTime taken() const { return taken_; }

  /// Puts these bytes behind what waits.
  void add(std::span<const std::uint8_t> bytes, HostTime now);
  /// Sends what it takes now. An Error when it is gone.
  Status write(HostTime now);
  /// Reads what there is. An Error when it is gone (`ErrorCode::kLost` when it closed), or sends
  /// what is no OpenIGTLink, or more than so many bytes within a second.
  Status read(HostTime now, std::size_t most_bytes_per_s);

 private:
  net::Socket socket_;
  std::vector<std::uint8_t> waiting_;
  std::size_t sent_ = 0;
  HostTime taken_;
  std::unique_ptr<TextReader> reader_;  ///< null: nobody listens
  Incoming incoming_;
  net::RateLimit came_;
};

}  // namespace orthonav::igtl
