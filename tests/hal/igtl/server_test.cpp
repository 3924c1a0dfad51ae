#include "hal/igtl/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <igtlClientSocket.h>
#include <igtlMessageHeader.h>
#include <igtlStringMessage.h>

#include <algorithm>
#include <array>
#include <thread>

#include "hal/igtl/incoming.h"
#include "hal/igtl/message.h"
#include "hal/igtl/server_thread.h"
#include "tests/support/igtl_client.h"
#include "tests/support/wait_until.h"

namespace orthonav::igtl::server_test {
namespace {

using orthonav::test::IgtlClient;
using orthonav::test::wait_until;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

std::unique_ptr<Server> started(ServerOptions options = {}) {
  options.port = 0;
  auto server = Server::start(options);
  EXPECT_TRUE(server.ok()) << server.error().message;
  return std::move(*server);
}

Bytes frame(int number) { return packed_text({"Guidance", 0}, std::to_string(number)); }

/// Publishes one frame after another until `done`.
bool publish_until(Server& server, const std::function<bool()>& done, const Bytes& bytes) {
  return wait_until([&] {
    server.publish(bytes);
    return done();
  });
}

TEST(IgtlIncoming, ReadsTheSameHoweverTheStreamIsCut) {
  Bytes stream;
  for (const char* text : {"", "a", "a longer text"}) {
    const Bytes message = packed_text({"Guidance", 0}, text);
    stream.insert(stream.end(), message.begin(), message.end());
  }
  for (std::size_t step = 1; step <= stream.size(); ++step) {
    Incoming incoming;
    for (std::size_t at = 0; at < stream.size(); at += step) {
      ASSERT_TRUE(
          incoming.take(std::span(stream).subspan(at, std::min(step, stream.size() - at))).ok());
    }
    EXPECT_EQ(incoming.messages(), 3u) << step;
  }
  stream[kHeaderBytes] = 7;  // a byte of a body
  Incoming other;
  EXPECT_TRUE(other.take(stream).ok());
  stream[0] = 7;  // of a header
  EXPECT_FALSE(other.take(stream).ok()) << "the control";
}

TEST(IgtlServer, ServesSeveralClientsTheSameFramesAndWhatStandsFirst) {
  const auto server = started();
  server->set_standing(packed({"L4leftScrew", 0}, std::vector<PointValues>(2)));
  IgtlClient a(server->port());
  IgtlClient b(server->port());
  ASSERT_TRUE(a.connected() && b.connected());
  EXPECT_EQ(a.next(), "POINT L4leftScrew");
  EXPECT_EQ(b.next(), "POINT L4leftScrew");
  server->publish(frame(1));
  EXPECT_EQ(a.next(), "STRING Guidance");
  EXPECT_EQ(b.next(), "STRING Guidance");
  EXPECT_EQ(server->counts().clients, 2u);
  server->set_standing(packed({"L5leftScrew", 0}, std::vector<PointValues>(2)));
  EXPECT_EQ(a.next(), "POINT L5leftScrew") << "what stands has changed";
}

TEST(IgtlServer, IsReadByAClientOfDebiansLibrary) {
  const auto server = started();
  const auto client = ::igtl::ClientSocket::New();
  ASSERT_EQ(client->ConnectToServer("127.0.0.1", server->port()), 0);
  ASSERT_TRUE(publish_until(
      *server, [&] { return server->counts().frames > 0; }, frame(42)));
  const auto header = ::igtl::MessageHeader::New();
  header->InitPack();
  ASSERT_EQ(client->Receive(header->GetPackPointer(), header->GetPackSize()),
            header->GetPackSize());
  header->Unpack();
  ASSERT_STREQ(header->GetDeviceType(), "STRING");
  const auto text = ::igtl::StringMessage::New();
  text->SetMessageHeader(header);
  text->AllocatePack();
  client->Receive(text->GetPackBodyPointer(), text->GetPackBodySize());
  EXPECT_NE(text->Unpack(1) & ::igtl::MessageHeader::UNPACK_BODY, 0);
  EXPECT_STREQ(text->GetString(), "42");
  client->CloseSocket();
}

TEST(IgtlServer, SurvivesTheHeaderOfVersionTwoThatSlicerOpensWith) {
  const auto server = started();
  IgtlClient slicer(server->port());
  // A STATUS of version 2: 63 bytes of body with an extended header and metadata.
  Bytes opening = packed({"Slicer", 0}, StatusValues{kStatusOk, 0, "", ""});
  opening.resize(kHeaderBytes + 63);
  opening[1] = 2;
  opening[49] = 63;
  slicer.send(opening);
  slicer.send(frame(7));  // what follows is read at its place
  server->publish(frame(1));
  EXPECT_EQ(slicer.next(), "STRING Guidance");
  EXPECT_EQ(server->counts().dropped, 0);
}

TEST(IgtlServer, DropsWhoSendsSomethingElseAndServesTheRest) {
  const auto server = started();
  IgtlClient good(server->port());
  IgtlClient bad(server->port());
  const std::string http =
      "GET / HTTP/1.1\r\nHost: localhost\r\nUser-Agent: something long\r\n\r\n";
  bad.send({http.begin(), http.end()});
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 1; }));
  EXPECT_THAT(server->counts().last_drop, HasSubstr("not an OpenIGTLink message"));
  IgtlClient greedy(server->port());
  Bytes large = frame(1);
  large[44] = 1;  // 2^40 bytes are to come
  greedy.send(large);
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 2; }));
  EXPECT_THAT(server->counts().last_drop, HasSubstr("limit 16777216"));
  server->publish(frame(1));
  EXPECT_EQ(good.next(), "STRING Guidance");
}

TEST(IgtlServer, DropsWhoNeverReadsWhileOthersGetTheirFrames) {
  ServerOptions options;
  options.longest_block = std::chrono::milliseconds(50);
  options.most_hz = 1e6;
  const auto server = started(options);
  IgtlClient deaf(server->port(), 4096);
  std::atomic<bool> over = false;
  std::atomic<int> read = 0;
  std::thread reader([&] {
    IgtlClient good(server->port());
    while (!over && !good.next().empty()) {
      ++read;
    }
  });
  const Bytes large = packed_text({"Guidance", 0}, std::string(60000, 'x'));
  EXPECT_TRUE(publish_until(
      *server, [&] { return server->counts().dropped == 1; }, large));
  EXPECT_EQ(server->counts().last_drop, "does not read");
  const int before = read;
  EXPECT_TRUE(publish_until(
      *server, [&] { return read > before + 3; }, large));
  over = true;
  EXPECT_TRUE(publish_until(
      *server, [&] { return server->counts().clients == 0; }, large));
  reader.join();
}

TEST(IgtlServer, SendsTheNewestFrameNoMoreOftenThanAllowed) {
  ServerOptions options;
  options.most_hz = 0.01;
  options.longest_silence = std::chrono::hours(1);
  const auto server = started(options);
  IgtlClient client(server->port());
  ASSERT_TRUE(wait_until([&] { return server->counts().clients == 1; }));
  server->publish(frame(1));
  ASSERT_TRUE(wait_until([&] { return server->counts().frames == 1; }));
  for (int i = 2; i < 50; ++i) {
    server->publish(frame(i));
  }
  server->set_standing(frame(99));  // goes at once, so that there is something to wait for
  EXPECT_EQ(client.next(), "STRING Guidance");
  EXPECT_EQ(client.next(), "STRING Guidance");
  EXPECT_EQ(server->counts().frames, 1) << "the others wait for their turn";
}

TEST(IgtlServer, TellsClientsThatNoFrameComes) {
  ServerOptions options;
  options.longest_silence = std::chrono::milliseconds(5);
  const auto server = started(options);
  IgtlClient client(server->port());
  EXPECT_EQ(client.next(), "STATUS orthonav");
}

TEST(IgtlServer, RefusesAPortThatIsTakenAndAddressesThatAreNone) {
  const auto server = started();
  ServerOptions options;
  options.port = server->port();
  const auto second = Server::start(options);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message, HasSubstr("can't listen at 127.0.0.1:"));
  options.address = "localhost";
  options.port = 70000;
  const auto bad = Server::start(options);
  ASSERT_FALSE(bad.ok());
  EXPECT_THAT(bad.error().message, HasSubstr("must be numbers, as in 127.0.0.1 or [::1]"));
  EXPECT_THAT(bad.error().message, HasSubstr("port 70000"));
}

TEST(IgtlServer, ListensOnLoopbackAloneUnlessToldOtherwise) {
  const auto server = started();
  // Every address of 127.0.0.0/8 is this machine; the server took only one of them.
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(server->port()));
  ::inet_pton(AF_INET, "127.0.0.2", &address.sin_addr);
  EXPECT_NE(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ::close(fd);
  EXPECT_TRUE(IgtlClient(server->port()).connected()) << "the twin";
}

TEST(IgtlServer, ListensBeyondThisMachineOnlyForWhomItNames) {
  ServerOptions options;
  options.port = 0;
  options.address = "0.0.0.0";
  const auto open = Server::start(options);
  ASSERT_FALSE(open.ok());
  EXPECT_THAT(open.error().message, HasSubstr("other machines reach 0.0.0.0"));
  options.allow = "10.0.0.0/4";
  EXPECT_FALSE(Server::start(options).ok());
  options.allow = "10.99.0.0/16";
  const auto named = Server::start(options);
  ASSERT_TRUE(named.ok()) << named.error().message;
  IgtlClient here((*named)->port());
  (*named)->publish(frame(1));
  EXPECT_EQ(here.next(), "STRING Guidance");
}

TEST(IgtlServer, HangsUpOnWhoIsNotAllowed) {
  auto listener = net::listen_at(net::resolve("127.0.0.1").value(), 0);
  ASSERT_TRUE(listener.ok());
  ServerThread thread(ServerOptions{}, net::Allowed::nobody(), std::move(*listener));
  IgtlClient stranger(thread.port());
  EXPECT_EQ(stranger.next(), "");
  EXPECT_EQ(thread.counts().refused, 1);
  EXPECT_EQ(thread.counts().served, 0);
}

TEST(IgtlServer, LetsNoMoreThanSoManyIn) {
  ServerOptions options;
  options.most_clients = 1;
  const auto server = started(options);
  IgtlClient first(server->port());
  server->publish(frame(1));
  EXPECT_EQ(first.next(), "STRING Guidance");
  EXPECT_EQ(IgtlClient(server->port()).next(), "");
  EXPECT_EQ(server->counts().refused, 1);
}

TEST(IgtlServer, LetsNobodyCallMoreOftenThanSo) {
  ServerOptions options;
  options.most_calls = 2;
  options.calls_counted_for = std::chrono::hours(1);
  const auto server = started(options);
  IgtlClient first(server->port());
  { IgtlClient second(server->port()); }
  ASSERT_TRUE(wait_until([&] { return server->counts().served == 2; }));
  IgtlClient third(server->port());
  server->publish(frame(1));
  EXPECT_EQ(first.next(), "STRING Guidance") << "the thread has come round";
  EXPECT_EQ(server->counts().served, 2);
  EXPECT_EQ(server->counts().clients, 1u);
}

TEST(IgtlServer, DropsWhoSendsTooMuch) {
  ServerOptions options;
  options.most_bytes_per_s = 5000;
  const auto server = started(options);
  IgtlClient loud(server->port());
  IgtlClient good(server->port());
  loud.send(packed_text({"Guidance", 0}, std::string(6000, 'x')));
  ASSERT_TRUE(wait_until([&] { return server->counts().dropped == 1; }));
  EXPECT_THAT(server->counts().last_drop, HasSubstr("sends more than 5000 bytes a second"));
  good.send(frame(1));
  server->publish(frame(1));
  EXPECT_EQ(good.next(), "STRING Guidance");
}

}  // namespace
}  // namespace orthonav::igtl::server_test
