#include "hal/hl2ss/door.h"

#include <poll.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "hal/hl2ss/probe.h"
#include "hal/hl2ss/server/doorkeeper.h"
#include "tests/hal/hl2ss/served_room.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::hl2ss {
namespace {

using ::testing::HasSubstr;

constexpr auto kPatience = std::chrono::milliseconds(500);

/// A room that asks for a token, a file with that token, and one with another.
class HeadsetWithADoor : public ::testing::Test {
 protected:
  ServerOptions asking() {
    ServerOptions options;
    options.token = net::Token::of(right_).value();
    return options;
  }
  Hl2ssOptions client(const std::string& token) {
    Hl2ssOptions options = room_.client_options();
    options.token_file = token;
    options.open_within = kPatience;
    return options;
  }

  test::TemporaryFolder folder_;
  std::string right_ = folder_.file("right");
  std::string wrong_ = folder_.file("wrong");
  test::ServedRoom room_{test::black_session(10.0), asking()};
};

TEST_F(HeadsetWithADoor, ServesNobodyWithoutTheToken) {
  EXPECT_FALSE(Hl2ssHeadset::open(client("")));
  ASSERT_TRUE(net::Token::of(wrong_)) << "is made";
  const auto wrong = Hl2ssHeadset::open(client(wrong_));
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message, HasSubstr("the token of " + wrong_ + " is not taken"));
  const auto none = Hl2ssHeadset::open(client(folder_.file("none")));
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("none: cannot be read (No such file"));
  EXPECT_FALSE(probe(client(wrong_)));
  EXPECT_EQ(room_.server().report().sessions, 0);
}

TEST_F(HeadsetWithADoor, ServesWhoeverBringsIt) {
  Hl2ssOptions options = client(right_);
  options.open_within = std::chrono::seconds(8);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_TRUE(headset) << headset.error().message;
  StereoFrame frame;
  EXPECT_EQ(test::next_pair(**headset, frame), Next::kFrame);
}

/// The doorkeeper alone, with a client in hand.
class DoorkeeperTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(host_);
    while (!keeper_.port().listen(*host_, port_)) {
      ASSERT_LT(++port_, 60000);
    }
    client_ = net::begin_connect(*host_, port_).value();
    ASSERT_TRUE(test::wait_until([&] {
      turn();
      return keeper_.port().has_client();
    }));
  }
  void turn() {
    pollfd one{keeper_.port().fd(), keeper_.port().events(), 0};
    (void)::poll(&one, 1, 1);
    keeper_.port().step(one.revents, HostClock::now());
  }
  /// What is answered before the keeper hangs up.
  std::string answer_to(const std::string& said) {
    std::string heard;
    EXPECT_TRUE(test::wait_until([&] {
      (void)send_some(client_, Bytes(reinterpret_cast<const std::uint8_t*>(said.data()),
                                     sent_ ? 0 : said.size()));
      sent_ = true;
      turn();
      std::array<std::uint8_t, 64> room{};
      const auto count = receive_some(client_, room);
      heard.append(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count ? *count : 0));
      return !count.ok();
    }));
    return heard;
  }

  Result<net::Endpoint> host_ = net::resolve("127.0.0.1");
  int port_ = 28512;
  test::TemporaryFolder folder_;
  net::Token token_ = net::Token::of(folder_.file("token")).value();
  Doorkeeper keeper_{token_};
  net::Socket client_;
  bool sent_ = false;
};

TEST_F(DoorkeeperTest, AdmitsAnAddressForAMinuteAndLongerWhileItIsThere) {
  const HostTime begin = HostClock::now();
  EXPECT_FALSE(keeper_.admits(*host_, begin));
  EXPECT_EQ(answer_to(token_.text() + "\n"), kWelcome);
  const HostTime now = HostClock::now();
  EXPECT_TRUE(keeper_.admits(*host_, now + std::chrono::seconds(59)));
  EXPECT_TRUE(keeper_.admits(*host_, now + std::chrono::seconds(118)));
  const auto other = net::resolve("127.0.0.2");
  ASSERT_TRUE(other);
  EXPECT_FALSE(keeper_.admits(*other, now));
  EXPECT_FALSE(keeper_.admits(*host_, now + std::chrono::seconds(180)));
}

TEST_F(DoorkeeperTest, HangsUpOnAnotherToken) {
  std::string other = token_.text();
  other.back() = other.back() == '0' ? '1' : '0';
  EXPECT_EQ(answer_to(other + "\n"), "");
  EXPECT_FALSE(keeper_.admits(*host_, HostClock::now()));
}

TEST_F(DoorkeeperTest, HangsUpOnALineWithoutAnEnd) {
  EXPECT_EQ(answer_to(std::string(200, 'a')), "");
  EXPECT_FALSE(keeper_.admits(*host_, HostClock::now()));
}

TEST_F(DoorkeeperTest, HangsUpOnWhoeverSaysNothing) {
  keeper_.step(HostClock::now() + std::chrono::seconds(4));
  EXPECT_TRUE(keeper_.port().has_client());
  keeper_.step(HostClock::now() + std::chrono::seconds(6));
  EXPECT_FALSE(keeper_.port().has_client());
}

}  // namespace
}  // namespace orthonav::hl2ss
