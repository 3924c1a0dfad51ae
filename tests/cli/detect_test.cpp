#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/command_line.h"

namespace orthonav::test {
namespace {

using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Corners = std::array<std::array<double, 2>, 4>;

// The photographs' truth comes from another version of the library: most corners agree to a third
// of a pixel; a tag seen at 80° differs by 2.4 px along its long edge.
constexpr double kMedianPx = 0.5;
constexpr double kWorstPx = 3.0;

nlohmann::json detected(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"detect", "--json"});
  const Called called = orthonav(arguments);
  EXPECT_EQ(called.code, 0) << called.err;
  return nlohmann::json::parse(called.out);
}

std::vector<int> ids_of(const nlohmann::json& image) {
  std::vector<int> ids;
  for (const auto& marker : image["markers"]) ids.push_back(marker["id"]);
  std::sort(ids.begin(), ids.end());
  return ids;
}

// Lines `NAME  WIDTHxHEIGHT  …  ids=3 5h1 …`, where h1 stands for a corrected bit.
void expect_as_listed(const std::string& folder) {
  std::istringstream lines(content_of(folder + "/detections_36h11.tsv"));
  int images = 0;
  for (std::string line; std::getline(lines, line); ++images) {
    const std::string name = line.substr(0, line.find('\t'));
    std::istringstream listed(line.substr(line.find("ids=") + 4));
    std::vector<int> expected;
    for (std::string id; listed >> id;) expected.push_back(std::stoi(id));
    std::sort(expected.begin(), expected.end());
    const auto json = detected({folder + "/" + name});
    EXPECT_THAT(ids_of(json["images"][0]), ElementsAreArray(expected)) << name;
  }
  EXPECT_GT(images, 0);
}

// Best agreement over the corner a list may start at and over tags with the same id.
double nearest_px(const Corners& truth, const nlohmann::json& markers) {
  double best = 1e9;
  for (const auto& marker : markers)
    for (std::size_t start = 0; start < 4; ++start) {
      double worst = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& c = marker["corners_px"][(start + i) % 4];
        worst = std::max(
            worst, std::hypot(c[0].get<double>() - truth[i][0], c[1].get<double>() - truth[i][1]));
      }
      best = std::min(best, worst);
    }
  return best;
}

std::vector<Corners> truth_of(const std::string& file) {
  std::vector<Corners> all;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    for (char& c : line)
      if (c == '(' || c == ')' || c == ',') c = ' ';
    std::istringstream numbers(line);
    int id = 0;
    Corners corners;
    numbers >> id;
    for (auto& corner : corners) numbers >> corner[0] >> corner[1];
    all.push_back(corners);
  }
  return all;
}

TEST(DetectCommand, FindsEveryTagOfThePhotographs) {
  const std::string folder = shared("recordings/apriltag-testdata");
  if (folder.empty()) GTEST_SKIP() << "AprilTag's photographs are not here";
  expect_as_listed(folder);
}

TEST(DetectCommand, FindsEveryTagOfTheMeasuredSeries) {
  const std::string folder = shared("recordings/dt-apriltags");
  if (folder.empty()) GTEST_SKIP() << "the dt-apriltags images are not here";
  expect_as_listed(folder);
}

TEST(DetectCommand, PutsCornersWhereThePhotographsTruthHasThem) {
  const std::string folder = shared("recordings/apriltag-testdata");
  if (folder.empty()) GTEST_SKIP() << "AprilTag's photographs are not here";
  std::vector<double> errors;
  std::size_t unmatched = 0;
  for (const char* name :
       {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c", "34139872896_defdb2f8d9_c"}) {
    const auto json = detected({folder + "/" + name + ".jpg"});
    for (const Corners& truth : truth_of(folder + "/" + name + ".txt")) {
      const double error = nearest_px(truth, json["images"][0]["markers"]);
      if (error < 10.0)
        errors.push_back(error);
      else
        ++unmatched;
    }
  }
  EXPECT_LE(unmatched, 1u);  // one listed tag is not decoded with two corrected bits
  ASSERT_GE(errors.size(), 46u);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], kMedianPx);
  EXPECT_LT(errors.back(), kWorstPx);
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

TEST(DetectCommand, LooksForTheFamilyItIsGiven) {
  const std::string folder = shared("recordings/dt-apriltags");
  if (folder.empty()) GTEST_SKIP() << "the dt-apriltags images are not here";
  const std::string image = folder + "/test_image_multiple_02.png";
  EXPECT_THAT(ids_of(detected({image, "--family", "tag25h9"})["images"][0]), IsEmpty());
  const auto both = detected({image, "--family", "tag25h9", "--family", "tag36h11"});
  EXPECT_EQ(ids_of(both["images"][0]).size(), 5u);
  EXPECT_EQ(both["images"][0]["markers"][0]["family"], "tag36h11");
}

}  // namespace
}  // namespace orthonav::test
