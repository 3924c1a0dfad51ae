#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "engine/print/board_sheet.h"
#include "engine/print/sheet_drawing.h"
#include "engine/print/tag_sheets.h"
#include "nav/tracking/marker_detector.h"

// What is printed is drawn as an image by the same code and measured there.
namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kPxPerMm = 10.0;
// A tag is usable if its place and size are as its text says; the detector itself is exact to some
// hundredths of these pixels.
constexpr double kPlaceToleranceMm = 0.1;
// A ruler's tick is 1.5 pixels wide: its centre of mass is exact but for the grey levels.
constexpr double kRulerToleranceMm = 0.02;

PrintedTag tag(const std::string& family, int id, double size_m, const std::string& tool = "") {
  PrintedTag printed;
  printed.marker.family = family;
  printed.marker.id = id;
  printed.marker.size_m = size_m;
  printed.name = tool;
  return printed;
}

Page a4() { return *page_named("A4", false); }

GreyImage drawn(const Sheet& sheet, double px_per_mm = kPxPerMm) {
  auto image = image_of(sheet, px_per_mm);
  EXPECT_TRUE(image);
  return image ? *image : GreyImage();
}

using Corners = std::array<Vec2, 4>;

/// Corners in millimetres on the page, by id.
std::map<int, Corners> detected(const GreyImage& image, const std::string& family) {
  nav::DetectorOptions options;
  options.families = {family};
  auto detector = nav::MarkerDetector::create(options);
  std::vector<nav::MarkerCorners> found;
  EXPECT_TRUE(detector && detector->detect(image, found));
  std::map<int, Corners> corners;
  for (const nav::MarkerCorners& marker : found) {
    EXPECT_FALSE(corners.contains(marker.id)) << "id " << marker.id << " twice";
    for (std::size_t i = 0; i < 4; ++i) {
      corners[marker.id][i] = marker.corners_px[i] * (1.0 / kPxPerMm);
    }
  }
  return corners;
}

/// Bottom left, bottom right, top right, top left of an upright square on the page.
Corners square(double left_mm, double top_mm, double size_mm) {
  const double right = left_mm + size_mm;
  const double bottom = top_mm + size_mm;
  return {{{left_mm, bottom}, {right, bottom}, {right, top_mm}, {left_mm, top_mm}}};
}

double farthest_mm(const Corners& a, const Corners& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    farthest = std::max(farthest, (a[i] - b[i]).norm());
  }
  return farthest;
}

/// A tag file's wide border as a family of the library: the bits one cell farther in.
std::map<int, Corners> detected_with_wide_borders(const GreyImage& image) {
  const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(),
                                                                                tag36h11_destroy);
  family->width_at_border += 2;
  family->total_width += 2;
  for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
    ++family->bit_x[bit];
    ++family->bit_y[bit];
  }
  const std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), family.get(), 1);
  detector->quad_decimate = 1;
  GreyImage copy = image;
  image_u8_t view = {copy.width_px, copy.height_px, copy.width_px, copy.pixels.data()};
  zarray_t* detections = apriltag_detector_detect(detector.get(), &view);
  std::map<int, Corners> corners;
  for (int i = 0; i < zarray_size(detections); ++i) {
    apriltag_detection_t* found = nullptr;
    zarray_get(detections, i, &found);
    if (found->decision_margin < nav::DetectorOptions().min_decision_margin) {
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      corners[found->id][k] = {found->p[k][0] / kPxPerMm, found->p[k][1] / kPxPerMm};
    }
  }
  apriltag_detections_destroy(detections);
  return corners;
}

TEST(PrintedTags, LieAndMeasureWhatTheLayoutSays) {
  for (const std::string family : {"tag36h11", "tagStandard41h12", "tag25h9", "tag36h10"}) {
    std::vector<PrintedTag> tags;
    for (int id = 0; id < 4; ++id) {
      tags.push_back(tag(family, id, 0.030));
    }
    tags.push_back(tag(family, 7, 0.0475, "pointer"));
    const auto sheets = tag_sheets(tags, {a4(), 1.0});
    ASSERT_TRUE(sheets) << sheets.error().message;
    std::vector<std::map<int, Corners>> pages;
    std::size_t count = 0;
    for (const Sheet& sheet : sheets->sheets) {
      pages.push_back(detected(drawn(sheet), family));
      count += pages.back().size();
    }
    ASSERT_EQ(count, tags.size()) << family;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const PlacedTag& at = sheets->placed[i];
      EXPECT_DOUBLE_EQ(at.size_mm, tags[i].marker.size_m * 1e3);
      const Corners expected =
          square(at.x_mm - at.size_mm / 2, at.y_mm - at.size_mm / 2, at.size_mm);
      EXPECT_LT(farthest_mm(pages[at.sheet].at(tags[i].marker.id), expected), kPlaceToleranceMm)
          << family;
    }
  }
}

TEST(PrintedTags, ATagPrintedTooSmallIsSeen) {
  const auto sheets = tag_sheets({tag("tag36h11", 3, 0.040)}, {a4(), 1.0});
  ASSERT_TRUE(sheets);
  const PlacedTag& at = sheets->placed[0];
  const Corners expected = square(at.x_mm - 20, at.y_mm - 20, 40);
  // "Fit to page" takes half a per cent: 0.2 mm of this tag.
  const auto found = detected(drawn(sheets->sheets[0], 0.995 * kPxPerMm), "tag36h11");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(farthest_mm(found.at(3), expected), kPlaceToleranceMm);
}

TEST(PrintedTags, HaveWideBordersWhereTheirFamilySaysSo) {
  const auto sheets = tag_sheets({tag("tag36h11b2", 3, 0.040)}, {a4(), 1.0});
  ASSERT_TRUE(sheets) << sheets.error().message;
  const PlacedTag& at = sheets->placed[0];
  const Corners expected = square(at.x_mm - 20, at.y_mm - 20, 40);
  const GreyImage image = drawn(sheets->sheets[0]);
  for (const auto& found : {detected_with_wide_borders(image), detected(image, "tag36h11b2")}) {
    ASSERT_TRUE(found.contains(3));
    EXPECT_LT(farthest_mm(found.at(3), expected), kPlaceToleranceMm);
  }
}

TEST(PrintedTags, GoOnToFurtherPages) {
  std::vector<PrintedTag> tags;
  for (int id = 0; id < 20; ++id) {
    tags.push_back(tag("tag36h11", id, 0.038));
  }
  const auto sheets = tag_sheets(tags, {a4(), 2.0});
  ASSERT_TRUE(sheets);
  // Three columns and three rows of 57 mm and text on a page.
  ASSERT_EQ(sheets->sheets.size(), 3u);
  std::size_t found = 0;
  for (const Sheet& sheet : sheets->sheets) {
    found += detected(drawn(sheet), "tag36h11").size();
  }
  EXPECT_EQ(found, 20u);
  EXPECT_EQ(sheets->placed.back().sheet, 2u);
}

struct Box {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
};

Box box_of(const SheetCut& cut) {
  Box box;
  for (const Vec2& c : cut.corners_mm) {
    box = {std::min(box.left, c.x), std::min(box.top, c.y), std::max(box.right, c.x),
           std::max(box.bottom, c.y)};
  }
  return box;
}

TEST(PrintedTags, KeepTheirQuietZoneInsideTheCut) {
  for (const double quiet_cells : {1.0, 2.5}) {
    const auto sheets = tag_sheets({tag("tag36h11", 3, 0.040)}, {a4(), quiet_cells});
    ASSERT_TRUE(sheets);
    ASSERT_EQ(sheets->sheets[0].cuts.size(), 1u);
    const Box cut = box_of(sheets->sheets[0].cuts[0]);
    EXPECT_NEAR(cut.right - cut.left, 40 + 2 * 5 * quiet_cells, 1e-9);
    const PlacedTag& at = sheets->placed[0];
    EXPECT_GE(at.y_mm - 20 - cut.top, 5 * quiet_cells);
    EXPECT_GE(cut.bottom - at.y_mm - 20, 5 * quiet_cells);
    // The bits of this family reach two cells beyond its size of five.
    const auto outside = tag_sheets({tag("tagStandard41h12", 3, 0.040)}, {a4(), quiet_cells});
    ASSERT_TRUE(outside);
    const Box wide = box_of(outside->sheets[0].cuts[0]);
    EXPECT_NEAR(wide.right - wide.left, 40 + 2 * 8 * (2 + quiet_cells), 1e-9);
  }
}

/// By the rule of crossings: a ray to the right.
bool is_inside(const SheetCut& cut, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < cut.corners_mm.size(); ++i) {
    const Vec2 a = cut.corners_mm[i];
    const Vec2 b = cut.corners_mm[(i + 1) % cut.corners_mm.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

/// As it is once cut out and glued onto something black.
GreyImage cut_out(const GreyImage& page, const SheetCut& cut) {
  GreyImage image = page;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      if (!is_inside(cut, {(x + 0.5) / kPxPerMm, (y + 0.5) / kPxPerMm})) {
        image.at(x, y) = 0;
      }
    }
  }
  return image;
}

/// The darkest pixel of the quiet zone: `quiet_mm` of white around a square of `size_mm`.
int darkest_around(const GreyImage& image, const PlacedTag& at, double size_mm, double quiet_mm) {
  // The tag's own edge, and the cut line beside the quiet zone, cover half a pixel more.
  constexpr double kEdgeMm = 0.1;
  int darkest = 255;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const double off_mm = std::max(std::abs((x + 0.5) / kPxPerMm - at.x_mm),
                                     std::abs((y + 0.5) / kPxPerMm - at.y_mm)) -
                            size_mm / 2;
      if (off_mm > kEdgeMm && off_mm < quiet_mm - kEdgeMm) {
        darkest = std::min(darkest, static_cast<int>(image.at(x, y)));
      }
    }
  }
  return darkest;
}

struct CutTag {
  const char* family;
  double size_mm;
  double quiet_mm;  ///< a cell
  double outer_mm;  ///< with the bits outside of the border
};

constexpr CutTag kCutTags[] = {{"tag36h11", 40, 5, 40},       {"tag36h11", 12, 1.5, 12},
                               {"tag36h11", 5, 0.625, 5},     {"tagStandard41h12", 40, 8, 72},
                               {"tagStandard41h12", 5, 1, 9}, {"tag36h11", 120, 15, 120}};

TEST(PrintedTags, CarryIdSizeAndUpwardSideOnThePaperThatIsCutOut) {
  for (const CutTag& c : kCutTags) {
    const auto sheets = tag_sheets({tag(c.family, 17, c.size_mm * 1e-3, "pointer")}, {a4(), 1.0});
    ASSERT_TRUE(sheets) << sheets.error().message;
    const Sheet& sheet = sheets->sheets[0];
    const PlacedTag& at = sheets->placed[0];
    std::string inside;
    for (const SheetText& text : sheet.texts) {
      if (!is_inside(sheet.cuts[0], {text.x_mm, text.y_mm})) {
        continue;
      }
      inside += text.text + "|";
      EXPECT_GE(text.height_mm, 1.2) << "legible";
      EXPECT_GT(std::abs(text.y_mm - text.height_mm / 2 - at.y_mm), c.outer_mm / 2 + c.quiet_mm)
          << text.text;
      if (text.text == "up") {
        EXPECT_LT(text.y_mm, at.y_mm) << "above the tag";
      }
    }
    EXPECT_THAT(inside, HasSubstr("id 17"));
    EXPECT_THAT(inside, HasSubstr(mm_text(c.size_mm) + " mm"));
    EXPECT_THAT(inside, HasSubstr("up|"));
    EXPECT_THAT(inside, HasSubstr(c.family));
    // The notch: in the middle of the upper edge, and in no other.
    const Box cut = box_of(sheet.cuts[0]);
    EXPECT_FALSE(is_inside(sheet.cuts[0], {at.x_mm, cut.top + 0.5}));
    EXPECT_TRUE(is_inside(sheet.cuts[0], {at.x_mm, cut.bottom - 0.1}));
    EXPECT_TRUE(is_inside(sheet.cuts[0], {cut.left + 0.1, at.y_mm}));
    EXPECT_TRUE(is_inside(sheet.cuts[0], {cut.right - 0.1, at.y_mm}));
  }
}

TEST(PrintedTags, AreFoundWhenCutOutWithTheirText) {
  for (const CutTag& c : kCutTags) {
    const auto sheets = tag_sheets({tag(c.family, 17, c.size_mm * 1e-3)}, {a4(), 1.0});
    ASSERT_TRUE(sheets) << sheets.error().message;
    const PlacedTag& at = sheets->placed[0];
    const GreyImage page = drawn(sheets->sheets[0]);
    EXPECT_EQ(darkest_around(page, at, c.outer_mm, c.quiet_mm), 255)
        << c.family << " " << c.size_mm;
    const auto found = detected(cut_out(page, sheets->sheets[0].cuts[0]), c.family);
    ASSERT_TRUE(found.contains(17)) << c.family << " " << c.size_mm;
    EXPECT_EQ(found.size(), 1u);
    const Corners expected = square(at.x_mm - c.size_mm / 2, at.y_mm - c.size_mm / 2, c.size_mm);
    EXPECT_LT(farthest_mm(found.at(17), expected), kPlaceToleranceMm) << c.family << c.size_mm;
  }
}

TEST(PrintedTags, RefuseWhatDoesNotFitOrDoesNotExist) {
  const auto refusal = [](const PrintedTag& tag, double quiet_cells = 1.0) {
    const auto sheets = tag_sheets({tag}, {a4(), quiet_cells});
    return sheets ? std::string() : sheets.error().message;
  };
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.145)), IsEmpty());
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.146)),
              HasSubstr("tag36h11 id 3 of 146 mm takes 182.5 mm with its quiet zone, page A4 has "
                        "room for 182 mm"));
  EXPECT_THAT(refusal(tag("tag36h11", 587, 0.04)), HasSubstr("587"));
  EXPECT_THAT(refusal(tag("tag36h9", 3, 0.04)), HasSubstr("unknown tag family 'tag36h9'"));
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.001)), HasSubstr("size 1 mm, must be 5-200 mm"));
  EXPECT_THAT(refusal(tag("tag36h11", 3, std::nan(""))), HasSubstr("must be 5-200 mm"));
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.04), 0.5), HasSubstr("must be 1-4"));
  EXPECT_FALSE(tag_sheets({}, {a4(), 1.0}));
  EXPECT_FALSE(page_named("A5", false));
}

/// Centres of the dark runs along a line of the image, px.
std::vector<double> dark_centres(const std::vector<std::uint8_t>& line) {
  std::vector<double> centres;
  double mass = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const double dark = i < line.size() ? 255.0 - line[i] : 0.0;
    if (dark > 0) {
      mass += dark;
      moment += dark * (static_cast<double>(i) + 0.5);
    } else if (mass > 0) {
      centres.push_back(moment / mass);
      mass = moment = 0.0;
    }
  }
  return centres;
}

/// Length of the ruler along the page's width and of the other, over all their 101 ticks.
std::pair<double, double> rulers_mm(const Page& page, double px_per_mm) {
  const GreyImage image = drawn(blank_sheet(page), px_per_mm);
  const SheetRect across = horizontal_ruler(page);
  const SheetRect upward = vertical_ruler(page);
  const auto px = [](double mm) { return static_cast<int>(std::lround(mm * kPxPerMm)); };
  std::vector<std::uint8_t> row;
  for (int x = px(across.x_mm - 1); x < px(across.x_mm + across.width_mm + 1); ++x) {
    row.push_back(image.at(x, px(across.y_mm + 1)));
  }
  std::vector<std::uint8_t> column;
  for (int y = px(upward.y_mm - 1); y < px(upward.y_mm + upward.height_mm + 1); ++y) {
    column.push_back(image.at(px(upward.x_mm + upward.width_mm - 1), y));
  }
  const auto length_mm = [](const std::vector<double>& ticks) {
    EXPECT_EQ(ticks.size(), 101u);
    return ticks.empty() ? 0.0 : (ticks.back() - ticks.front()) / kPxPerMm;
  };
  return {length_mm(dark_centres(row)), length_mm(dark_centres(column))};
}

TEST(PrintedPage, HasRulersOf100Mm) {
  for (const PageSize& size : kPageSizes) {
    for (const bool landscape : {false, true}) {
      const auto page = page_named(std::string(size.name), landscape);
      ASSERT_TRUE(page);
      const auto [across, upward] = rulers_mm(*page, kPxPerMm);
      EXPECT_NEAR(across, 100.0, kRulerToleranceMm) << page->name;
      EXPECT_NEAR(upward, 100.0, kRulerToleranceMm) << page->name;
    }
  }
}

TEST(PrintedPage, RulersTellAPrintThatIsTooSmall) {
  const auto [across, upward] = rulers_mm(a4(), 0.999 * kPxPerMm);
  EXPECT_NEAR(across, 99.9, kRulerToleranceMm);
  EXPECT_NEAR(upward, 99.9, kRulerToleranceMm);
}

Board board_of(BoardKind kind) {
  Board board;
  board.kind = kind;
  board.columns = 6;
  board.rows = 7;
  board.size_m = 0.020;
  board.gap_m = 0.006;
  board.border_cells = kind == BoardKind::kAprilGrid ? 2 : 1;
  board.ids = consecutive_ids(kind, board.columns, board.rows, 0);
  if (kind == BoardKind::kChessboard) {
    board.family.clear();
    board.gap_m = 0.0;
    board.border_cells = 0;
  }
  return board;
}

void expect_every_tag_in_place(const std::map<int, Corners>& found, const Board& board,
                               const BoardSheet& sheet) {
  ASSERT_EQ(found.size(), board.ids.size());
  for (std::size_t i = 0; i < board.ids.size(); ++i) {
    Corners expected;
    const std::vector<Vec2> corners = tag_corners_m(board, i);
    for (std::size_t k = 0; k < 4; ++k) {
      expected[k] = {sheet.origin_x_mm + corners[k].x * 1e3,
                     sheet.origin_y_mm - corners[k].y * 1e3};
    }
    ASSERT_TRUE(found.contains(board.ids[i])) << board.ids[i];
    EXPECT_LT(farthest_mm(found.at(board.ids[i]), expected), kPlaceToleranceMm) << board.ids[i];
  }
}

TEST(PrintedBoard, HasEveryTagInPlace) {
  const Board board = board_of(BoardKind::kTags);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet) << sheet.error().message;
  expect_every_tag_in_place(detected(drawn(sheet->sheet), "tag36h11"), board, *sheet);
}

TEST(PrintedBoard, HasBordersOfTwoCellsOnAnAprilGrid) {
  const Board board = board_of(BoardKind::kAprilGrid);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet) << sheet.error().message;
  const GreyImage image = drawn(sheet->sheet);
  expect_every_tag_in_place(detected_with_wide_borders(image), board, *sheet);
  expect_every_tag_in_place(detected(image, "tag36h11b2"), board, *sheet);
  // The other way round: each border is read correctly.
  EXPECT_THAT(detected(image, "tag36h11"), IsEmpty());
  const auto plain = board_sheet(board_of(BoardKind::kTags), a4());
  ASSERT_TRUE(plain);
  // Some plain tags can be read with wide borders: their bits, sampled at cells of the wrong size,
  // happen to be those of the same or of another tag.
  EXPECT_LT(detected_with_wide_borders(drawn(plain->sheet)).size(), board.ids.size() / 2);
}

/// Whether the page is dark at a place of the board.
bool is_dark(const GreyImage& image, const BoardSheet& sheet, double x_mm, double y_mm) {
  const auto at = [](double mm) { return static_cast<int>(mm * kPxPerMm); };
  return image.at(at(sheet.origin_x_mm + x_mm), at(sheet.origin_y_mm - y_mm)) < 128;
}

TEST(PrintedBoard, HasBlackSquaresWhereTheGapsOfAnAprilGridCross) {
  const Board board = board_of(BoardKind::kAprilGrid);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet);
  const GreyImage image = drawn(sheet->sheet);
  // All squares at their corner away from the number, and the white between two of them.
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = 0; column <= board.columns; ++column) {
      EXPECT_TRUE(is_dark(image, *sheet, column * 26 - 0.3, row * 26 - 5.7)) << row << column;
      EXPECT_TRUE(is_dark(image, *sheet, column * 26 - 5.7, row * 26 - 5.7)) << row << column;
      EXPECT_FALSE(is_dark(image, *sheet, column * 26 - 3, row * 26 + 0.3)) << row << column;
      EXPECT_FALSE(is_dark(image, *sheet, column * 26 + 0.3, row * 26 - 3)) << row << column;
    }
  }
}

TEST(PrintedBoard, AlternatesTheSquaresOfAChessboard) {
  const Board board = board_of(BoardKind::kChessboard);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet) << sheet.error().message;
  const GreyImage image = drawn(sheet->sheet);
  for (int up = 0; up < board.rows; ++up) {
    for (int column = 0; column < board.columns; ++column) {
      for (const double inside_mm : {0.2, 19.8}) {
        EXPECT_EQ(is_dark(image, *sheet, column * 20 + inside_mm, up * 20 + inside_mm),
                  (board.rows - 1 - up + column) % 2 == 0);
      }
    }
  }
  EXPECT_FALSE(is_dark(image, *sheet, -0.2, 139));
  EXPECT_FALSE(is_dark(image, *sheet, 1, 140.2));
}

TEST(PrintedBoard, RefusesWhatDoesNotFit) {
  Board board = board_of(BoardKind::kAprilGrid);
  board.columns = 7;
  board.ids = consecutive_ids(board.kind, 7, 7, 0);
  EXPECT_THAT(board_sheet(board, a4()).error().message,
              HasSubstr("aprilgrid board of 7 x 7: 188 mm wide with its surround, page A4 has room "
                        "for 182 mm"));
  EXPECT_TRUE(board_sheet(board, *page_named("A3", false)));
  board.size_m = 0.0;
  EXPECT_THAT(board_sheet(board, a4()).error().message, HasSubstr("size 0 mm"));
}

TEST(PrintedPdf, IsTheSameEachTime) {
  const auto sheets = tag_sheets({tag("tag36h11", 3, 0.040, "pointer")}, {a4(), 1.0});
  ASSERT_TRUE(sheets);
  const auto once = pdf_of(sheets->sheets, "orthonav tags");
  const auto again = pdf_of(sheets->sheets, "orthonav tags");
  ASSERT_TRUE(once && again);
  EXPECT_EQ(*once, *again);
  EXPECT_EQ(once->substr(0, 5), "%PDF-");
  EXPECT_THAT(*once, HasSubstr("20000101000000Z"));
  EXPECT_FALSE(pdf_of({}, "nothing"));
}

}  // namespace
}  // namespace orthonav::engine
