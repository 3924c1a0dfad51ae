// What `register` refuses, and what it says then. The bones are those of register_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/tools/register_command.h"

namespace orthonav::test::register_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

TEST_P(RegisterCommand, SaysNoToACloudThatIsNotTheBone) {
  Random random(3);
  for (Vec3& p : points_m_) {
    p = {random.normal(0, 0.02), random.normal(0, 0.02), random.normal(0, 0.02)};
  }
  const Called called =
      orthonav({"register", "--model", model_, "--points", points_file(1e3), "--json", "-"});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(called.err, StartsWith("orthonav: refused: "));
  const json report = json::parse(called.out);
  EXPECT_EQ(report["accepted"], false);
  EXPECT_THAT(report["reasons"], Not(IsEmpty()));
  const Called paper =
      orthonav({"register", "--model", model_, "--points", points_file(1e3), "--method", "paper"});
  EXPECT_EQ(paper.code, 0) << "the published method refuses nothing";
  EXPECT_THAT(paper.out, StartsWith("not judged, look at it: "));
}

TEST_P(RegisterCommand, RefusesBadInputInOneLineAndWritesNothing) {
  const std::string good = points_file(1e3);
  std::string few = "x,y,z\n";
  for (int i = 0; i < 99; ++i) {
    few += std::to_string(i) + ",0,0\n";
  }
  const std::string metres = points_file(1.0, "metres.csv");
  struct Case {
    std::string model, points, expected;
  };
  const std::vector<Case> cases = {
      {folder_.file("none.stl"), good, "none.stl"},
      {folder_.with("empty.stl", ""), good, "empty.stl"},
      {model_, folder_.file("none.csv"), "none.csv"},
      {model_, folder_.with("few.csv", few), "99 points, needs at least 100"},
      {model_, folder_.with("nan.csv", "x,y,z\n1,nan,2\n"), "nan.csv"},
      {model_, metres, "are they in metres? State it with --units m"},
  };
  const std::string out = folder_.file("out.json");
  const std::vector<std::string> before = folder_.names();
  for (const Case& c : cases) {
    const Called called =
        orthonav({"register", "--model", c.model, "--points", c.points, "--json", out});
    EXPECT_EQ(called.code, 2) << c.expected;
    EXPECT_THAT(called.err, AllOf(StartsWith("orthonav: "), HasSubstr(c.expected)));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_THAT(folder_.names(), ElementsAreArray(before)) << "no output, whole or in part";
  }
}

TEST_P(RegisterCommand, NamesMetresTakenForMillimetres) {
  nav::TriangleMesh small = mesh_;
  for (Vec3& v : small.vertices_m) {
    v = v * 1e-3;  // written as mm: 0.09 mm across
  }
  const std::string model = folder_.file("small.stl");
  ASSERT_TRUE(engine::save_stl(model, small).ok());
  const Called called = orthonav({"register", "--model", model, "--points", points_file(1e3)});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("metres taken for millimetres"));
}

TEST_P(RegisterCommand, RefusesAnUnwritablePlaceAndUnknownWords) {
  const std::string points = points_file(1e3);
  const Called unwritable = orthonav({"register", "--model", model_, "--points", points, "--json",
                                      folder_.file("no/such/folder.json")});
  EXPECT_EQ(unwritable.code, 2);
  const Called nearest =
      orthonav({"register", "--model", model_, "--points", points, "--method", "nearest"});
  EXPECT_EQ(nearest.code, 2);
  EXPECT_THAT(nearest.err, HasSubstr("nearest: unknown (available: best, paper)"));
  EXPECT_EQ(orthonav({"register", "--model", model_}).code, 2);
  EXPECT_EQ(orthonav({"register", "--model", model_, "--points", points, "--units", "inch"}).code,
            2);
}

}  // namespace
}  // namespace orthonav::test::register_test
