#include "hal/hl2ss/server/camera_port.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/wait_until.h"

namespace orthonav::hl2ss {
namespace {

/// A camera's port, whose turns the test makes.
class ServedCamera : public ::testing::Test {
 protected:
  void SetUp() override {
    for (number_ = 31000; !camera_.port().listen(host_, number_); ++number_) {
      ASSERT_LT(number_, 32000);
    }
    image_.picture = &picture_;
    image_.world_from_rig_after = [](Duration) { return Transform<World, Rig>{}; };
  }
  void turn() {
    pollfd watched{camera_.port().fd(), camera_.port().events(), 0};
    net::wait_for_news({&watched, 1}, 5);
    camera_.port().step(watched.revents, HostClock::now());
  }
  template <class Condition>
  bool turned_until(const Condition& holds) {
    return test::wait_until([&] {
      turn();
      return holds();
    });
  }
  net::Socket client() {
    net::Socket socket = net::begin_connect(host_, number_).value();
    EXPECT_TRUE(turned_until([&] { return camera_.port().has_client(); }));
    return socket;
  }
  /// How many bytes arrive there within some turns.
  std::size_t heard(const net::Socket& client) {
    std::size_t sum = 0;
    std::array<std::uint8_t, 65536> room{};
    for (int k = 0; k < 20; ++k) {
      turn();
      sum += net::receive_some(client, room).value();
    }
    return sum;
  }

  net::Endpoint host_ = net::resolve("127.0.0.1").value();
  int number_ = 0;
  CameraPort camera_{{{}, {}, Random(1)}};
  GreyImage picture_{640, 480, 7};
  CameraPort::Image image_;
};

TEST_F(ServedCamera, SendsAPictureToNobodyButTheClientThatAskedForIt) {
  net::Socket first = client();
  ASSERT_TRUE(net::send_some(first, request_bytes({})));
  ASSERT_TRUE(turned_until([&] { return camera_.is_streaming(); }));
  EXPECT_TRUE(camera_.send(image_).value());
  EXPECT_GT(heard(first), 640u * 480u) << "the twin";

  // While a picture is made, its client leaves and another comes.
  net::Socket second;
  image_.world_from_rig_after = [&](Duration) {
    first = net::Socket();
    EXPECT_TRUE(turned_until([&] { return !camera_.is_streaming(); }));
    second = client();
    return Transform<World, Rig>{};
  };
  EXPECT_FALSE(camera_.send(image_).value());
  ASSERT_TRUE(second.is_open());
  EXPECT_EQ(heard(second), 0u);
}

}  // namespace
}  // namespace orthonav::hl2ss
