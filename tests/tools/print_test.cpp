#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/command_line.h"

namespace orthonav::test::print_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Scale of the page rendered by a PDF renderer independent of the library that wrote it.
constexpr double kPxPerMm = 10.0;
constexpr double kToleranceMm = 0.1;

/// The page as an image file; empty if the renderer is not installed.
std::string rendered(const std::string& pdf, const std::string& to) {
  const std::string command =
      "pdftoppm -r 254 -gray -singlefile '" + pdf + "' '" + to + "' 2>/dev/null";
  return std::system(command.c_str()) == 0 ? to + ".pgm" : "";
}

struct Seen {
  double left_mm, top_mm, size_mm;
};

std::map<int, Seen> seen_in(const std::string& image) {
  const Called called = orthonav({"detect", image, "--json"});
  EXPECT_EQ(called.code, 0) << called.err;
  std::map<int, Seen> seen;
  const json all = json::parse(called.out);
  for (const json& marker : all["images"][0]["markers"]) {
    const json& corners = marker["corners_px"];
    const double left = corners[3][0].get<double>() / kPxPerMm;
    const double top = corners[3][1].get<double>() / kPxPerMm;
    // From the diagonal, so that a rectangle would not pass for a square of its width.
    const double dx = corners[1][0].get<double>() / kPxPerMm - left;
    const double dy = corners[1][1].get<double>() / kPxPerMm - top;
    EXPECT_NEAR(dx, dy, kToleranceMm);
    seen[marker["id"].get<int>()] = {left, top, (dx + dy) / 2};
  }
  return seen;
}

TEST(PrintCommand, PrintsTagsAtTheirSizes) {
  const ScratchFolder folder;
  const std::string pdf = folder.file("tags.pdf");
  const Called called =
      orthonav({"print", "tags", "--ids", "0-4,17", "--size-mm", "37.5", "--out", pdf});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("6 tags on 1 page (A4); print at 100 %"));
  EXPECT_THAT(folder.names(), ElementsAre("tags.pdf"));
  const std::string image = rendered(pdf, folder.file("page"));
  if (image.empty()) {
    GTEST_SKIP() << "needs pdftoppm (poppler-utils)";
  }
  const auto seen = seen_in(image);
  ASSERT_EQ(seen.size(), 6u);
  for (const int id : {0, 1, 2, 3, 4, 17}) {
    ASSERT_TRUE(seen.contains(id)) << id;
    EXPECT_NEAR(seen.at(id).size_mm, 37.5, kToleranceMm) << id;
  }
}

TEST(PrintCommand, PrintsTheSameBytesAgain) {
  const ScratchFolder folder;
  for (const std::string name : {"a.pdf", "b.pdf"}) {
    ASSERT_EQ(orthonav({"print", "tags", "--ids", "3", "--out", folder.file(name)}).code, 0);
  }
  EXPECT_EQ(content_of(folder.file("a.pdf")), content_of(folder.file("b.pdf")));
}

TEST(PrintCommand, PrintsTheTagsOfATool) {
  const ScratchFolder folder;
  const std::string tools = folder.with("tools.json", R"({"tools": [
    {"name": "pointer", "role": "pointer", "tip_mm": [0, -130, 0],
     "marker": {"family": "tag36h11", "id": 3, "size_mm": 50},
     "markers": [{"family": "tag36h11", "id": 4, "size_mm": 30,
                  "pose": [[0,0,1,20], [0,1,0,0], [-1,0,0,-20], [0,0,0,1]]}]},
    {"name": "guide", "role": "guide", "tip_mm": [0, -130, 0],
     "marker": {"family": "tag36h11", "id": 5, "size_mm": 60}}]})");
  const std::string pdf = folder.file("tool.pdf");
  const Called called = orthonav({"print", "tool", tools, "--name", "pointer", "--out", pdf});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("2 tags on 1 page"));
  const std::string image = rendered(pdf, folder.file("page"));
  if (image.empty()) {
    GTEST_SKIP() << "needs pdftoppm (poppler-utils)";
  }
  const auto seen = seen_in(image);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_NEAR(seen.at(3).size_mm, 50, kToleranceMm);
  EXPECT_NEAR(seen.at(4).size_mm, 30, kToleranceMm);
}

TEST(PrintCommand, PrintsABoardAndItsDescription) {
  const ScratchFolder folder;
  const std::string pdf = folder.file("board.pdf");
  const Called called =
      orthonav({"print", "board", "--kind", "tags", "--columns", "4", "--rows", "3", "--size-mm",
                "25", "--gap-mm", "8", "--first-id", "20", "--page", "Letter", "--out", pdf});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("124 x 91 mm on Letter"));
  EXPECT_THAT(folder.names(), ElementsAre("board.json", "board.pdf"));
  const json board = json::parse(content_of(folder.file("board.json")));
  EXPECT_EQ(board["kind"], "tags");
  EXPECT_EQ(board["size_mm"], 25.0);
  EXPECT_EQ(board["gap_mm"], 8.0);
  EXPECT_EQ(board["border_cells"], 1);
  const std::string image = rendered(pdf, folder.file("page"));
  if (image.empty()) {
    GTEST_SKIP() << "needs pdftoppm (poppler-utils)";
  }
  const auto seen = seen_in(image);
  ASSERT_EQ(seen.size(), 12u);
  const Seen first = seen.at(board["ids"][0][0].get<int>());
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      const int id = board["ids"][row][column].get<int>();
      EXPECT_EQ(id, 20 + static_cast<int>(4 * row + column));
      EXPECT_NEAR(seen.at(id).size_mm, 25, kToleranceMm);
      EXPECT_NEAR(seen.at(id).left_mm - first.left_mm, 33.0 * static_cast<double>(column),
                  kToleranceMm);
      EXPECT_NEAR(seen.at(id).top_mm - first.top_mm, 33.0 * static_cast<double>(row), kToleranceMm);
    }
  }
}

TEST(PrintCommand, PutsTheDescriptionWhereItIsTold) {
  const ScratchFolder folder;
  const Called called = orthonav({"print", "board", "--kind", "chessboard", "--out",
                                  folder.file("a.pdf"), "--json", folder.file("b.json")});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(folder.names(), ElementsAre("a.pdf", "b.json"));
  EXPECT_THAT(called.out, HasSubstr(": chessboard, 7 x 10, 140 x 200 mm on A4; print at 100 %"));
  const json board = json::parse(content_of(folder.file("b.json")));
  EXPECT_EQ(board["kind"], "chessboard");
  EXPECT_FALSE(board.contains("ids"));
}

TEST(PrintCommand, RefusesInOneLineAndLeavesNothing) {
  const ScratchFolder folder;
  const std::string out = folder.file("out.pdf");
  const std::string tools = ORTHONAV_SOURCE_DIR "/data/tools.json";
  struct Case {
    std::vector<std::string> arguments;
    std::string expected;
  };
  const std::vector<Case> cases = {
      {{"tags", "--ids", "0", "--size-mm", "190"}, "page A4 has room for 182 mm"},
      {{"tags", "--ids", "0", "--size-mm", "201"}, "\"201\" must be a number from 5 to 200"},
      {{"tags", "--ids", "0,0"}, "holds 0 twice"},
      {{"tags", "--ids", "5-3"}, "must be a whole number or a range"},
      {{"tags", "--ids", "0-999999999"}, "more than 1000 numbers"},
      {{"tags", "--ids", "-1"}, "--ids"},
      {{"tags", "--ids", ""}, "--ids"},
      {{"tags", "--ids", "587"}, "tag id 587 of tag36h11, must be 0-586"},
      {{"tags", "--ids", "1", "--family", "x"}, "unknown tag family 'x'"},
      {{"tags", "--ids", "1", "--page", "A5"}, "unknown page \"A5\", known are A4, Letter, A3"},
      {{"tags", "--ids", "1", "--quiet-cells", "0.5"}, "must be a number from 1 to 4"},
      {{"tool", folder.file("none.json")}, "cannot be opened"},
      {{"tool", tools, "--name", "saw"}, "no tool \"saw\", there are pointer, guide, reference"},
      {{"board", "--size-mm", "40"}, "324 mm wide with its surround, page A4 has room for 182 mm"},
      {{"board", "--gap-mm", "1"}, "gap 1 mm, must be 2 mm (a cell of white)"},
      {{"board", "--first-id", "560"}, "tag id 590, must be 0-586"},
      {{"board", "--family", "tagStandard41h12"}, "no black border"},
      {{"board", "--kind", "chessboard", "--gap-mm", "3"}, "a chessboard has no gaps"},
      {{"board", "--kind", "hexagons"}, "hexagons"},
      {{"board", "--json", out}, "is both the PDF and the board's description"},
      {{"board", "--json", folder.file("no/board.json")}, "does not exist"},
      {{}, "a command is required"},
  };
  for (const Case& c : cases) {
    std::vector<std::string> arguments = {"print"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    if (!c.arguments.empty()) {
      arguments.insert(arguments.end(), {"--out", out});
    }
    const Called called = orthonav(arguments);
    EXPECT_EQ(called.code, 2) << c.expected;
    EXPECT_THAT(called.err, AllOf(StartsWith("orthonav: "), HasSubstr(c.expected)));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(folder.names(), IsEmpty()) << c.expected;
  }
  const Called unwritable = orthonav({"print", "board", "--out", folder.file("no/board.pdf")});
  EXPECT_EQ(unwritable.code, 2);
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace orthonav::test::print_test
