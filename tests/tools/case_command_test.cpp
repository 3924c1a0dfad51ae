#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/command_line.h"

namespace orthonav::test::case_command_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A ball of 20 mm radius as a label map with this number, 2 mm voxels, text NRRD.
std::string ball(const ScratchFolder& scratch, const std::string& name, int number,
                 const std::string& fields = "") {
  constexpr int kSize = 30;
  std::string text =
      "NRRD0005\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 30 30 30\n"
      "space directions: (2,0,0) (0,2,0) (0,0,2)\nkinds: domain domain domain\nencoding: text\n"
      "space origin: (0,0,0)\n" +
      fields + "\n";
  for (int k = 0; k < kSize; ++k) {
    for (int j = 0; j < kSize; ++j) {
      for (int i = 0; i < kSize; ++i) {
        const int r2 = (i - 15) * (i - 15) + (j - 15) * (j - 15) + (k - 15) * (k - 15);
        text += r2 <= 100 ? std::to_string(number) + " " : "0 ";
      }
    }
  }
  return scratch.with(name, text + "\n");
}

TEST(CaseCommand, MakesACaseOfALabelMapWithAConvention) {
  const ScratchFolder scratch;
  const std::string labels = ball(scratch, "labels.nrrd", 23);
  const std::string out = scratch.file("case");
  const Called made = orthonav(
      {"case", "make", "--labels", labels, "--convention", "verse", "--out", out, "--json"});
  ASSERT_EQ(made.code, 0) << made.err;
  const json figures = json::parse(made.out);
  ASSERT_EQ(figures["levels"].size(), 1u);
  EXPECT_EQ(figures["levels"][0]["label"], "L4");
  EXPECT_LE(figures["levels"][0]["deviation_p95_mm"].get<double>(), 1.0) << "half a voxel";
  EXPECT_TRUE(std::filesystem::exists(out + "/L4.stl"));
  EXPECT_THAT(made.err, HasSubstr("warning: L4: no vertebral canal found")) << "it is a ball";
  // It has no plan, and a ball gets none.
  EXPECT_THAT(orthonav({"plan", "check", "--case", out}).err, HasSubstr("no level has screws"));
  const Called planned = orthonav({"plan", "auto", "--case", out});
  EXPECT_EQ(planned.code, 1);
  EXPECT_THAT(planned.err, HasSubstr("L4 left: no screw: no vertebral canal found"));
  const Called again =
      orthonav({"case", "make", "--labels", labels, "--convention", "verse", "--out", out});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("case.json: already exists"));
}

TEST(CaseCommand, MakesACaseOfASegmentationByItsNames) {
  const ScratchFolder scratch;
  const std::string labels =
      ball(scratch, "a.seg.nrrd", 1, "Segment0_Name:=L2 vertebra\nSegment0_LabelValue:=1\n");
  const Called made = orthonav({"case", "make", "--labels", labels, "--out", scratch.file("case")});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("L2: "), HasSubstr("mm (95 %)")));
}

TEST(CaseCommand, RefusesInOneLineAndLeavesNothing) {
  const ScratchFolder scratch;
  const std::string labels = ball(scratch, "labels.nrrd", 23);
  const std::string out = scratch.file("case");
  const auto refusal = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"case", "make", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Called called = orthonav(arguments);
    EXPECT_EQ(called.code, 2);
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_FALSE(std::filesystem::exists(out));
    return called.err;
  };
  EXPECT_THAT(refusal({"--labels", labels}),
              HasSubstr("state one with --convention: verse, totalsegmentator, "
                        "totalsegmentator-v1"));
  EXPECT_THAT(refusal({"--labels", labels, "--convention", "totalsegmentator"}),
              HasSubstr("holds no vertebra of the convention totalsegmentator"));
  EXPECT_THAT(refusal({"--labels", labels, "--convention", "verse", "--levels", "L5"}),
              HasSubstr("holds no L5 (it has: L4)"));
  EXPECT_THAT(refusal({"--volume", labels}), HasSubstr("vertebrae need --labels"));
  EXPECT_THAT(refusal({"--threshold", "200"}), HasSubstr("--threshold needs --volume"));
  EXPECT_THAT(refusal({"--labels", labels, "--mesh", "L4=a.stl"}), HasSubstr("vertebrae need "));
  EXPECT_THAT(refusal({"--mesh", "a.stl"}), HasSubstr("a.stl: must be LEVEL=FILE"));
  EXPECT_THAT(refusal({"--mesh", "L4=none.stl"}), HasSubstr("none.stl: cannot be opened"));
  EXPECT_THAT(refusal({"--labels", scratch.file("none.nii")}), HasSubstr("no such file"));
  // The labels as their own scan: 23 HU are no bone.
  EXPECT_THAT(refusal({"--labels", labels, "--convention", "verse", "--volume", labels}),
              HasSubstr("has 23 HU on average where the labels are"));
}

TEST(CaseCommand, MakesACaseOfMeshesWhoseAxesAreStated) {
  const ScratchFolder scratch;
  const std::string labels = ball(scratch, "labels.nrrd", 23);
  const std::string first = scratch.file("first");
  ASSERT_EQ(
      orthonav({"case", "make", "--labels", labels, "--convention", "verse", "--out", first}).code,
      0);
  // What orthonav writes declares its axes.
  const std::string mesh = "L4=" + first + "/L4.stl";
  const Called made =
      orthonav({"case", "make", "--mesh", mesh, "--out", scratch.file("second"), "--json"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NEAR(json::parse(made.out)["levels"][0]["volume_cm3"].get<double>(), 33.5, 1.5);
  EXPECT_THAT(made.err, HasSubstr("warning: L4: no vertebral canal found")) << "it is a ball";
  // The same without that.
  std::string bytes = content_of(first + "/L4.stl");
  bytes.replace(bytes.find("SPACE=LPS"), 9, "SOMETHING");
  const std::string silent = scratch.with("l4.stl", bytes);
  const Called refused =
      orthonav({"case", "make", "--mesh", "L4=" + silent, "--out", scratch.file("third")});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("l4.stl: does not say its axes; state them with --frame"));
  EXPECT_EQ(orthonav({"case", "make", "--mesh", "L4=" + silent, "--frame", "LPS", "--out",
                      scratch.file("third")})
                .code,
            0);
}

TEST(CaseCommand, RefusesPlacesThatCannotBeWrittenBeforeItWritesAnything) {
  const ScratchFolder scratch;
  const std::string labels = ball(scratch, "labels.nrrd", 23);
  const auto refusal = [&](const std::string& out, const std::string& json_file) {
    const Called called = orthonav({"case", "make", "--labels", labels, "--convention", "verse",
                                    "--out", out, "--json", json_file});
    EXPECT_EQ(called.code, 2);
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    return called.err;
  };
  EXPECT_THAT(refusal(scratch.file("case"), scratch.file("none/figures.json")),
              HasSubstr("none/figures.json"));
  EXPECT_FALSE(std::filesystem::exists(scratch.file("case")));
  EXPECT_THAT(refusal(scratch.file(std::string(300, 'a')), scratch.file("figures.json")),
              HasSubstr("too long"));
}

TEST(CaseCommand, NamesACaseAfterItsFolder) {
  const ScratchFolder scratch;
  const std::string labels = ball(scratch, "labels.nrrd", 23);
  for (const std::string out : {"plain", "slash/", "dots/."}) {
    const Called made = orthonav(
        {"case", "make", "--labels", labels, "--convention", "verse", "--out", scratch.file(out)});
    ASSERT_EQ(made.code, 0) << made.err;
    const json made_case = json::parse(content_of(scratch.file(out) + "/case.json"));
    EXPECT_EQ(made_case["name"], out == "plain" ? "plain" : out == "slash/" ? "slash" : "dots");
  }
}

TEST(CaseCommand, TakesConnectedBoneOfAScanWithAWordAboutNeighbours) {
  const ScratchFolder scratch;
  const std::string scan = ball(scratch, "ct.nrrd", 400);
  const Called made = orthonav(
      {"case", "make", "--volume", scan, "--threshold", "200", "--out", scratch.file("case")});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("part1: "));
  EXPECT_THAT(made.err, HasSubstr("adjoining vertebrae are connected into one part"));
}

}  // namespace
}  // namespace orthonav::test::case_command_test
