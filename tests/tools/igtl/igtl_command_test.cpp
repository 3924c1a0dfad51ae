#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/igtl_client.h"
#include "tests/support/pose_server.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"
#include "tests/tools/command_line.h"
#include "tests/tools/igtl/screw_plan.h"
#include "tests/tools/igtl/served_port.h"

namespace orthonav::tools::igtl_test {
namespace {

using test::StartedCommand;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

TEST(IgtlCommand, ServesARunUntilItEnds) {
  const test::ScratchFolder folder;
  StartedCommand command({"run", "--headset", "sim:?seed=3", "--levels", "L5", "--igtl", "0",
                          "--out", folder.file("out")});
  int port = 0;
  ASSERT_TRUE(test::wait_until([&] { return (port = served_port(command)) != 0; }));
  test::IgtlClient listener(port);
  std::set<std::string> heard;
  const std::set<std::string> wanted = {"POINT L5leftScrew", "POLYDATA L5rightScrewModel",
                                        "STATUS orthonav", "STRING Guidance",
                                        "TRANSFORM PointerToReference"};
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

TEST(IgtlCommand, AnswersWhatItsClientsAskWhereTheyMay) {
  const test::ScratchFolder folder;
  StartedCommand command({"run", "--headset", "sim:?seed=3", "--levels", "L5", "--igtl", "0",
                          "--igtl-commands", "--out", folder.file("out")});
  int port = 0;
  ASSERT_TRUE(test::wait_until([&] { return (port = served_port(command)) != 0; }));
  test::IgtlClient client(port);
  // Once it runs.
  for (std::string name = client.next(); name != "STRING Guidance"; name = client.next()) {
    ASSERT_FALSE(name.empty()) << "it ended";
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
            [](const auto& a, const auto& b) { return a["asked"] < b["asked"]; });
  EXPECT_EQ(answers[0]["taken"], false);
  EXPECT_EQ(answers[0]["why"], "\"begin\" is not a command");
  EXPECT_EQ(answers[1]["asked"], "plan L4 left");
  EXPECT_EQ(answers[1]["client"], "127.0.0.1");
  EXPECT_EQ(answers[1]["taken"], false) << "no level is accepted yet";
  EXPECT_THAT(answers[1]["why"].get<std::string>(), HasSubstr("not possible now"));
  EXPECT_TRUE(answers[1].contains("status")) << "it got to the operation";
  ASSERT_TRUE(test::wait_until([&] { return command.takes_signals(); }));
  command.send(SIGTERM);
  EXPECT_THAT(command.wait().err, HasSubstr("its clients may command"));
}

/// A tracker that sends one pose after another.
class Sender {
 public:
  using Pose = Transform<World, Marker>;
  explicit Sender(std::function<Pose(int)> pose =
                      [](int i) {
                        return Pose(Mat3::identity(), {1e-5 * i, 0.0, -1.0});
                      })
      : pose_(std::move(pose)) {}
  ~Sender() {
    over_ = true;
    thread_.join();
  }
  [[nodiscard]] std::string uri() const { return "igtl:" + server_.uri("pointer=ProbeToTracker"); }

 private:
  void run() {
    for (int i = 0; !over_; ++i) {
      server_.add("ProbeToTracker", pose_(i), 1.7e9 + 0.005 * i);
      server_.send();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  std::function<Pose(int)> pose_;
  test::PoseServer server_;
  std::atomic<bool> over_ = false;
  std::thread thread_{[this] { run(); }};
};

TEST(IgtlCommand, RunsOnToolsThatAnotherProgramTracks) {
  const Sender sender;
  const test::ScratchFolder folder;
  const std::string tools = folder.with("tools.json", R"({"tools": [
      {"name": "pointer", "role": "pointer", "tip_mm": [0, 0, 0]},
      {"name": "guide", "role": "guide", "tip_mm": [0, -150, 0]}]})");
  const test::Called ran =
      test::orthonav({"run", "--headset", sender.uri(), "--tools", tools, "--levels", "L5",
                      "--frames", "20", "--out", folder.file("out")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("20 frames displayed"));
  EXPECT_THAT(ran.err, HasSubstr("has no button: --clicker names one"));
}

TEST(IgtlCommand, PivotsAToolThatAnotherProgramTracks) {
  const Vec3 tip_m{0.002, -0.15, 0.001};
  const Sender sender([tip_m](int i) {
    const Mat3 rotation = rotation_from_vector(
        {0.4 * std::cos(0.05 * i), 0.2 * std::sin(0.03 * i), 0.4 * std::sin(0.05 * i)});
    return Sender::Pose(rotation, Vec3{0.1, 0.0, -1.0} - rotation * tip_m);
  });
  const test::TemporaryFolder folder;
  const std::string tools = folder.with("tools.json", R"({"tools": [
      {"name": "pointer", "role": "pointer", "tip_mm": [0, -100, 0]}]})");
  const std::vector<std::string> pivot = {"calibrate", "pivot", sender.uri(), "--seconds", "2"};
  const auto with = [&pivot](const std::vector<std::string>& more) {
    std::vector<std::string> all = pivot;
    all.insert(all.end(), more.begin(), more.end());
    return test::orthonav(all);
  };
  const test::Called called = with({"--tools", tools, "--tool", "pointer", "--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["format"], "OpenIGTLink");
  EXPECT_GE(json["poses"], 40);
  EXPECT_NEAR(json["tip_mm"][1], -150.0, 0.01);
  EXPECT_THAT(with({}).err, HasSubstr("--tools is required"));
}

TEST(IgtlCommand, RefusesPlacesWhereNobodyCanListen) {
  for (const std::string at : {"port", "70000", "localhost:18944", "1.2.3.4.5:18944", "::1:18944",
                               "[::1]", "18944:18944", "127.0.0.1:1:2"}) {
    const test::Called called = test::orthonav({"run", "--frames", "1", "--igtl", at});
    EXPECT_EQ(called.code, 2) << at;
    EXPECT_THAT(called.err, HasSubstr("--igtl \"" + at + "\": "));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
  }
}

TEST(IgtlCommand, SaysForWhomItListensBeyondThisMachine) {
  const test::Called open = test::orthonav({"run", "--frames", "1", "--igtl", "0.0.0.0:0"});
  EXPECT_EQ(open.code, 2);
  EXPECT_THAT(open.err, HasSubstr("--igtl-token: OpenIGTLink: other machines reach 0.0.0.0"));
  const test::Called no_port = test::orthonav({"run", "--frames", "1", "--igtl-token", "token"});
  EXPECT_EQ(no_port.code, 2);
  EXPECT_THAT(no_port.err, HasSubstr("--igtl-token: needs --igtl"));
  const test::Called alone = test::orthonav({"run", "--frames", "1", "--igtl-allow", "10.0.0.7"});
  EXPECT_EQ(alone.code, 2);
  EXPECT_THAT(alone.err, HasSubstr("--igtl-allow: needs --igtl"));
  const test::Called commands = test::orthonav({"run", "--frames", "1", "--igtl-commands"});
  EXPECT_EQ(commands.code, 2);
  EXPECT_THAT(commands.err, HasSubstr("--igtl-commands: needs --igtl"));
}

}  // namespace
}  // namespace orthonav::tools::igtl_test
