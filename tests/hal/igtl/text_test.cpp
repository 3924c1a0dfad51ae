#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/mutex.h"
#include "hal/igtl/client.h"
#include "hal/igtl/message.h"
#include "hal/igtl/server.h"
#include "tests/support/igtl_client.h"
#include "tests/support/wait_until.h"

namespace orthonav::igtl::text_test {
namespace {

using orthonav::test::IgtlClient;
using orthonav::test::wait_until;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Buffer = std::vector<std::uint8_t>;

class Heard : public TextListener {
 public:
  void said(const std::string& client, const std::string& device,
            const std::string& text) override {
    const MutexLock lock(mutex_);
    lines_.push_back(client + " " + device + " " + text);
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    const MutexLock lock(mutex_);
    return lines_;
  }

 private:
  mutable Mutex mutex_;
  std::vector<std::string> lines_;
};

std::unique_ptr<Server> started(TextListener* listener) {
  ServerOptions options;
  options.port = 0;
  return Server::start(options, listener).value();
}

Result<std::string> read(const Buffer& message) {
  const auto header =
      parsed_header(std::span<const std::uint8_t, kHeaderBytes>(message.data(), kHeaderBytes));
  return text_in(header.value(), Bytes(message).subspan(kHeaderBytes));
}

TEST(IgtlText, IsReadAsItWasPacked) {
  const auto text = read(packed_text({"Command", 0}, "next"));
  ASSERT_TRUE(text.ok()) << text.error().message;
  EXPECT_EQ(*text, "next");
  EXPECT_EQ(read(packed_text({"Plan", 0}, "")).value(), "");
}

TEST(IgtlText, OfAnotherLengthOrEncodingIsRefused) {
  Buffer message = packed_text({"Command", 0}, "next");
  std::fill(message.begin() + 50, message.begin() + kHeaderBytes, 0);  // no checksum
  ASSERT_TRUE(read(message).ok());
  Buffer longer = message;
  longer[kHeaderBytes + 3] = 5;
  EXPECT_THAT(read(longer).error().message, HasSubstr("8 bytes, which is not its length"));
  Buffer other = message;
  other[kHeaderBytes + 1] = 4;
  EXPECT_THAT(read(other).error().message, HasSubstr("encoding 4"));
  message.resize(kHeaderBytes + 3);
  EXPECT_FALSE(read(message).ok());
}

TEST(IgtlListening, HearsCommandsAndPlansWithWhoSaysThem) {
  Heard heard;
  const auto server = started(&heard);
  IgtlClient client(server->port());
  client.send(packed_text({"Command", 0}, "next"));
  client.send(packed_text({"Note", 0}, "no command"));
  client.send(packed({"Command", 0}, StatusValues{kStatusOk, 0, "", "no text"}));
  client.send(packed_text({"Plan", 0}, "{}"));
  ASSERT_TRUE(wait_until([&] { return heard.lines().size() >= 2; }));
  EXPECT_THAT(heard.lines(), ElementsAre("127.0.0.1 Command next", "127.0.0.1 Plan {}"));
  server->tell(packed_text({"CommandAnswer", 0}, "taken"));
  EXPECT_EQ(client.next(), "STRING CommandAnswer");
}

TEST(IgtlListening, HearsNothingWhereNobodyListens) {
  const auto server = started(nullptr);
  IgtlClient client(server->port());
  client.send(packed_text({"Command", 0}, "next"));
  server->publish(packed_text({"Guidance", 0}, "1"));
  EXPECT_EQ(client.next(), "STRING Guidance") << "it is skipped, and the client stays";
}

TEST(IgtlListening, DropsWhoSaysTooMuchOrWhatIsNoText) {
  Heard heard;
  const auto server = started(&heard);
  IgtlClient talker(server->port());
  Buffer much;
  for (int i = 0; i <= TextReader::kMaxASecond; ++i) {
    const Buffer each = packed_text({"Command", 0}, "next");
    much.insert(much.end(), each.begin(), each.end());
  }
  talker.send(much);
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 1; }));
  EXPECT_THAT(server->counts().last_drop, HasSubstr("more than 20 things a second"));
  EXPECT_EQ(heard.lines().size(), static_cast<std::size_t>(TextReader::kMaxASecond));
  IgtlClient broken(server->port());
  Buffer torn = packed_text({"Plan", 0}, "{}");
  torn.back() ^= 1u;
  broken.send(torn);
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 2; }));
  EXPECT_THAT(server->counts().last_drop, HasSubstr("checksum"));
}

/// A listener may throw: the server's thread then ends in order, and reports why.
class Dying : public TextListener {
 public:
  void said(const std::string&, const std::string&, const std::string&) override {
    throw std::bad_alloc();
  }
};

TEST(IgtlListening, AServerWhoseListenerThrowsEndsInOrder) {
  Dying dying;
  const auto server = started(&dying);
  IgtlClient client(server->port());
  client.send(packed_text({"Command", 0}, "next"));
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 1; }));
  EXPECT_EQ(server->counts().last_drop, "server: out of memory");
  server->publish({1, 2, 3});  // the publisher does not notice
}

TEST(IgtlListening, KeepsNoBodyLargerThanAText) {
  Heard heard;
  const auto server = started(&heard);
  IgtlClient client(server->port());
  Buffer large = packed_text({"Plan", 0}, "");
  large.resize(kHeaderBytes);
  large[47] = 0x20;  // 2 MiB are announced, and skipped
  large[48] = large[49] = 0;
  large.insert(large.end(), 0x200000, 'x');
  client.send(large);
  client.send(packed_text({"Command", 0}, "next"));
  ASSERT_TRUE(wait_until([&] { return !heard.lines().empty(); }));
  EXPECT_THAT(heard.lines(), ElementsAre("127.0.0.1 Command next"));
}

}  // namespace
}  // namespace orthonav::igtl::text_test
