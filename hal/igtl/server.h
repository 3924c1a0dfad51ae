#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/igtl/text_message.h"
#include "hal/net/token.h"

namespace orthonav::igtl {

struct ServerOptions {
  /// Numeric address of this machine to listen at; loopback by default.
  std::string address = "127.0.0.1";
  int port = 18944;  ///< 0: any free one
  /// Networks that may connect in addition to this machine, as in "192.168.1.0/24,10.0.0.7"; empty:
  /// with a token, all. Must not be empty without one unless the address is loopback.
  std::string allow;
  /// If there is one, a client is sent nothing, and not heard, until it sends it as a STRING of the
  /// device `Token`.
  net::Token token;
  std::chrono::milliseconds longest_without_token{5000};  ///< then it is dropped
  std::size_t most_clients = 8;
  /// Connections accepted in each `calls_counted_for`; further ones wait in the kernel's queue.
  int most_calls = 20;
  std::chrono::milliseconds calls_counted_for{1000};
  std::size_t most_bytes_per_s = std::size_t{32} << 20;  ///< a client that sends more is dropped
  double most_hz = 60.0;  ///< frames per second; of those in between, only the newest is kept
  /// A client that takes nothing for this long is dropped.
  std::chrono::milliseconds longest_block{2000};
  /// If there is no frame for this long, clients are told so, and again after each further such
  /// time.
  std::chrono::milliseconds longest_silence{1000};

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

class ServerThread;

/// Sends the same frames, bytes of whole messages (hal/igtl/message.h), to every client that
/// connects. Only the headers of clients' messages are read, of any version, unless there is a
/// listener (`TextReader`); a client that sends something else, or announces more than 16 MiB, is
/// dropped. A slow client misses frames, and one that does not read at all is dropped; the others
/// never wait for it. A thread of its own reads and writes.
class Server {
 public:
  /// An Error names address and port and why listening there fails. `listener` must outlive it; may
  /// be null.
  static Result<std::unique_ptr<Server>> start(const ServerOptions& options,
                                               TextListener* listener = nullptr);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] int port() const;
  /// Callable from any thread; returns at once. Replaces a frame that was not sent yet.
  void publish(std::vector<std::uint8_t> frame);
  /// Sent once to every client connected at the time, in addition to the frames; never dropped like
  /// them.
  void tell(std::vector<std::uint8_t> bytes);
  /// Messages that seldom change: sent to all clients now, and to each later one when it connects.
  void set_standing(std::vector<std::uint8_t> standing);

  struct Counts {
    std::size_t clients = 0;  ///< connected now
    std::int64_t served = 0;  ///< that ever connected
    std::int64_t dropped = 0;
    std::int64_t frames = 0;   ///< sent, once for all clients
    std::string last_drop;     ///< why the last one was dropped
    std::int64_t refused = 0;  ///< not allowed, or one too many
  };
  [[nodiscard]] Counts counts() const;

 private:
  explicit Server(std::unique_ptr<ServerThread> thread);
  std::unique_ptr<ServerThread> thread_;
};

}  // namespace orthonav::igtl
