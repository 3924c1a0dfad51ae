#include "engine/case/markups_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/case/plan_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine::markups_plan_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

/// 1e-6 mm, as the round trip is asked for.
constexpr double kSame_m = 1e-9;

std::vector<nav::ScrewPlan> screws() {
  return {
      {nav::Side::kLeft, {{0.0200001234, 0.03, 0.001}}, {{0.01, -0.014, 0.0023456789}}, 0.00325},
      {nav::Side::kRight, {{-0.02, 0.03, 0}}, {{-0.01, -0.01, 0}}, 0.002, "in-out-in"}};
}

TEST(MarkupsPlan, IsReadBackAsThePlanThatItWas) {
  const TemporaryFolder folder;
  const std::string path = folder.file("L4.mrk.json");
  ASSERT_TRUE(save_markups_plan(path, "L4", screws()).ok());
  const auto plan = load_plan(path);
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->level, "L4");
  const auto read = screws_on(box_mesh(), *plan);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const nav::ScrewPlan want = screws()[i];
    EXPECT_EQ((*read)[i].side, want.side);
    EXPECT_LT(((*read)[i].entry - want.entry).norm(), kSame_m);
    EXPECT_LT(((*read)[i].target - want.target).norm(), kSame_m);
    EXPECT_NEAR((*read)[i].radius_m, want.radius_m, kSame_m);
    EXPECT_EQ((*read)[i].accepted_breach, want.accepted_breach);
  }
}

TEST(MarkupsPlan, SaysWhatSlicerNeeds) {
  const TemporaryFolder folder;
  const std::string path = folder.file("L4.mrk.json");
  ASSERT_TRUE(save_markups_plan(path, "L4", screws()).ok());
  const auto root = nlohmann::json::parse(test::content_of(path));
  EXPECT_THAT(root["@schema"].get<std::string>(), HasSubstr("markups-schema-v1.0.3.json"));
  const auto& line = root["markups"][0];
  EXPECT_EQ(line["name"], "L4 left diameter=6.5") << "a name is kept when Slicer saves";
  EXPECT_EQ(line["type"], "Line");
  EXPECT_EQ(line["coordinateSystem"], "LPS");
  EXPECT_EQ(line["coordinateUnits"], "mm");
  ASSERT_EQ(line["controlPoints"].size(), 2u);
  EXPECT_EQ(line["controlPoints"][0]["positionStatus"], "defined");
  EXPECT_EQ(line["controlPoints"][0]["orientation"].size(), 9u);
  EXPECT_NEAR(line["controlPoints"][0]["position"][0].get<double>(), 20.0001234, 1e-9);
}

TEST(MarkupsPlan, RefusesANameThatWouldNotBeReadAsMarkups) {
  const TemporaryFolder folder;
  const Status status = save_markups_plan(folder.file("L4.json"), "L4", screws());
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("must end in .mrk.json"));
}

}  // namespace
}  // namespace orthonav::engine::markups_plan_test
