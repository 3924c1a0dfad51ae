// What happens when the thread that receives poses dies.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "hal/igtl/pose_receiver.h"
#include "tests/support/allocation_count.h"
#include "tests/support/wait_until.h"

namespace orthonav::igtl::dying_receiver_test {
namespace {

using orthonav::test::wait_until;

/// Sends to the first client; allocates nothing by then.
class PlainServer {
 public:
  PlainServer() : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    socklen_t length = sizeof address;
    EXPECT_EQ(::bind(fd_, reinterpret_cast<sockaddr*>(&address), length), 0);
    EXPECT_EQ(::listen(fd_, 1), 0);
    EXPECT_EQ(::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &length), 0);
    port_ = ntohs(address.sin_port);
  }
  ~PlainServer() {
    ::close(client_);
    ::close(fd_);
  }
  PlainServer(const PlainServer&) = delete;
  PlainServer& operator=(const PlainServer&) = delete;
  [[nodiscard]] int port() const { return port_; }
  void accept() {
    client_ = ::accept(fd_, nullptr, nullptr);
    ASSERT_GE(client_, 0);
  }
  void send(const std::vector<std::uint8_t>& bytes) const {
    (void)!::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

 private:
  int fd_;
  int client_ = -1;
  int port_ = 0;
};

/// A message about tools whose body is larger than the memory that is left.
std::vector<std::uint8_t> large_message() {
  constexpr std::size_t kBody = 100u << 10u;
  std::vector<std::uint8_t> message(kHeaderBytes + kBody, 0);
  message[1] = 1;
  const std::string type = "TDATA";
  std::copy(type.begin(), type.end(), message.begin() + 2);
  for (std::size_t i = 0; i < 4; ++i) {
    message[49 - i] = static_cast<std::uint8_t>(kBody >> (8 * i));
  }
  return message;
}

TEST(DyingPoseReceiver, SaysOfWhatAtEveryCallSoThatTheRunEnds) {
  PlainServer server;
  const auto options =
      tracker_options_of("//127.0.0.1:" + std::to_string(server.port()) + "?pointer=AToB");
  ASSERT_TRUE(options.ok());
  PoseReceiver receiver(net::resolve("127.0.0.1").value(), *options);
  server.accept();
  const auto message = large_message();
  ToolPoses poses;
  {
    const orthonav::test::AllocationLimit limit(32u << 10u);
    server.send(message);
    ASSERT_TRUE(wait_until([&] { return !receiver.next(poses).ok(); }));
  }
  for (int call = 0; call < 3; ++call) {
    const auto next = receiver.next(poses);
    ASSERT_FALSE(next.ok());
    EXPECT_EQ(next.error().message, "igtl: out of memory");
  }
}

}  // namespace
}  // namespace orthonav::igtl::dying_receiver_test
