#include "engine/case/case_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <tuple>

#include "engine/case/case_file.h"
#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine::case_writer_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The precision of a float at some 60 mm.
constexpr double kFloat_m = 1e-8;

/// Two boxes, one above the other.
Case boxes(bool planned) {
  const nav::ScrewPlan screw{nav::Side::kLeft, {{0.02, 0.03, 0}}, {{0.01, -0.01, 0}}, 0.003};
  std::vector<nav::ScrewPlan> screws;
  if (planned) {
    screws.push_back(screw);
  }
  return {
      "boxes",
      {},
      {{"L4", box_mesh(), screws, {}}, {"L5", box_mesh(), {}, {Mat3::identity(), {0, 0, -0.040}}}}};
}

TEST(CaseWriter, WritesWhatIsReadBack) {
  const TemporaryFolder folder;
  const Case written = phantom({"L4", "L5"});
  ASSERT_TRUE(save_case(folder.path().string(), written).ok());
  const auto read = load_case(folder.path().string());
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->name, written.name);
  ASSERT_EQ(read->levels.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const CaseLevel& a = written.levels[i];
    const CaseLevel& b = read->levels[i];
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
    EXPECT_LT((a.centre_in_spine() - b.centre_in_spine()).norm(), kFloat_m);
    ASSERT_EQ(a.screws.size(), b.screws.size());
    EXPECT_LT((a.screws[0].entry - b.screws[0].entry).norm(), kFloat_m);
    EXPECT_EQ(a.screws[0].radius_m, b.screws[0].radius_m);
  }
}

TEST(CaseWriter, KeepsACaseThatIsThere) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_case(folder.path().string(), boxes(true)).ok());
  const Status again = save_case(folder.path().string(), boxes(true));
  ASSERT_FALSE(again.ok());
  EXPECT_THAT(again.error().message, HasSubstr("case.json: already exists"));
}

TEST(CaseWriter, RefusesLabelsThatWouldLeaveTheFolder) {
  const TemporaryFolder folder;
  for (const std::string label : {"../L4", "L4/5", "", "L 4"}) {
    Case subject = boxes(true);
    subject.levels[0].label = label;
    const Status status = save_case(folder.path().string(), subject);
    ASSERT_FALSE(status.ok()) << label;
    EXPECT_THAT(status.error().message, HasSubstr("can't be the name of a file"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CaseWriter, AddsPlansToACaseWithoutAnyAndLeavesTheRest) {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  ASSERT_TRUE(save_case(path, boxes(false)).ok());
  const auto bare = load_case(path);
  ASSERT_FALSE(bare.ok());
  EXPECT_THAT(bare.error().message, HasSubstr("no level has screws (orthonav plan auto"));
  ASSERT_TRUE(load_case(path, CaseUse::kPlanning).ok());

  std::ignore = folder.with("case.json", R"({"note": "kept", "levels": [
    {"label": "L4", "model": "L4.stl", "surgeon": "kept"},
    {"label": "L5", "model": "L5.stl"}]})");
  ASSERT_TRUE(add_plans(path, boxes(true)).ok());
  const std::string text = test::content_of(folder.file("case.json"));
  EXPECT_THAT(text, HasSubstr(R"("note": "kept")"));
  EXPECT_THAT(text, HasSubstr(R"("surgeon": "kept")"));
  const auto read = load_case(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->levels[0].screws.size(), 1u);
  EXPECT_TRUE(read->levels[1].screws.empty()) << "a neighbour";
  EXPECT_THAT(levels_to_operate(*read).value(), ElementsAre("L4"));
  const auto neighbour = levels_to_operate(*read, {"L5"});
  ASSERT_FALSE(neighbour.ok());
  EXPECT_THAT(neighbour.error().message, HasSubstr("'L5' of case"));
  EXPECT_THAT(neighbour.error().message, HasSubstr("has no screws"));
}

TEST(CaseWriter, AddsNoPlanWhereThereIsOneOrTheModelWouldChange) {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  ASSERT_TRUE(save_case(path, boxes(false)).ok());
  ASSERT_TRUE(add_plans(path, boxes(true)).ok());
  const std::string before = test::content_of(folder.file("case.json"));
  const Status twice = add_plans(path, boxes(true));
  ASSERT_FALSE(twice.ok());
  EXPECT_THAT(twice.error().message, HasSubstr("L4 has a plan already"));
  EXPECT_EQ(test::content_of(folder.file("case.json")), before);

  const TemporaryFolder metres;
  std::ignore =
      metres.with("case.json", R"({"units": "m", "levels": [{"label": "L4", "model": "L4.stl"}]})");
  const Status other = add_plans(metres.path().string(), boxes(true));
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message, HasSubstr("units must be mm"));
  EXPECT_FALSE(std::filesystem::exists(metres.file("L4.plan.json")));
}

TEST(CaseWriter, AddsNoPlanToWhatIsNoCase) {
  for (const char* text :
       {R"({"units": 5, "levels": [{"label": "L4", "model": "L4.stl"}]})", R"({"levels": [5]})",
        R"({"levels": [{"label": 4, "model": "L4.stl"}]})", R"({"levels": 5})", "[]"}) {
    const TemporaryFolder folder;
    std::ignore = folder.with("case.json", text);
    const Status status = add_plans(folder.path().string(), boxes(true));
    ASSERT_FALSE(status.ok()) << text;
    EXPECT_THAT(status.error().message, HasSubstr("case.json: is not a case"));
    EXPECT_FALSE(std::filesystem::exists(folder.file("L4.plan.json"))) << text;
  }
}

TEST(CaseWriter, RefusesNamesThatAreTooLong) {
  const TemporaryFolder folder;
  Case subject = boxes(true);
  subject.levels[0].label = std::string(300, 'a');
  EXPECT_FALSE(save_case(folder.path().string(), subject).ok());
  EXPECT_FALSE(save_case(folder.file(std::string(300, 'a')), boxes(true)).ok());
  std::ignore = folder.with("case.json", R"({"levels": []})");
  EXPECT_FALSE(add_plans(folder.path().string(), subject).ok());
}

}  // namespace
}  // namespace orthonav::engine::case_writer_test
