#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/command_line.h"

namespace orthonav::test::rod_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Heads at the corners of a 30-50 mm path that turns by 53.13 degrees (3-4-5), out of order.
constexpr const char* kCorner = "x,y,z\n30,0,0\n0,0,0\n60,40,0\n";

TEST(RodCommand, GivesLengthAndBends) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", kCorner);
  const Called called = orthonav({"rod", "--heads", heads, "--diameter-mm", "6", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json rod = json::parse(called.out);
  EXPECT_EQ(rod["diameter_mm"].get<double>(), 6.0);
  EXPECT_EQ(rod["heads_mm"].size(), 3U);
  EXPECT_EQ(rod["heads_mm"][1], json({30.0, 0.0, 0.0}));
  ASSERT_EQ(rod["bends"].size(), 1U);
  EXPECT_NEAR(rod["bends"][0]["angle_deg"].get<double>(), 53.13010235415598, 1e-9);
  const double length_mm = rod["length_mm"].get<double>();
  EXPECT_GT(length_mm, 80.0);  // longer than its chords
  EXPECT_LT(length_mm, 86.0);
  // The sampled path's chords add up to slightly less than the length.
  double chords_mm = 0.0;
  for (std::size_t i = 1; i < rod["path_mm"].size(); ++i) {
    double squares = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      squares +=
          std::pow(rod["path_mm"][i][k].get<double>() - rod["path_mm"][i - 1][k].get<double>(), 2);
    }
    chords_mm += std::sqrt(squares);
  }
  EXPECT_NEAR(chords_mm, length_mm, 0.02);
  EXPECT_LE(chords_mm, length_mm);
}

TEST(RodCommand, SpeaksToPeopleByDefaultAndWritesTheFileBeside) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", "x,y,z\n0,0,0\n30,40,0\n");
  const std::string out = folder.file("rod.json");
  const Called called = orthonav({"rod", "--heads", heads, "--json", out});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("length 50.000 mm, diameter 5.5 mm, 0 bends"));
  EXPECT_NEAR(json::parse(content_of(out))["length_mm"].get<double>(), 50.0, 1e-6);
  const Called bent = orthonav({"rod", "--heads", folder.with("bent.csv", kCorner)});
  EXPECT_THAT(bent.out, HasSubstr(", 1 bend\n"));
}

TEST(RodCommand, TakesMetres) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", "x,y,z\n0,0,0\n0.03,0.04,0\n");
  const Called called = orthonav({"rod", "--heads", heads, "--units", "m"});
  EXPECT_THAT(called.out, HasSubstr("length 50.000 mm"));
  const Called wrong = orthonav({"rod", "--heads", heads});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("0.05 mm apart, limit 5-150 mm"));
}

/// Heads of a lordosis, 35 mm apart, set off sideways.
constexpr const char* kLordosis = "x,y,z\n0,0,0\n0.5,-5.5,35\n-1,-5.3,70\n0.4,0.4,105\n2,12,138\n";

TEST(RodCommand, InstructsHowToBendIt) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", kLordosis);
  const Called called =
      orthonav({"rod", "--heads", heads, "--instructions", "--to-bone", "0,-1,0", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json told = json::parse(called.out)["instructions"];
  EXPECT_GT(told["cut_length_mm"].get<double>(), 115.0);
  EXPECT_LE(told["worst_seat_mm"].get<double>(), 0.3);
  ASSERT_GE(told["bends"].size(), 2U);
  double before_mm = 0.0;
  for (const json& bend : told["bends"]) {
    EXPECT_GE(bend["arc_length_mm"].get<double>(), before_mm);
    before_mm = bend["arc_length_mm"].get<double>() + 20.0;
    EXPECT_GT(bend["set_deg"].get<double>(), bend["angle_deg"].get<double>());
  }
  const Called text = orthonav({"rod", "--heads", heads, "--instructions"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("cut to "),
                              HasSubstr("mark the middles of the end heads: 5.0 mm from the first "
                                        "end, 5.0 mm from the last\n"),
                              HasSubstr("bend 1: middle at ")));
}

TEST(RodCommand, SaysNoWhereNoInstructionsLeadThere) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", kCorner);
  const Called called = orthonav({"rod", "--heads", heads, "--instructions", "--json", "-"});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(json::parse(called.out)["no_instructions"].get<std::string>(), HasSubstr("limit"));
  const std::string out = folder.file("rod.pdf");
  EXPECT_EQ(orthonav({"print", "rod", "--heads", heads, "--out", out}).code, 1);
  EXPECT_THAT(folder.names(), ElementsAre("heads.csv"));
}

TEST(RodCommand, TakesTrialsOfTheSpringBack) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", kLordosis);
  const auto first_set_deg = [&](const std::string& trials) {
    const Called called = orthonav({"rod", "--heads", heads, "--instructions", "--json", "-",
                                    "--spring-back", folder.with("trials.csv", trials)});
    return called.code == 0
               ? json::parse(called.out)["instructions"]["bends"][0]["set_deg"].get<double>()
               : -1.0;
  };
  // Half of every bend is lost, then a tenth.
  const double half_deg = first_set_deg("set_deg,kept_deg\n60,30\n");
  const double tenth_deg = first_set_deg("# CoCr\nkept_deg,set_deg\n36,40\n");
  EXPECT_NEAR(half_deg * 0.5, tenth_deg * 0.9, 1e-6);
  for (const auto& [content, expected] : std::vector<std::pair<std::string, std::string>>{
           {"10,8\n", "line 1 must be the header"},
           {"set_deg,kept_deg\n", "holds no trials"},
           {"set_deg,kept_deg\n10,x\n", "line 2 must hold two numbers"},
           {"set_deg,kept_deg\n10,12\n", "trials.csv: spring-back trial 1 keeps 12.0"}}) {
    const Called called = orthonav({"rod", "--heads", heads, "--instructions", "--spring-back",
                                    folder.with("trials.csv", content)});
    EXPECT_EQ(called.code, 2) << content;
    EXPECT_THAT(called.err, HasSubstr(expected));
  }
}

TEST(RodCommand, PrintsItsInstructions) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", kLordosis);
  const std::string out = folder.file("rod.pdf");
  const Called called = orthonav({"print", "rod", "--heads", heads, "--out", out});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(content_of(out), StartsWith("%PDF"));
  EXPECT_THAT(called.out, HasSubstr("both rulers must be 100 mm"));
}

TEST(RodCommand, RefusesADirectionThatIsNone) {
  const ScratchFolder folder;
  const std::string heads = folder.with("heads.csv", kLordosis);
  for (const std::string to_bone : {"0,0,0", "0,1", "a,b,c", "0,nan,1"}) {
    const Called called =
        orthonav({"rod", "--heads", heads, "--instructions", "--to-bone", to_bone});
    EXPECT_EQ(called.code, 2) << to_bone;
    EXPECT_THAT(called.err, HasSubstr("--to-bone: \"" + to_bone + "\" must be three numbers"));
  }
}

TEST(RodCommand, RefusesBadInputInOneLine) {
  const ScratchFolder folder;
  struct Case {
    std::string content, diameter_mm, expected;
  };
  const std::vector<Case> cases = {
      {"x,y,z\n1,2,3\n", "5.5", "at least 2 screw heads, got 1"},
      {"", "5.5", "heads.csv"},
      {"x,y,z\n1,2,3\n1,2,3.5\n", "5.5", "heads 1 and 2 are 0.5 mm apart"},
      {"x,y,z\n0,0,0\n0,0,151\n", "5.5", "screw heads 1 and 2 are 151 mm apart, limit 5-150 mm"},
      {"x,y,z\n30,0,0\n0,0,0\n30,40,0\n", "5.5",
       "heads.csv: rod bends by 90.0° at screw head 1, limit 60°"},
      {"x,y,z\n0,0,0\n0,40,1\n0,0,30\n0,40,31\n0,0,60\n0,40,61\n0,0,90\n0,40,91\n", "5.5",
       "heads.csv: rod doubles back by "},
      {"x,y,z\n1,2,3\n1,2,inf\n", "5.5", "heads.csv"},
      {kCorner, "0", "--diameter-mm: \"0\" must be a number from 1 to 15"},
      {kCorner, "nan", "--diameter-mm: \"nan\""},
      {"x,y,z,region\n0,0,0,left\n0,0,30,left\n40,0,0,right\n", "5.5", "must be one rod"},
  };
  for (const Case& c : cases) {
    const std::string out = folder.file("rod.json");
    const Called called = orthonav({"rod", "--heads", folder.with("heads.csv", c.content),
                                    "--diameter-mm", c.diameter_mm, "--json", out});
    EXPECT_EQ(called.code, 2) << c.expected;
    EXPECT_THAT(called.err, AllOf(StartsWith("orthonav: "), HasSubstr(c.expected)));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(folder.names(), ElementsAre("heads.csv")) << "no output, whole or in part";
  }
  EXPECT_EQ(orthonav({"rod", "--heads", folder.file("none.csv")}).code, 2);
  EXPECT_EQ(orthonav({"rod"}).code, 2);
}

}  // namespace
}  // namespace orthonav::test::rod_test
