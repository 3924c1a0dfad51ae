#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "hal/net/socket.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::serve_hl2ss_test {
namespace {

using ::testing::HasSubstr;

TEST(ServeHl2ss, RefusesWhatItDoesNotKnow) {
  const Called faults = orthonav({"serve-hl2ss", "--faults", "gaps=0.1"});
  EXPECT_EQ(faults.code, 2);
  EXPECT_THAT(faults.err,
              HasSubstr("--faults: faults: \"gaps=0.1\" is not understood; known are gap"));
  const Called host = orthonav({"serve-hl2ss", "--host", "no.such.host.invalid"});
  EXPECT_EQ(host.code, 2);
  EXPECT_THAT(host.err, HasSubstr("no.such.host.invalid"));
}

TEST(ServeHl2ss, ListensBeyondThisMachineOnlyForWhomItNames) {
  const Called open = orthonav({"serve-hl2ss", "--listen", "0.0.0.0"});
  EXPECT_EQ(open.code, 2);
  EXPECT_THAT(open.err, HasSubstr("hl2ss server: other machines reach 0.0.0.0"));
  EXPECT_THAT(open.err, HasSubstr("name who may connect"));
  const Called everybody = orthonav({"serve-hl2ss", "--listen", "0.0.0.0", "--allow", "0.0.0.0/0"});
  EXPECT_EQ(everybody.code, 2);
  EXPECT_THAT(everybody.err, HasSubstr("network \"0.0.0.0/0\" must have 8 to 32 bits"));
}

/// A run with behaviour of real units: the stand-in's command-line options, one by one.
struct Unit {
  const char* name;
  int port;  ///< its own, since two runs may go on at once; not an ephemeral one
  std::vector<std::string> serve;
  std::string uri;     ///< besides address and ports
  std::string counts;  ///< in the statistics of the connection
};
void PrintTo(const Unit& unit, std::ostream* out) { *out << unit.name; }

class StandIn : public ::testing::TestWithParam<Unit> {};

TEST_P(StandIn, IsRunThrough) {
  std::vector<std::string> words = {"serve-hl2ss", "--levels", "L5",
                                    "--paced",     "--port",   std::to_string(GetParam().port)};
  words.insert(words.end(), GetParam().serve.begin(), GetParam().serve.end());
  StartedCommand server(words);
  ASSERT_TRUE(wait_until([&] { return server.err_so_far().find("serving") != std::string::npos; }))
      << server.err_so_far();
  const std::string uri = "hl2ss://127.0.0.1?port=" + std::to_string(GetParam().port) +
                          "&standin=" + std::to_string(GetParam().port + 19) + GetParam().uri;
  const ScratchFolder folder;
  const Called run = orthonav({"run", "--headset", uri, "--levels", "L5", "--frames", "30",
                               "--stats", "--json", "--out", folder.file("out")});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["frames"]["displayed"], 30) << run.err;
  EXPECT_THAT(run.err, HasSubstr(GetParam().counts));
}

INSTANTIATE_TEST_SUITE_P(
    Every, StandIn,
    // Uncorrected late stamps, edges of zeros; stamps 0.1 s back (or 1 s ahead), slices.
    ::testing::Values(Unit{"StampsLateZerosAtTheEdges",
                           27612,
                           {"--unmapped-edge-px", "8"},
                           "&stamps=exact",
                           " 0 damaged"},
                      Unit{"StampsJumpBackSlices",
                           27712,
                           {"--faults", "misstamp=0.2", "--slices", "4"},
                           "&profile=h264",
                           "packets refused, the last one: stamp"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(ServeHl2ss, SaysWhichPortIsTaken) {
  const auto host = net::resolve("127.0.0.1");
  ASSERT_TRUE(host.ok());
  constexpr int kPort = 27312;
  const auto taken = net::listen_at(*host, kPort);
  ASSERT_TRUE(taken.ok()) << taken.error().message;
  const Called called =
      orthonav({"serve-hl2ss", "--port", std::to_string(kPort), "--levels", "L5"});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("port 27312: Address already in use"));
}

TEST(ServeHl2ss, TakesItsHostAndItsPortApart) {
  for (const auto& [host, why] : std::to_array<std::pair<const char*, const char*>>(
           {{"127.0.0.1:3800", "--port names the first port"},
            {"::1", "in brackets, as in [::1]"},
            {"3800", "must be a name, or four numbers"}})) {
    const Called called = orthonav({"serve-hl2ss", "--host", host, "--levels", "L5"});
    EXPECT_EQ(called.code, 2) << host;
    EXPECT_THAT(called.err, HasSubstr(std::string("--host \"") + host + "\": "));
    EXPECT_THAT(called.err, HasSubstr(why));
  }
}

TEST(Doctor, LooksAtTheHeadsetsPorts) {
  const Called closed = orthonav({"doctor", "--headset", "hl2ss://127.0.0.1?port=27400"});
  EXPECT_THAT(closed.out, HasSubstr("HoloLens 2: left camera"));
  EXPECT_THAT(closed.out, HasSubstr("127.0.0.1, port 27400: Connection refused"));
  const Called other = orthonav({"doctor", "--headset", "sim:"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("known are hl2ss://HOST and replay:PATH"));
}

TEST(RunWithAHeadset, SaysWhichPortDoesNotAnswer) {
  const ScratchFolder folder;
  const Called called =
      orthonav({"run", "--headset", "hl2ss://127.0.0.1?port=27400", "--out", folder.file("out")});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("hl2ss: 127.0.0.1: port 27400: Connection refused"));
}

}  // namespace
}  // namespace orthonav::test::serve_hl2ss_test
