#include "engine/holograms/shapes/hologram_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "engine/holograms/labels/status_rows.h"
#include "engine/holograms/shapes/hologram_shapes.h"

namespace orthonav::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr render::Label kStatusLabel = 1101;

std::vector<std::string> texts_of(const render::Scene& scene) {
  std::vector<std::string> texts;
  for (const render::TextItem& item : scene.texts) {
    texts.push_back(item.runs.front().text);
  }
  return texts;
}

/// A text of parts, put together.
struct Parted {
  std::string text;
  StatusParts parts;

  Parted& add(Importance importance, const std::string& separator, const std::string& words) {
    parts.add({importance, text.size(), separator.size()});
    text += separator + words;
    return *this;
  }
  [[nodiscard]] std::array<std::string, kDetailRows> rows() const {
    std::array<std::string, kDetailRows> rows;
    std::array<std::string*, kDetailRows> into = {&rows[0], &rows[1]};
    fill_rows(text, parts, into);
    return rows;
  }
};

std::string words(std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    out += (i > 0 ? " " : "") + std::string("abcdefgh");
  }
  return out;
}

TEST(StatusLine, TellsToolsApartByShapeToo) {
  const std::vector<ToolDot> tools = {
      {ToolState::kMeasured}, {ToolState::kPredicted}, {ToolState::kLost}};
  render::Scene scene;
  add_status_line(scene, "setup", tools, kStatusLabel);
  EXPECT_THAT(texts_of(scene), ElementsAre("setup", "●", "◐", "○"));
  EXPECT_EQ(scene.texts[1].rim, look::colours().good);
  EXPECT_EQ(scene.texts[3].rim, look::colours().poor);
}

TEST(StatusLine, KeepsStepAndToolsOnARowOfTheirOwn) {
  const std::array<ToolDot, 1> tools = {{{ToolState::kLost}}};
  render::Scene scene;
  add_status_line(scene, "guide L4 left | guide lost; say go to next", tools, kStatusLabel);
  EXPECT_THAT(texts_of(scene), ElementsAre("guide L4 left", "○", "guide lost; say go to next"));
  EXPECT_EQ(scene.texts[0].offset_up, scene.texts[1].offset_up);
  EXPECT_LT(scene.texts[2].offset_up, scene.texts[0].offset_up - 1.0f) << "below";
}

TEST(StatusLine, CutsALongStepAndNeverADot) {
  const std::array<ToolDot, 4> tools = {
      {{ToolState::kLost}, {ToolState::kMeasured}, {ToolState::kPredicted}, {ToolState::kLost}}};
  render::Scene scene;
  add_status_line(scene, "digitize " + words(12), tools, kStatusLabel);
  const auto texts = texts_of(scene);
  EXPECT_THAT(texts.front(), EndsWith("…"));
  EXPECT_THAT(texts.front(), HasSubstr("digitize"));
  EXPECT_THAT(std::vector(texts.begin() + 1, texts.end()), ElementsAre("○", "●", "◐", "○"));
}

TEST(StatusRows, HoldAShortTextOnOne) {
  const auto rows =
      Parted().add(Importance::kCount, "", "120 points").add(Importance::kNext, " | ", "go").rows();
  EXPECT_THAT(rows, ElementsAre("120 points | go", ""));
}

TEST(StatusRows, WrapBetweenWordsWithoutASeparatorAtTheirEdges) {
  const Parted text = Parted()
                          .add(Importance::kFigures, "", words(9))
                          .add(Importance::kNext, "; ", "digitize the left lamina now");
  const auto rows = text.rows();
  EXPECT_FALSE(rows[1].empty());
  for (const std::string& row : rows) {
    EXPECT_LE(width_caps(row), kStatusWidth_caps);
    EXPECT_NE(row.front(), ' ');
    EXPECT_NE(row.back(), ';');
  }
  EXPECT_THAT(rows[0] + " " + rows[1], EndsWith("; digitize the left lamina now"));
}

TEST(StatusRows, KeepTheCommaOfASentenceThatGoesOnInTheNextRow) {
  int broken_there = 0;
  std::string said = "accept,";
  while (width_caps(said) <= kStatusWidth_caps) {
    const auto rows = Parted().add(Importance::kNext, "", said + " delete to redo it").rows();
    if (rows[1] == "delete to redo it") {
      ++broken_there;
      EXPECT_EQ(rows[0], said);
    }
    said.insert(said.begin(), 'x');
  }
  EXPECT_GT(broken_there, 0);
}

TEST(StatusRows, DropTheLeastImportantFirstAndSaySo) {
  const auto with = [](std::size_t more) {
    Parted text;
    text.add(Importance::kMessage, "", "refused: " + words(4));
    for (std::size_t i = 0; i < more; ++i) {
      text.add(Importance::kMore, "; ", std::to_string(i) + " " + words(6));
    }
    text.add(Importance::kNext, "; ", "digitize the left lamina");
    const auto rows = text.rows();
    return rows[0] + "/" + rows[1];
  };
  EXPECT_THAT(with(1), HasSubstr("0 abc"));
  EXPECT_THAT(with(1), EndsWith("digitize the left lamina"));
  EXPECT_THAT(with(5), HasSubstr("refused"));
  EXPECT_THAT(with(5), HasSubstr("0 abc")) << "of equals the first stays";
  EXPECT_THAT(with(5), ::testing::Not(HasSubstr("2 abc")));
  EXPECT_THAT(with(5), EndsWith("digitize the left lamina …"));
}

TEST(StatusRows, KeepDangerAndWhatToDoLongest) {
  const auto rows = Parted()
                        .add(Importance::kDanger, "", "guide lost")
                        .add(Importance::kMessage, "; ", words(40))
                        .add(Importance::kNext, "; ", "digitize the left lamina")
                        .add(Importance::kHeard, " | ", "heard: " + words(12))
                        .rows();
  EXPECT_THAT(rows, ElementsAre("guide lost; digitize the left lamina …", ""));
}

TEST(StatusRows, CutWhatIsTooLongByItself) {
  const auto rows = Parted().add(Importance::kMessage, "", "refused: " + words(60)).rows();
  EXPECT_THAT(rows[1], EndsWith("…"));
  EXPECT_LE(width_caps(rows[1]), kStatusWidth_caps);
  const auto one_word = Parted().add(Importance::kMessage, "", std::string(3000, 'x')).rows();
  EXPECT_THAT(one_word[0], EndsWith("…"));
  EXPECT_LE(width_caps(one_word[0]), kStatusWidth_caps);
  EXPECT_THAT(Parted().add(Importance::kMessage, "", "").rows(), ElementsAre("", ""));
}

}  // namespace
}  // namespace orthonav::engine
