#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "base/transform.h"
#include "hal/igtl/message.h"
#include "hal/igtl/server.h"
#include "tests/support/wait_until.h"

namespace orthonav::test {

/// A program that tracks tools and sends their poses over OpenIGTLink, as used in labs.
class PoseServer {
 public:
  /// At a free port, or again at a given one.
  explicit PoseServer(int port = 0) {
    igtl::ServerOptions options;
    options.port = port;
    options.most_hz = 1e6;
    options.longest_silence = std::chrono::hours(1);
    auto server = igtl::Server::start(options);
    EXPECT_TRUE(server.ok()) << server.error().message;
    server_ = std::move(*server);
  }
  [[nodiscard]] int port() const { return server_->port(); }
  /// "igtl://127.0.0.1:PORT?" followed by the keys.
  [[nodiscard]] std::string uri(const std::string& keys) const {
    return "//127.0.0.1:" + std::to_string(port()) + "?" + keys;
  }
  [[nodiscard]] bool wait_for_client() const {
    return wait_until([this] { return server_->counts().clients > 0; });
  }

  /// Adds a tool to the next message.
  void add(const std::string& name, const Transform<World, Marker>& pose, double stamp_s) {
    igtl::TransformValues values{};
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t row = 0; row < 3; ++row) {
        values[3 * column + row] =
            static_cast<float>(pose.rotation()[static_cast<int>(row)][static_cast<int>(column)]);
      }
      values[9 + column] = static_cast<float>(pose.translation()[static_cast<int>(column)] * 1e3);
    }
    constexpr double kOneSecond = 4294967296.0;
    add(igtl::packed({name, static_cast<std::uint64_t>(stamp_s * kOneSecond)}, values));
  }
  void add(const std::vector<std::uint8_t>& bytes) {
    frame_.insert(frame_.end(), bytes.begin(), bytes.end());
  }
  void send() { server_->publish(std::exchange(frame_, {})); }

 private:
  std::unique_ptr<igtl::Server> server_;
  std::vector<std::uint8_t> frame_;
};

}  // namespace orthonav::test
