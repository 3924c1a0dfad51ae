#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tests/support/igtl_client.h"
#include "tests/support/pose_server.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"
#include "tests/tools/command_line.h"
#include "tools/igtl_messages.h"
#include "tools/igtl_requests.h"

namespace orthonav::tools::igtl_test {
namespace {

using test::StartedCommand;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using Bytes = std::vector<std::uint8_t>;

constexpr float kFloat_mm = 1e-3F;

/// Bodies by type and device.
using Messages = std::map<std::string, Bytes>;

igtl::Header header_at(const Bytes& bytes, std::size_t at) {
  return igtl::parsed_header(std::span<const std::uint8_t, igtl::kHeaderBytes>(bytes.data() + at,
                                                                               igtl::kHeaderBytes))
      .value();
}

Messages messages_in(const Bytes& bytes) {
  Messages out;
  for (std::size_t at = 0; at < bytes.size();) {
    const igtl::Header header = header_at(bytes, at);
    const auto body = bytes.begin() + static_cast<std::ptrdiff_t>(at + igtl::kHeaderBytes);
    out[header.type + " " + header.device] = {
        body, body + static_cast<std::ptrdiff_t>(header.body_bytes)};
    at += igtl::kHeaderBytes + static_cast<std::size_t>(header.body_bytes);
  }
  return out;
}

float float_at(const Bytes& body, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits = bits << 8u | body.at(at + i);
  }
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// A TRANSFORM's body applied to a point, mm.
std::array<float, 3> moved(const Bytes& transform, std::array<float, 3> p) {
  std::array<float, 3> out{};
  for (std::size_t row = 0; row < 3; ++row) {
    out[row] = float_at(transform, 4 * (9 + row));
    for (std::size_t column = 0; column < 3; ++column) {
      out[row] += float_at(transform, 4 * (3 * column + row)) * p[column];
    }
  }
  return out;
}

engine::LevelState level_l4() {
  engine::LevelState level;
  level.plan.label = "L4";
  level.plan.screws = {{nav::Side::kLeft, {{0.02, 0.03, 0.004}}, {{0.01, -0.01, 0.005}}, 0.003}};
  return level;
}

TEST(IgtlMessages, NamesDevicesWithinTwentyBytesAndWithOneTo) {
  EXPECT_EQ(igtl_device("pointer", "Reference"), "PointerToReference");
  EXPECT_EQ(igtl_device("drill guide 2", "World"), "Drillguide2ToWorld");
  EXPECT_EQ(igtl_device("screwdriver", "Reference"), "ScrewdrivToReference");
  EXPECT_EQ(igtl_device("ToTo", "World"), "TotoToWorld");
}

TEST(IgtlMessages, PutAModelInRasWhereTheRegistrationHasTheBone) {
  engine::LevelState level = level_l4();
  nav::Registration registration;
  registration.world_from_vertebra = {rotation_from_vector({0.1, 0.5, -0.3}), {0.1, -0.2, 0.3}};
  level.registration = registration;
  engine::Guidance guidance;
  guidance.levels = {&level, 1};
  EXPECT_TRUE(igtl_models(guidance).empty()) << "not accepted";
  level.accepted = true;
  const Messages world = messages_in(igtl_models(guidance));
  ASSERT_TRUE(world.contains("TRANSFORM L4ModelToWorld"));
  // The screw's entry: LPS in the plan, RAS in the model that 3D Slicer holds.
  const Vec3 want = 1e3 * (registration.world_from_vertebra * level.plan.screws[0].entry).v;
  const auto got = moved(world.at("TRANSFORM L4ModelToWorld"), {-20.0F, -30.0F, 4.0F});
  EXPECT_NEAR(got[0], want.x, kFloat_mm);
  EXPECT_NEAR(got[1], want.y, kFloat_mm);
  EXPECT_NEAR(got[2], want.z, kFloat_mm);

  nav::Anchor anchor;
  anchor.places = {{2, {rotation_from_vector({0, 0.2, 0}), {0.05, 0, 0}}}};
  guidance.anchor = &anchor;
  const Messages reference = messages_in(igtl_models(guidance));
  ASSERT_TRUE(reference.contains("TRANSFORM L4ModelToReference"));
  const Vec3 seen = (anchor.places[0].anchored_from_marker.inverse() * Point<World>{want * 1e-3}).v;
  EXPECT_NEAR(moved(reference.at("TRANSFORM L4ModelToReference"), {-20.0F, -30.0F, 4.0F})[0],
              1e3 * seen.x, kFloat_mm);
  level.unverified = true;
  EXPECT_TRUE(igtl_models(guidance).empty()) << "restored, and not verified since";
}

TEST(IgtlMessages, TellScrewsAsPointsAndAsACylinder) {
  const engine::LevelState level = level_l4();
  const Messages screws = messages_in(igtl_screws({&level, 1}, {}));
  ASSERT_TRUE(screws.contains("POINT L4leftScrew"));
  const Bytes& points = screws.at("POINT L4leftScrew");
  ASSERT_EQ(points.size(), 2u * 136u);
  EXPECT_EQ(float_at(points, 100), -20.0F);
  EXPECT_EQ(float_at(points, 104), -30.0F);
  EXPECT_EQ(float_at(points, 108), 4.0F);
  EXPECT_EQ(float_at(points, 112), 3.0F) << "radius";
  EXPECT_EQ(float_at(points, 136 + 104), 10.0F) << "the target";
  ASSERT_TRUE(screws.contains("POLYDATA L4leftScrewModel"));
}

/// The port that the command reports; 0: none yet.
int port_of(const StartedCommand& command) {
  const std::string said = command.err_so_far();
  const std::string before = "OpenIGTLink at 127.0.0.1:";
  const std::size_t at = said.find(before);
  return at == std::string::npos || said.find('\n', at) == std::string::npos
             ? 0
             : std::stoi(said.substr(at + before.size()));
}

TEST(IgtlCommand, ServesARunUntilItEnds) {
  StartedCommand command({"run", "--headset", "sim:?seed=3", "--levels", "L5", "--igtl", "0"});
  int port = 0;
  ASSERT_TRUE(test::wait_until([&] { return (port = port_of(command)) != 0; }));
  test::IgtlClient listener(port);
  std::set<std::string> heard;
  const std::set<std::string> wanted = {"POINT L5leftScrew", "POLYDATA L5rightScrewModel",
                                        "STATUS orthonav", "STRING Guidance",
                                        "TRANSFORM PointerToWorld"};
  for (std::string name = listener.next(); !name.empty(); name = listener.next()) {
    heard.insert(name);
    if (name == "STRING Guidance") {
      const std::string text(listener.last_body().begin() + 4, listener.last_body().end());
      EXPECT_EQ(nlohmann::json::parse(text)["guiding"], false) << "nothing is registered yet";
    }
    if (std::includes(heard.begin(), heard.end(), wanted.begin(), wanted.end())) {
      break;
    }
  }
  EXPECT_THAT(heard, IsSupersetOf(wanted));
  ASSERT_TRUE(test::wait_until([&] { return command.takes_signals(); }));
  command.send(SIGTERM);
  EXPECT_THAT(command.wait().err, HasSubstr("OpenIGTLink: 1 client, "));
}

/// The reason why such a text is refused; empty: it is accepted.
std::string refusal(const std::string& device, const std::string& text) {
  const auto request = request_of(device, text);
  return request ? "" : request.error().message;
}

constexpr const char* kScrew =
    R"({"units": "mm", "frame": "RAS", "level": "L4", "screws": [{"side": "left",
        "entry": [-15, -20, 4], "target": [-15, 15, 4], "radius": 3}]})";

TEST(IgtlRequests, AreTheWordsThatOneWouldSay) {
  for (const char* said :
       {"start", "next", "move rod", "move cranial one", "screw six forty five"}) {
    const auto request = request_of("Command", said);
    ASSERT_TRUE(request.ok()) << request.error().message;
    EXPECT_EQ(request->text, said);
    EXPECT_FALSE(request->change);
  }
  EXPECT_THAT(refusal("Command", "begin"), HasSubstr("\"begin\" is no command"));
  EXPECT_THAT(refusal("Command", ""), HasSubstr("is no command"));
  EXPECT_THAT(refusal("Command", "next\n"), HasSubstr("one line"));
  EXPECT_THAT(refusal("Command", std::string(81, 'a')), HasSubstr("at most 80"));
  EXPECT_THAT(refusal("Command", "move up one"), HasSubstr("say cranial"));
}

TEST(IgtlRequests, AreAPlanOfTheScrewInWork) {
  const auto request = request_of("Plan", kScrew);
  ASSERT_TRUE(request.ok()) << request.error().message;
  EXPECT_EQ(request->text, "plan L4 left");
  ASSERT_TRUE(request->change);
  const auto& place = std::get<engine::PlaceScrew>(*request->change);
  EXPECT_EQ(place.level, "L4");
  EXPECT_EQ(place.side, nav::Side::kLeft);
  EXPECT_LT((place.entry.v - Vec3{0.015, 0.020, 0.004}).norm(), 1e-12) << "LPS, metres";
  EXPECT_LT((place.target.v - Vec3{0.015, -0.015, 0.004}).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(place.radius_m, 0.003);
}

TEST(IgtlRequests, RefuseAPlanThatAFileMayNotBeAndMoreThanOneScrew) {
  const std::string plan = kScrew;
  const auto with = [&plan](const std::string& from, const std::string& to) {
    std::string changed = plan;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal("Plan", "no JSON"), HasSubstr("Plan: "));
  EXPECT_THAT(refusal("Plan", with("\"mm\"", "\"inch\"")), HasSubstr("must be mm or m"));
  EXPECT_THAT(refusal("Plan", with(R"("level": "L4", )", "")), HasSubstr("must name its level"));
  EXPECT_THAT(refusal("Plan", with("\"radius\": 3", "\"radius\": 9")), HasSubstr("radius"));
  EXPECT_THAT(refusal("Plan", with("\"radius\": 3", R"("radius": 3, "accept_breach": "mine")")),
              HasSubstr("accept_breach is not taken from outside"));
  const std::string second =
      R"(}, {"side": "right", "entry": [15, -20, 4], "target": [15, 15, 4], "radius": 3}]})";
  EXPECT_THAT(refusal("Plan", with("}]}", second)), HasSubstr("holds 2 screws, must be 1"));
}

TEST(IgtlCommand, AnswersWhatItsClientsAskWhereTheyMay) {
  StartedCommand command(
      {"run", "--headset", "sim:?seed=3", "--levels", "L5", "--igtl", "0", "--igtl-commands"});
  int port = 0;
  ASSERT_TRUE(test::wait_until([&] { return (port = port_of(command)) != 0; }));
  test::IgtlClient client(port);
  // Once it runs.
  while (client.next() != "STRING Guidance") {
  }
  client.send(igtl::packed_text({"Command", 0}, "begin"));
  client.send(igtl::packed_text({"Plan", 0}, kScrew));
  std::vector<nlohmann::json> answers;
  for (std::string name = client.next(); !name.empty() && answers.size() < 2;
       name = client.next()) {
    if (name == "STRING CommandAnswer") {
      answers.push_back(
          nlohmann::json::parse(client.last_body().begin() + 4, client.last_body().end()));
    }
  }
  ASSERT_EQ(answers.size(), 2u);
  std::sort(answers.begin(), answers.end(),
            [](const auto& a, const auto& b) { return a.contains("why") && !b.contains("why"); });
  EXPECT_EQ(answers[0]["taken"], false);
  EXPECT_EQ(answers[0]["why"], "\"begin\" is no command");
  EXPECT_EQ(answers[1]["asked"], "plan L4 left");
  EXPECT_EQ(answers[1]["client"], "127.0.0.1");
  EXPECT_EQ(answers[1]["taken"], false) << "no level is accepted yet";
  ASSERT_TRUE(test::wait_until([&] { return command.takes_signals(); }));
  command.send(SIGTERM);
  EXPECT_THAT(command.wait().err, HasSubstr("its clients may command"));
}

/// A tracker that sends one pose after another.
class Sender {
 public:
  ~Sender() {
    over_ = true;
    thread_.join();
  }
  [[nodiscard]] std::string uri() const { return "igtl:" + server_.uri("pointer=ProbeToTracker"); }

 private:
  void run() {
    for (int i = 0; !over_; ++i) {
      server_.add("ProbeToTracker", {Mat3::identity(), {1e-5 * i, 0.0, -1.0}}, 1.7e9 + 0.005 * i);
      server_.send();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  test::PoseServer server_;
  std::atomic<bool> over_ = false;
  std::thread thread_{[this] { run(); }};
};

TEST(IgtlCommand, RunsOnToolsThatAnotherProgramTracks) {
  const Sender sender;
  const test::TemporaryFolder folder;
  const std::string tools = folder.with("tools.json", R"({"tools": [
      {"name": "pointer", "role": "pointer", "tip_mm": [0, 0, 0]},
      {"name": "guide", "role": "guide", "tip_mm": [0, -150, 0]}]})");
  const test::Called ran = test::orthonav(
      {"run", "--headset", sender.uri(), "--tools", tools, "--levels", "L5", "--frames", "20"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("20 frames displayed"));
  EXPECT_THAT(ran.err, HasSubstr("has no button: --clicker names one"));
}

TEST(IgtlCommand, RefusesPlacesWhereNobodyCanListen) {
  for (const std::string at : {"port", "70000", "localhost:18944", "1.2.3.4.5:18944"}) {
    const test::Called called = test::orthonav({"run", "--frames", "1", "--igtl", at});
    EXPECT_EQ(called.code, 2) << at;
    EXPECT_THAT(called.err, HasSubstr("--igtl \"" + at + "\": "));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
  }
}

TEST(IgtlCommand, SaysForWhomItListensBeyondThisMachine) {
  const test::Called open = test::orthonav({"run", "--frames", "1", "--igtl", "0.0.0.0:0"});
  EXPECT_EQ(open.code, 2);
  EXPECT_THAT(open.err, HasSubstr("--igtl-allow: OpenIGTLink: other machines reach 0.0.0.0"));
  const test::Called alone = test::orthonav({"run", "--frames", "1", "--igtl-allow", "10.0.0.7"});
  EXPECT_EQ(alone.code, 2);
  EXPECT_THAT(alone.err, HasSubstr("--igtl-allow: needs --igtl"));
  const test::Called commands = test::orthonav({"run", "--frames", "1", "--igtl-commands"});
  EXPECT_EQ(commands.code, 2);
  EXPECT_THAT(commands.err, HasSubstr("--igtl-commands: needs --igtl"));
}

}  // namespace
}  // namespace orthonav::tools::igtl_test
