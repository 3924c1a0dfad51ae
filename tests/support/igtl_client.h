#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hal/igtl/message.h"

namespace orthonav::test {

/// A client of OpenIGTLink on a plain, blocking socket.
class IgtlClient {
 public:
  explicit IgtlClient(int port, int receive_buffer = 0) : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    connected_ = ::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~IgtlClient() { ::close(fd_); }
  IgtlClient(const IgtlClient&) = delete;
  IgtlClient& operator=(const IgtlClient&) = delete;

  [[nodiscard]] bool connected() const { return connected_; }
  void send(const std::vector<std::uint8_t>& bytes) const {
    (void)!::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  /// This many bytes; fewer if the server hung up.
  [[nodiscard]] std::vector<std::uint8_t> receive(std::size_t count) const {
    std::vector<std::uint8_t> out(count);
    const ssize_t got = count == 0 ? 0 : ::recv(fd_, out.data(), count, MSG_WAITALL);
    out.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return out;
  }
  /// Reads a whole message: "TRANSFORM PointerToWorld"; empty once the server hung up.
  [[nodiscard]] std::string next() {
    const auto head = receive(igtl::kHeaderBytes);
    if (head.size() < igtl::kHeaderBytes) {
      return {};
    }
    const igtl::Header header =
        igtl::parsed_header(
            std::span<const std::uint8_t, igtl::kHeaderBytes>(head.data(), igtl::kHeaderBytes))
            .value();
    last_body_ = receive(static_cast<std::size_t>(header.body_bytes));
    return last_body_.size() == header.body_bytes ? header.type + " " + header.device : "";
  }
  [[nodiscard]] const std::vector<std::uint8_t>& last_body() const { return last_body_; }

 private:
  int fd_;
  bool connected_ = false;
  std::vector<std::uint8_t> last_body_;
};

}  // namespace orthonav::test
