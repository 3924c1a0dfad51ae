#include "hal/net/socket.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>

namespace orthonav::net {
namespace {

HostTime soon() { return HostClock::now() + std::chrono::seconds(2); }

class SocketCodes : public ::testing::Test {
 protected:
  const Endpoint here_ = resolve("127.0.0.1").value();
  Socket listener_ = listen_at(here_, 0).value();
  const int port_ = port_of(listener_);
};

/// With fewer files allowed than watched, poll() is refused: nothing is new, and nobody spins.
TEST(WaitingForNews, TakesItsTimeWherePollIsRefused) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  std::array<pollfd, 8> watched{};
  watched.fill({-1, POLLIN, POLLIN});
  rlimit few = before;
  few.rlim_cur = watched.size() - 1;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  const HostTime begin = HostClock::now();
  wait_for_news(watched, 5);
  const auto took = HostClock::now() - begin;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_GE(took, std::chrono::milliseconds(5));
  for (const pollfd& each : watched) {
    EXPECT_EQ(each.revents, 0);
  }
}

TEST_F(SocketCodes, OfAPortWhereNobodyListensIsUnavailable) {
  EXPECT_TRUE(reach(here_, port_, soon()).ok());
  listener_ = Socket(-1);
  const Status refused = reach(here_, port_, soon());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
}

TEST_F(SocketCodes, OfAPortThatSomebodyElseHasIsUnavailable) {
  const auto second = listen_at(here_, port_);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
}

TEST_F(SocketCodes, OfAConnectionThatWasClosedOrResetIsLost) {
  for (const bool resets : {false, true}) {
    const Socket client = begin_connect(here_, port_).value();
    std::optional<Socket> served;
    while (!served) {
      served = accept_one(listener_);
    }
    if (resets) {
      cut_off(*served);
    }
    served.reset();
    std::array<std::uint8_t, 1> room{};
    auto got = receive_some(client, room);
    while (got.ok()) {
      got = receive_some(client, room);
    }
    EXPECT_EQ(got.error().code, ErrorCode::kLost) << resets;
  }
}

}  // namespace
}  // namespace orthonav::net
