#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "tests/tools/command_line.h"

namespace orthonav::test::detect_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

using Corners = std::array<std::array<double, 2>, 4>;

// The photographs' truth is the library's quads without refinement; the tags are 20-40 px wide and
// the pictures compressed, so better corners differ from it by a third of a pixel. An offset of
// half a pixel, the mistake to be found, would give 0.7 px.
constexpr double kMeanPx = 0.35;
constexpr double kWorstPx = 1.5;
// As the library finds them, to the digits of the truth and of the decoded pictures.
constexpr double kSamePx = 0.02;

nlohmann::json detected(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"detect", "--json"});
  const Called called = orthonav(arguments);
  EXPECT_EQ(called.code, 0) << called.err;
  return nlohmann::json::parse(called.out);
}

std::vector<int> ids_of(const nlohmann::json& image) {
  std::vector<int> ids;
  for (const auto& marker : image["markers"]) {
    ids.push_back(marker["id"]);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

// Lines `NAME  WIDTHxHEIGHT  …  ids=3 5h1 …`, where h1 stands for a corrected bit.
// `more` tags may be found that are not listed.
void expect_as_listed(const std::string& folder, std::size_t more) {
  std::istringstream lines(content_of(folder + "/detections_36h11.tsv"));
  std::vector<std::string> files;
  std::vector<std::vector<int>> listed;
  for (std::string line; std::getline(lines, line);) {
    files.push_back(folder + "/" + line.substr(0, line.find('\t')));
    std::istringstream ids(line.substr(line.find("ids=") + 4));
    listed.emplace_back();
    for (std::string id; ids >> id;) {
      listed.back().push_back(std::stoi(id));
    }
    std::sort(listed.back().begin(), listed.back().end());
  }
  ASSERT_THAT(files, Not(IsEmpty()));
  const auto images = detected(files)["images"];
  ASSERT_EQ(images.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::vector<int>& expected = listed[i];
    const std::vector<int> found = ids_of(images[i]);
    std::vector<int> missing;
    std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(),
                        std::back_inserter(missing));
    EXPECT_EQ(images[i]["image"], files[i]);
    EXPECT_THAT(missing, IsEmpty()) << files[i];
    EXPECT_THAT(found, SizeIs(Le(expected.size() + more))) << files[i];
  }
}

// Distances of the corners, for the best match over the possible first corners and over tags with
// the same id.
std::array<double, 4> nearest_px(const Corners& truth, const nlohmann::json& markers) {
  std::array<double, 4> best;
  best.fill(1e9);
  for (const auto& marker : markers) {
    for (std::size_t start = 0; start < 4; ++start) {
      std::array<double, 4> errors;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& c = marker["corners_px"][(start + i) % 4];
        errors[i] = std::hypot(c[0].get<double>() - truth[i][0], c[1].get<double>() - truth[i][1]);
      }
      const auto sum = [](const auto& a) { return std::accumulate(a.begin(), a.end(), 0.0); };
      if (sum(errors) < sum(best)) {
        best = errors;
      }
    }
  }
  return best;
}

std::vector<Corners> truth_of(const std::string& file) {
  std::vector<Corners> all;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    for (char& c : line) {
      if (c == '(' || c == ')' || c == ',') {
        c = ' ';
      }
    }
    std::istringstream numbers(line);
    int id = 0;
    Corners corners;
    numbers >> id;
    for (auto& corner : corners) {
      numbers >> corner[0] >> corner[1];
    }
    all.push_back(corners);
  }
  return all;
}

TEST(DetectCommand, FindsEveryTagOfThePhotographs) {
  const std::string folder = shared("recordings/apriltag-testdata");
  if (folder.empty()) {
    GTEST_SKIP() << "needs shared/recordings/apriltag-testdata";
  }
  // The truth has one more tag than the list, and it is found.
  expect_as_listed(folder, 1);
}

/// Tags found in all images of a folder of shared/real, by these options; none of an id that its
/// board does not have.
std::size_t tags_on(const std::string& folder, int ids, std::vector<std::string> options) {
  std::vector<std::string> arguments;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() == ".png" || file.path().extension() == ".jpg") {
      arguments.push_back(file.path());
    }
  }
  arguments.insert(arguments.end(), options.begin(), options.end());
  std::size_t tags = 0;
  const nlohmann::json json = detected(arguments);
  for (const auto& image : json["images"]) {
    for (const int id : ids_of(image)) {
      EXPECT_LT(id, ids) << image["image"];
    }
    tags += image["markers"].size();
  }
  return tags;
}

TEST(DetectCommand, FindsTheTagsOfBoardsWithBlackSquares) {
  const std::string moms = shared("real/moms-apriltag-stereo");
  const std::string lin = shared("real/powei-lin-aprilgrid-rs");
  if (moms.empty() || lin.empty()) {
    GTEST_SKIP() << "needs shared/real/moms-apriltag-stereo and powei-lin-aprilgrid-rs";
  }
  // Of 920, those outside the images included.
  EXPECT_GE(tags_on(moms, 20, {"--family", "tag36h10"}), 885u);
  EXPECT_EQ(tags_on(lin, 36, {"--family", "tag36h11b2"}), 5u * 36u);
}

TEST(DetectCommand, RefinesTagsThatBlackSquaresTouch) {
  const std::string folder = shared("real/powei-lin-aprilgrid-rs");
  if (folder.empty()) {
    GTEST_SKIP() << "needs shared/real/powei-lin-aprilgrid-rs";
  }
  const auto corners = [&](const char* refinement) {
    const auto json =
        detected({folder + "/EuRoC.png", "--family", "tag36h11b2", "--refine", refinement});
    std::map<int, std::vector<std::array<double, 2>>> all;
    for (const auto& marker : json["images"][0]["markers"]) {
      all[marker["id"]] = marker["corners_px"];
    }
    return all;
  };
  const auto none = corners("none");
  const auto edges = corners("edges");
  ASSERT_EQ(none.size(), edges.size());
  double moved_px = 0.0;
  for (const auto& [id, refined] : edges) {
    for (std::size_t i = 0; i < 4; ++i) {
      moved_px += std::hypot(refined[i][0] - none.at(id)[i][0], refined[i][1] - none.at(id)[i][1]) /
                  static_cast<double>(4 * edges.size());
    }
  }
  EXPECT_GT(moved_px, 0.1);
}

TEST(DetectCommand, FindsEveryTagOfTheMeasuredSeries) {
  const std::string folder = shared("recordings/dt-apriltags");
  if (folder.empty()) {
    GTEST_SKIP() << "needs shared/recordings/dt-apriltags";
  }
  expect_as_listed(folder, 0);
}

struct PhotographErrors {
  std::vector<double> corners_px;
  std::size_t unmatched_tags = 0;
  double mean_px = 0.0;
};

PhotographErrors photograph_errors(const std::string& folder, const std::string& refinement) {
  PhotographErrors errors;
  const std::array<std::string, 3> names = {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c",
                                            "34139872896_defdb2f8d9_c"};
  std::vector<std::string> arguments = {"--refine", refinement};
  for (const std::string& name : names) {
    arguments.push_back(folder + "/" + name + ".jpg");
  }
  const auto json = detected(arguments);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const Corners& truth : truth_of(folder + "/" + names[i] + ".txt")) {
      const auto nearest = nearest_px(truth, json["images"][i]["markers"]);
      if (*std::max_element(nearest.begin(), nearest.end()) < 10.0) {
        errors.corners_px.insert(errors.corners_px.end(), nearest.begin(), nearest.end());
      } else {
        ++errors.unmatched_tags;
      }
    }
  }
  for (const double error : errors.corners_px) {
    errors.mean_px += error / static_cast<double>(errors.corners_px.size());
  }
  return errors;
}

TEST(DetectCommand, PutsCornersWhereThePhotographsTruthHasThem) {
  const std::string folder = shared("recordings/apriltag-testdata");
  if (folder.empty()) {
    GTEST_SKIP() << "needs shared/recordings/apriltag-testdata";
  }
  const PhotographErrors errors = photograph_errors(folder, "edges");
  EXPECT_EQ(errors.unmatched_tags, 0u);
  ASSERT_EQ(errors.corners_px.size(), 4 * 47u);
  EXPECT_LT(errors.mean_px, kMeanPx);
  EXPECT_LT(*std::max_element(errors.corners_px.begin(), errors.corners_px.end()), kWorstPx);
}

TEST(DetectCommand, GivesTheLibrarysOwnCornersWhenAsked) {
  const std::string folder = shared("recordings/apriltag-testdata");
  if (folder.empty()) {
    GTEST_SKIP() << "needs shared/recordings/apriltag-testdata";
  }
  const PhotographErrors as_truth = photograph_errors(folder, "none");
  EXPECT_LT(as_truth.mean_px, kSamePx);
  EXPECT_GT(photograph_errors(folder, "library").mean_px, kMeanPx) << "the bound can be failed";
}

TEST(DetectCommand, SaysWhichPixelsItMeans) {
  EXPECT_THAT(orthonav({"detect", "--help"}).out, HasSubstr("(0.5, 0.5)"));
  const ScratchFolder folder;
  const std::string blank = folder.with("blank.pgm", "P5\n40 30\n255\n" + std::string(1200, 'x'));
  const Called called = orthonav({"detect", blank});
  EXPECT_EQ(called.code, 0);
  EXPECT_THAT(called.out, HasSubstr("(0.5, 0.5)"));
  EXPECT_THAT(called.out, HasSubstr("blank.pgm: 0 markers"));
  const auto json = detected({blank});
  EXPECT_THAT(json["corner_coordinates"].get<std::string>(), HasSubstr("(0.5, 0.5)"));
  EXPECT_EQ(json["images"][0]["width_px"], 40);
  EXPECT_EQ(json["images"][0]["height_px"], 30);
  EXPECT_TRUE(json["images"][0]["markers"].is_array());
}

TEST(DetectCommand, RefusesBadInputInOneLine) {
  const ScratchFolder folder;
  const std::string good = folder.with("good.pgm", "P5 40 30 255\n" + std::string(1200, 'x'));
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"detect", good, "--family", "tag99h1"}, "unknown tag family 'tag99h1', known are tag36h11"},
      {{"detect", good, "--max-hamming", "3"},
       "--max-hamming: \"3\" must be a whole number from 0 to 2"},
      {{"detect", good, "--decimate", "0.3"}, "decimate"},
      {{"detect", good, folder.file("none.png")}, "none.png"},
      {{"detect", good, folder.with("cut.pgm", "P5 40 30 255\nxyz")}, "cut.pgm: PGM is cut short"},
      {{"detect", good, folder.with("text.png", "hello")}, "text.png: not a PNG, JPEG"}};
  for (const auto& [arguments, what] : cases) {
    const Called called = orthonav(arguments);
    EXPECT_EQ(called.code, 2) << what;
    EXPECT_THAT(called.err, HasSubstr(what));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty()) << "half an answer";
  }
  EXPECT_EQ(orthonav({"detect"}).code, 2);
}

TEST(DetectCommand, TakesAnImageBehindAFamily) {
  const ScratchFolder folder;
  const std::string image = folder.with("grey.pgm", "P5 40 30 255\n" + std::string(1200, 'x'));
  const auto seen = detected({"--family", "tag25h9", image, image});
  EXPECT_THAT(seen["images"], SizeIs(2));
}

TEST(DetectCommand, LooksForTheFamilyItIsGiven) {
  const std::string folder = shared("recordings/dt-apriltags");
  if (folder.empty()) {
    GTEST_SKIP() << "needs shared/recordings/dt-apriltags";
  }
  const std::string image = folder + "/test_image_multiple_02.png";
  EXPECT_THAT(ids_of(detected({image, "--family", "tag25h9"})["images"][0]), IsEmpty());
  const auto both = detected({"--family", "tag25h9", "--family", "tag36h11", image});
  EXPECT_EQ(ids_of(both["images"][0]).size(), 5u);
  EXPECT_EQ(both["images"][0]["markers"][0]["family"], "tag36h11");
}

}  // namespace
}  // namespace orthonav::test::detect_test
