#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "hal/igtl/message.h"
#include "hal/igtl/server.h"
#include "tests/support/igtl_client.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::igtl::server_token_test {
namespace {

using orthonav::test::IgtlClient;
using orthonav::test::wait_until;
using Bytes = std::vector<std::uint8_t>;

Bytes frame() { return packed_text({"Guidance", 0}, "one"); }

/// A server that asks for a token, and a client's message that brings one.
class IgtlToken : public ::testing::Test {
 protected:
  std::unique_ptr<Server> asking(TextListener* listener = nullptr) {
    ServerOptions options;
    options.port = 0;
    options.token = token_;
    options.longest_without_token = std::chrono::milliseconds(300);
    auto server = Server::start(options, listener);
    EXPECT_TRUE(server.ok()) << server.error().message;
    (*server)->set_standing(packed_text({"Standing", 0}, "stands"));
    return std::move(*server);
  }
  [[nodiscard]] Bytes bring(const std::string& token) const {
    return packed_text({"Token", 0}, token);
  }
  orthonav::test::TemporaryFolder folder_;
  net::Token token_ = net::Token::of(folder_.file("token")).value();
};

TEST_F(IgtlToken, IsBroughtBeforeAnythingIsSent) {
  const auto server = asking();
  const IgtlClient silent(server->port());
  IgtlClient known(server->port());
  server->publish(frame());
  known.send(bring(token_.text()));
  EXPECT_EQ(known.next(), "STRING Standing");
  ASSERT_TRUE(wait_until([&] {
    server->publish(frame());
    return server->counts().dropped == 1;
  }));
  EXPECT_EQ(server->counts().last_drop, "sent no token");
  EXPECT_TRUE(silent.receive(1).empty()) << "not a byte before it was dropped";
  EXPECT_EQ(known.next(), "STRING Guidance");
}

TEST_F(IgtlToken, ThatIsWrongEndsTheConnection) {
  const auto server = asking();
  IgtlClient stranger(server->port());
  stranger.send(bring(std::string(token_.text().size(), 'x')));
  EXPECT_EQ(stranger.next(), "");
  // It hangs up before it counts.
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 1; }));
  EXPECT_EQ(server->counts().last_drop, "invalid token");
}

TEST_F(IgtlToken, IsNeededBeforeACommandIsHeard) {
  struct Heard : TextListener {
    void said(const std::string&, const std::string&, const std::string& text) override {
      const MutexLock lock(mutex);
      texts += text + ";";
    }
    std::string all() {
      const MutexLock lock(mutex);
      return texts;
    }
    Mutex mutex;
    std::string texts;
  } heard;
  const auto server = asking(&heard);
  const IgtlClient client(server->port());
  Bytes words = packed_text({"Command", 0}, "next");
  for (const Bytes& more : {bring(token_.text()), packed_text({"Command", 0}, "accept")}) {
    words.insert(words.end(), more.begin(), more.end());
  }
  client.send(words);
  EXPECT_TRUE(wait_until([&] { return heard.all() == "accept;"; })) << heard.all();
}

TEST_F(IgtlToken, OpensAnAddressForWhoeverBringsIt) {
  ServerOptions options;
  options.port = 0;
  options.address = "0.0.0.0";
  options.token = token_;
  const auto server = Server::start(options);
  ASSERT_TRUE(server.ok()) << server.error().message;
  IgtlClient here((*server)->port());
  here.send(bring(token_.text()));
  ASSERT_TRUE(wait_until([&] {
    (*server)->publish(frame());
    return (*server)->counts().frames > 0;
  }));
  EXPECT_EQ(here.next(), "STRING Guidance");
}

}  // namespace
}  // namespace orthonav::igtl::server_token_test
