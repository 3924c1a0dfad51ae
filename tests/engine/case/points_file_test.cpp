#include "engine/case/points_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "tests/support/temporary_folder.h"

namespace orthonav::engine::points_file_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Result<PointsFile> loaded(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return load_points(folder.with(name, text));
}

std::string refusal(const std::string& name, const std::string& text) {
  const auto points = loaded(name, text);
  EXPECT_FALSE(points.ok());
  const std::string message = points.ok() ? "" : points.error().message;
  EXPECT_THAT(message, HasSubstr(name + ": "));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

TEST(PointsFile, ReadsColumnsByTheirNames) {
  const auto file =
      loaded("p.csv", "region,z,y,x,quality\r\nlamina,3,2,1,7\r\nfacet,-6,-5,-4,8\r\n");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->points, ElementsAre(Vec3{1, 2, 3}, Vec3{-4, -5, -6}));
  EXPECT_THAT(file->regions, ElementsAre("lamina", "facet"));
  EXPECT_FALSE(file->axes.has_value());
  EXPECT_FALSE(file->metres_per_unit.has_value());
}

TEST(PointsFile, ReadsNumbersWithoutAHeader) {
  const auto file = loaded("p.csv",
                           "\xEF\xBB\xBF"
                           "1.5, +2e1 ,3\n\n# a remark\n4,5,6\n");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->points, ElementsAre(Vec3{1.5, 20, 3}, Vec3{4, 5, 6}));
  EXPECT_TRUE(file->regions.empty());
}

TEST(PointsFile, NamesTheLineThatIsNoPoint) {
  EXPECT_THAT(refusal("p.csv", "x,y,z\n1,2,3\n4,five,6\n"), HasSubstr("line 3: field \"five\""));
  EXPECT_THAT(refusal("p.csv", "x,y,z\n1,2\n"), HasSubstr("line 2: has 2 fields"));
  EXPECT_THAT(refusal("p.csv", "x,y,z\n1,2,nan\n"), HasSubstr("line 2: field \"nan\""));
  EXPECT_THAT(refusal("p.csv", "x,y,z\n1,2,inf\n"), HasSubstr("line 2: field \"inf\""));
  EXPECT_THAT(refusal("p.csv", "x,y\n1,2\n"), HasSubstr("no column z"));
  EXPECT_THAT(refusal("p.csv", "x,y,z,x\n1,2,3,4\n"), HasSubstr("column x stands twice"));
  EXPECT_THAT(refusal("p.csv", "1:2:3\n"), HasSubstr("line 1"));
}

TEST(PointsFile, ReadsTablesAsSpreadsheetsWriteThem) {
  const std::string utf16 = [] {
    std::string out = "\xFF\xFE";
    for (const char c : std::string("x\ty\tz\tregion\r\n1,5\t-2\t3\tfacet\r\n")) {
      out += c;
      out += '\0';
    }
    return out;
  }();
  for (const std::string& text :
       {std::string("x;y;z;region\n1,5;-2;3;facet\n"),
        std::string("\xEF\xBB\xBFx;y;z;region\r\n1.5;-2;3;facet\r\n"),
        std::string("\"x\",\"y\",\"z\",\"region\"\n\"1.5\",\"-2\",\"3\",\"facet\"\n"), utf16}) {
    const auto file = loaded("p.csv", text);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_THAT(file->points, ElementsAre(Vec3{1.5, -2, 3}));
    EXPECT_THAT(file->regions, ElementsAre("facet"));
  }
  EXPECT_THAT(loaded("p.csv", "1,5;2;3\n")->points, ElementsAre(Vec3{1.5, 2, 3}));
  EXPECT_THAT(refusal("p.csv", "x,y,z\n1,5,2,5,3,5\n"), HasSubstr("Separate them with ;"));
  EXPECT_THAT(refusal("p.csv", "1,5,2,5,3,5\n"), HasSubstr("Separate them with ;"));
  EXPECT_THAT(refusal("p.csv", "x;y;z\n1.234,5;2;3\n"), HasSubstr("is not a number"));
}

TEST(PointsFile, ReadsSlicersTableInItsAxes) {
  const auto ras = loaded("p.csv",
                          "label,r,a,s,defined,selected,visible,locked,description\n"
                          "F-1,1.5,2,3,1,1,1,0,\"a, b\"\nF-2,0,0,0,0,1,1,0,\n");
  ASSERT_TRUE(ras.ok()) << ras.error().message;
  EXPECT_THAT(ras->points, ElementsAre(Vec3{1.5, 2, 3}));
  EXPECT_EQ(ras->axes, Axes::kRas);
  EXPECT_EQ(ras->metres_per_unit, 1e-3);
  const auto lps = loaded("p.csv", "label,l,p,s,defined\nF-1,1.5,2,3,1\n");
  ASSERT_TRUE(lps.ok()) << lps.error().message;
  EXPECT_EQ(lps->axes, Axes::kLps);
}

TEST(PointsFile, LeavesUnplacedPointsOut) {
  const auto file = loaded("p.fcsv",
                           "# CoordinateSystem = LPS\n"
                           "1,1,2,3,0,0,0,1,1,1,0,F-1,\"a, b\",node,2,0\n"
                           "2,0,0,0,0,0,0,1,1,1,0,F-2,,node,0,0\n"
                           "3,0,0,0,0,0,0,1,1,1,0,F-3,,node,3,0\n");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->points, ElementsAre(Vec3{1, 2, 3}));
}

TEST(PointsFile, RefusesFilesWithoutPoints) {
  EXPECT_THAT(refusal("p.csv", ""), HasSubstr("holds no points"));
  EXPECT_THAT(refusal("p.csv", "x,y,z\n"), HasSubstr("holds no points"));
  EXPECT_THAT(load_points("/nowhere/p.csv").error().message, HasSubstr("cannot be opened"));
}

const std::string kPlyHead =
    "ply\nformat FORMAT 1.0\ncomment c\nelement vertex 2\n"
    "property uchar red\nproperty float x\nproperty double y\n"
    "property float z\nelement face 0\n"
    "property list uchar int vertex_indices\nend_header\n";

std::string ply_head(const std::string& format) {
  std::string head = kPlyHead;
  return head.replace(head.find("FORMAT"), 6, format);
}

template <class Bits, class Value>
std::string bytes_of(Value value, bool big) {
  const auto bits = std::bit_cast<Bits>(value);
  std::string bytes;
  for (std::size_t i = 0; i < sizeof bits; ++i) {
    const std::size_t shift = 8 * (big ? sizeof bits - 1 - i : i);
    bytes += static_cast<char>(bits >> shift & 0xff);
  }
  return bytes;
}

std::string ply_vertex(float x, double y, float z, bool big) {
  return "\x7f" + bytes_of<std::uint32_t>(x, big) + bytes_of<std::uint64_t>(y, big) +
         bytes_of<std::uint32_t>(z, big);
}

TEST(PointsFile, ReadsPlyInEveryEncoding) {
  const auto ascii = loaded("p.ply", ply_head("ascii") + "9 1 2 3\n9 -4 -5 -6\n");
  ASSERT_TRUE(ascii.ok()) << ascii.error().message;
  EXPECT_THAT(ascii->points, ElementsAre(Vec3{1, 2, 3}, Vec3{-4, -5, -6}));
  for (const bool big : {false, true}) {
    const auto file = loaded("p.ply", ply_head(big ? "binary_big_endian" : "binary_little_endian") +
                                          ply_vertex(1, 2, 3, big) + ply_vertex(-4, -5, -6, big));
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_THAT(file->points, ElementsAre(Vec3{1, 2, 3}, Vec3{-4, -5, -6}));
  }
}

TEST(PointsFile, RefusesBrokenPly) {
  const std::string head = ply_head("binary_little_endian");
  const std::string nan = ply_vertex(1, 2, std::numeric_limits<float>::quiet_NaN(), false);
  EXPECT_THAT(refusal("p.ply", head + ply_vertex(1, 2, 3, false) + "ab"),
              HasSubstr("ends after 1 of 2 vertices"));
  EXPECT_THAT(refusal("p.ply", head + ply_vertex(1, 2, 3, false) + nan),
              HasSubstr("vertex 1 is not finite"));
  EXPECT_THAT(refusal("p.ply", ply_head("ascii") + "9 1 2 3\n9 1 2 x\n"), HasSubstr("vertex 1"));
  EXPECT_THAT(refusal("p.ply", ply_head("ascii") + "9 1 2 3\n"), HasSubstr("ends after 1 of 2"));
  EXPECT_THAT(refusal("p.ply", ply_head("morse")), HasSubstr("unknown format"));
  EXPECT_THAT(refusal("p.ply", "plz"), HasSubstr("does not start with"));
  EXPECT_THAT(refusal("p.ply", "ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
  EXPECT_THAT(refusal("p.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                      "property float y\nend_header\n1 2\n"),
              HasSubstr("no float or double z"));
  EXPECT_THAT(refusal("p.ply", "ply\nformat ascii 1.0\nelement vertex 1e30\nend_header\n"),
              HasSubstr("element count"));
  EXPECT_THAT(refusal("p.ply",
                      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n"),
              HasSubstr("holds no points"));
}

TEST(PointsFile, RefusesEveryTruncationOfAPly) {
  const std::string whole =
      ply_head("binary_little_endian") + ply_vertex(1, 2, 3, false) + ply_vertex(-4, -5, -6, false);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    refusal("p.ply", whole.substr(0, size));
  }
}

TEST(PointsFile, ReadsMarkupsWithTheirFrame) {
  const auto file = loaded("p.mrk.json", R"({"markups": [{"type": "Fiducial", "name": "lamina",
      "coordinateSystem": "RAS", "coordinateUnits": "mm", "controlPoints": [
        {"label": "1", "position": [1, 2, 3]},
        {"label": "2", "position": [4, 5, 6], "positionStatus": "undefined"}]}]})");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_THAT(file->points, ElementsAre(Vec3{1, 2, 3}));
  EXPECT_THAT(file->regions, ElementsAre("lamina"));
  EXPECT_EQ(file->axes, Axes::kRas);
  EXPECT_EQ(file->metres_per_unit, 1e-3);
}

TEST(PointsFile, ReadsLegacyFiducials) {
  const std::string head = "# Markups fiducial file version = 4.11\n# CoordinateSystem = ";
  const std::string rows =
      "\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc\n"
      "vtkMRML_0,1,2,3,0,0,0,1,1,1,0,F-1,,\n";
  for (const auto& [text, axes] :
       {std::pair{"LPS", Axes::kLps}, {"1", Axes::kLps}, {"RAS", Axes::kRas}, {"0", Axes::kRas}}) {
    const auto file = loaded("p.fcsv", head + text + rows);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_THAT(file->points, ElementsAre(Vec3{1, 2, 3}));
    EXPECT_EQ(file->axes, axes);
  }
  EXPECT_THAT(refusal("p.fcsv", head + "2" + rows), HasSubstr("must be LPS, RAS, 0 or 1"));
  EXPECT_THAT(refusal("p.fcsv", "vtkMRML_0,1,2,3\n"), HasSubstr("CoordinateSystem"));
  EXPECT_THAT(refusal("p.fcsv", head + "LPS\nvtkMRML_0,1,2\n"), HasSubstr("line 3"));
  EXPECT_THAT(refusal("p.fcsv", head + "LPS\n"), HasSubstr("holds no points"));
}

TEST(PointsFile, RefusesLegacyMarkupsWithOtherColumns) {
  const std::string system = "# CoordinateSystem = LPS\n";
  const auto slicer = loaded("p.fcsv", system +
                                           "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,"
                                           "desc,associatedNodeID\nf,1,2,3,0,0,0,1,1,1,0,a,,\n");
  EXPECT_TRUE(slicer.ok());
  EXPECT_THAT(refusal("p.fcsv", system + "# columns = label,x,y,z,sel,vis\na,1,2,3,1,1\n"),
              HasSubstr("p.fcsv: line 2: columns are \"label,x,y,z,sel,vis\", must be id,x,y,z"));
  EXPECT_THAT(refusal("p.fcsv", system + "# columns = id,y,x,z\nf,1,2,3\n"),
              HasSubstr("must be id,x,y,z"));
}

}  // namespace
}  // namespace orthonav::engine::points_file_test
