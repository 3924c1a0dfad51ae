#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "engine/case/case_file.h"
#include "engine/case/plan_file.h"
#include "tests/support/igtl_client.h"
#include "tests/support/wait_until.h"
#include "tests/tools/command_line.h"
#include "tests/tools/igtl/served_port.h"

namespace orthonav::tools::igtl_test {
namespace {

using test::ScratchFolder;
using test::StartedCommand;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// `plan receive` of the built-in phantom, and a client of it.
class PlanReceive : public ::testing::Test {
 protected:
  void start() {
    command_.emplace(std::vector<std::string>{"plan", "receive", "--igtl", "0", "--out", out_});
    int port = 0;
    ASSERT_TRUE(test::wait_until([&] { return (port = served_port(*command_)) != 0; }));
    client_.emplace(port);
  }
  /// The answer to what is sent.
  nlohmann::json answer(const std::string& device, const std::string& text) {
    client_->send(igtl::packed_text({device, 0}, text));
    for (std::string name = client_->next(); !name.empty(); name = client_->next()) {
      if (name == "STRING CommandAnswer") {
        return nlohmann::json::parse(client_->last_body().begin() + 4, client_->last_body().end());
      }
    }
    return {{"why", "the command hung up"}};
  }
  /// The case that `plan auto` makes of the phantom, once for all tests.
  static std::string planned() {
    static const ScratchFolder folder;
    const std::string path = folder.file("planned");
    if (!std::filesystem::exists(path)) {
      EXPECT_EQ(test::orthonav({"plan", "auto", "--out", path}).code, 0);
    }
    return path;
  }
  static std::string plan_of(const std::string& level) {
    return test::content_of(planned() + "/" + level + ".plan.json");
  }

  ScratchFolder scratch_;
  const std::string out_ = scratch_.file("received");
  std::optional<StartedCommand> command_;
  std::optional<test::IgtlClient> client_;
};

TEST_F(PlanReceive, WritesACaseWithThePlansThatClientsSent) {
  const std::string plan = plan_of("L4");
  start();
  EXPECT_EQ(answer("Command", "save")["why"], "no plan was received yet");
  const nlohmann::json taken = answer("Plan", plan);
  EXPECT_EQ(taken["asked"], "plan L4");
  EXPECT_EQ(taken["client"], "127.0.0.1");
  EXPECT_EQ(taken["taken"], true) << taken;
  ASSERT_THAT(taken["screws"], SizeIs(2));
  EXPECT_EQ(taken["screws"][0]["side"], "left");
  EXPECT_EQ(taken["screws"][1]["grade"], "A");
  EXPECT_GT(taken["screws"][1]["clearance_mm"].get<double>(), 0.5);
  EXPECT_EQ(answer("Command", "save")["taken"], true);
  const test::Called ended = command_->wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("wrote " + out_));
  const auto written = engine::load_case(out_);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto asked = engine::parse_plan(plan, "plan");
  ASSERT_THAT(written->find("L4")->screws, SizeIs(2));
  for (std::size_t i = 0; i < 2; ++i) {
    const nav::ScrewPlan& screw = written->find("L4")->screws[i];
    EXPECT_LT((screw.entry.v - asked->screws[i].entry.v).norm(), 1e-9);
    EXPECT_LT((screw.target.v - asked->screws[i].target.v).norm(), 1e-9);
  }
}

TEST_F(PlanReceive, TakesTheLinesOf3DSlicer) {
  const std::string slicer = scratch_.file("slicer");
  ASSERT_EQ(test::orthonav({"plan", "export", "--case", planned(), "--out", slicer}).code, 0);
  start();
  const nlohmann::json taken = answer("Plan", test::content_of(slicer + "/L5.mrk.json"));
  EXPECT_EQ(taken["asked"], "plan L5") << taken;
  EXPECT_EQ(answer("Command", "save")["taken"], true);
  EXPECT_EQ(command_->wait().code, 0);
}

TEST_F(PlanReceive, ServesTheScrewsAsTheyAreNow) {
  const std::string plan = plan_of("L4");
  start();
  std::set<std::string> heard;
  for (std::string name = client_->next(); !name.empty() && !heard.contains("STATUS orthonav");
       name = client_->next()) {
    heard.insert(name);
  }
  EXPECT_TRUE(heard.contains("POINT L4leftScrew"));
  EXPECT_TRUE(heard.contains("POLYDATA L5rightScrewModel"));
  client_->send(igtl::packed_text({"Plan", 0}, plan));
  for (std::string name = client_->next(); name != "POINT L4leftScrew"; name = client_->next()) {
    ASSERT_FALSE(name.empty());
  }
  EXPECT_EQ(answer("Command", "cancel")["taken"], true);
  EXPECT_EQ(command_->wait().code, 1);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(PlanReceive, RefusesAPlanAsAWholeAndGoesOn) {
  const std::string plan = plan_of("L1");
  start();
  const auto with = [&plan](const std::string& from, const std::string& to) {
    std::string changed = plan;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(answer("Plan", "{")["why"].get<std::string>(), HasSubstr("Plan: "));
  EXPECT_THAT(answer("Plan", with("\"L1\"", "\"T12\""))["why"].get<std::string>(),
              HasSubstr("has no level 'T12'"));
  // Seen from the other side, the bone is in front of the screw.
  EXPECT_THAT(answer("Plan", with("\"LPS\"", "\"RAS\""))["why"].get<std::string>(),
              HasSubstr("entry"));
  // Twice as thick as the pedicle has room for.
  nlohmann::json thick = nlohmann::json::parse(plan);
  thick["screws"][1]["radius"] = 6.0;
  const nlohmann::json breach = answer("Plan", thick.dump());
  EXPECT_EQ(breach["taken"], false);
  EXPECT_THAT(breach["why"].get<std::string>(),
              HasSubstr("L1 right: breaks through the cortex: clearance -"));
  thick["screws"][1]["accept_breach"] = "in-out-in";
  EXPECT_EQ(answer("Plan", thick.dump())["taken"], true);
  EXPECT_THAT(answer("Command", "next")["why"].get<std::string>(), HasSubstr("no command"));
  ASSERT_TRUE(test::wait_until([&] { return command_->takes_signals(); }));
  command_->send(SIGTERM);
  const test::Called ended = command_->wait();
  EXPECT_EQ(ended.code, 128 + SIGTERM);
  EXPECT_THAT(ended.err, HasSubstr("stopped by SIGTERM, nothing is written"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(PlanReceive, RefusesAFolderThatHoldsACase) {
  const test::Called called =
      test::orthonav({"plan", "receive", "--igtl", "0", "--out", planned()});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("case.json"));
}

}  // namespace
}  // namespace orthonav::tools::igtl_test
