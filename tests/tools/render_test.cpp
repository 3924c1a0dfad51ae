#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/tools/command_line.h"

namespace orthonav::test::render_test {
namespace {

using ::testing::HasSubstr;

std::string scene_file(const ScratchFolder& folder, const std::string& hologram) {
  std::ofstream(folder.file("scene.json")) << R"({"format": "orthonav-scene", "version": 1,
            "view": {"eye_mm": [0, 0, 450], "target_mm": [0, 0, 0]},
            "holograms": [)" << hologram << "]}";
  return folder.file("scene.json");
}

constexpr const char* kLine =
    R"({"type": "line", "points_mm": [[-40, 0, 0], [40, 0, 0]], "width_mm": 2})";

TEST(RenderCommand, DrawsOneEyeOrBothAtTheSizeAsked) {
  const ScratchFolder folder;
  const std::string scene = scene_file(folder, kLine);
  const Called both =
      orthonav({"render", scene, "--out", folder.file("both.png"), "--size", "320x180"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("2 eyes, 320x180 px each"));
  for (const char* eye : {"left", "right"}) {
    const Called one = orthonav({"render", scene, "--out", folder.file(std::string(eye) + ".png"),
                                 "--size", "320x180", "--eye", eye});
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_THAT(one.out, HasSubstr("1 eye, 320x180 px each"));
  }
  EXPECT_NE(content_of(folder.file("left.png")), content_of(folder.file("right.png")));
  const Called wound = orthonav({"render", scene, "--out", folder.file("wound.png"), "--size",
                                 "320x180", "--background", "wound", "--blend", "over"});
  EXPECT_EQ(wound.code, 0) << wound.err;
  EXPECT_NE(content_of(folder.file("wound.png")), content_of(folder.file("both.png")));
}

TEST(RenderCommand, RefusesWhatItCannotDrawAndWritesNothing) {
  const ScratchFolder folder;
  const std::string out = folder.file("out.png");
  const auto refused = [&](const std::string& hologram, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"render", scene_file(folder, hologram), "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    const Called called = orthonav(words);
    EXPECT_EQ(called.code, 2) << hologram;
    EXPECT_FALSE(std::filesystem::exists(out));
    return called.err;
  };
  EXPECT_THAT(refused(R"({"type": "circle"})"), HasSubstr("holograms[0].type is \"circle\""));
  EXPECT_THAT(refused(R"({"type": "text", "position_mm": [NaN, 0, 0]})"), HasSubstr("is not JSON"));
  EXPECT_THAT(refused(kLine, {"--size", "0x0"}), HasSubstr("0 px, expected 16 to 8192"));
  EXPECT_THAT(refused(kLine, {"--size", "wide"}), HasSubstr("must be WIDTHxHEIGHT"));
  EXPECT_THAT(refused(kLine, {"--background", folder.file("absent.png")}), HasSubstr("absent.png"));
}

TEST(RenderCommand, SaysHowHologramsStandOutInALitRoom) {
  const ScratchFolder folder;
  const std::string scene = scene_file(folder, kLine);
  const auto seen = [&](const char* lux) {
    return orthonav({"render", scene, "--out", folder.file(std::string(lux) + ".png"), "--size",
                     "320x180", "--background", "wound", "--optics", "--ambient", lux});
  };
  const Called dim = seen("300");
  EXPECT_EQ(dim.code, 0) << dim.err;
  EXPECT_THAT(dim.out, HasSubstr("H99  #1"));
  EXPECT_THAT(dim.out, ::testing::Not(HasSubstr("hard to make out")));
  EXPECT_THAT(seen("90000").out, HasSubstr("hard to make out"));
  const Called wrong = seen("-5");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("ambient light must lie in [0, 200000] lux"));
}

TEST(RenderCommand, SaysWhichCharacterTheFontLacks) {
  const ScratchFolder folder;
  const auto drawn = [&](const std::string& text) {
    const std::string scene = scene_file(
        folder,
        R"({"type": "text", "position_mm": [0, 0, 0], "height_mm": 5, "text": ")" + text + "\"}");
    return orthonav({"render", scene, "--out", folder.file("out.png"), "--size", "320x180"});
  };
  const Called strange = drawn("12.4 中");
  EXPECT_EQ(strange.code, 0);
  EXPECT_THAT(strange.err, HasSubstr("U+4E2D"));
  EXPECT_EQ(drawn("12.4°").err, "") << "the twin";
}

TEST(RenderCommand, DrawsATextOf10000Digits) {
  const ScratchFolder folder;
  const std::string text =
      R"({"type": "text", "position_mm": [0, 0, 0], "height_mm": 5, "text": ")" +
      std::string(10'000, '8') + "\"}";
  const Called called = orthonav(
      {"render", scene_file(folder, text), "--out", folder.file("out.png"), "--size", "320x180"});
  EXPECT_EQ(called.code, 0) << called.err;
}

}  // namespace
}  // namespace orthonav::test::render_test
