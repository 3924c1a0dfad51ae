#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "hal/replay/png_picture.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/stream_recorder_folder.h"

namespace orthonav::replay::bad_recording_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::HandmadeTar;
using orthonav::test::StreamRecorderFolder;
using orthonav::test::TemporaryFolder;
using orthonav::test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kFrame = 333'333;

/// The one line with which a folder is refused.
std::string refusal(const std::filesystem::path& path) {
  const auto headset = ReplayHeadset::open(path);
  return headset.ok() ? "accepted" : headset.error().message;
}

struct Damage {
  std::string name;
  std::function<void(const StreamRecorderFolder&)> apply;
  std::vector<std::string> says;  ///< file, field, value, limit
};

Damage pose_damage(const std::string& name, const std::string& line,
                   const std::vector<std::string>& says) {
  return {name, [line](const StreamRecorderFolder& f) { f.write("VLC LF_rig2world.txt", line); },
          says};
}

Damage extrinsics_damage(const std::string& name, const std::string& text,
                         const std::vector<std::string>& says) {
  return {name, [text](const StreamRecorderFolder& f) { f.write("VLC RF_extrinsics.txt", text); },
          says};
}

Damage lut_damage(const std::string& name, int component, float value,
                  const std::vector<std::string>& says) {
  return {name,
          [=](const StreamRecorderFolder& f) {
            f.write("VLC RF_lut.bin", StreamRecorderFolder::rays_with(17, 4, component, value));
          },
          says};
}

Damage tar_damage(const std::string& name, const std::function<std::string()>& bytes,
                  const std::vector<std::string>& says) {
  return {name, [bytes](const StreamRecorderFolder& f) { f.write("VLC LF.tar", bytes()); }, says};
}

std::string two_images() {
  return HandmadeTar()
      .add_image(StreamRecorderFolder::kStart, 0)
      .add_image(StreamRecorderFolder::kStart + kFrame, 2)
      .finished();
}

std::string one_member(const std::string& name, const std::string& content) {
  return HandmadeTar().add(name, content).finished();
}

std::string png(int width_px, int height_px) {
  const GreyImage image(width_px, height_px, 9);
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(encode_png(image, bytes).ok());
  return {bytes.begin(), bytes.end()};
}

std::vector<Damage> damages() {
  const std::string image = HandmadeTar::pgm(640, 480, 9);
  std::vector<Damage> all;
  for (const char* file :
       {"VLC LF.tar", "VLC RF.tar", "VLC LF_lut.bin", "VLC RF_lut.bin", "VLC LF_extrinsics.txt",
        "VLC RF_extrinsics.txt", "VLC LF_rig2world.txt", "VLC RF_rig2world.txt"}) {
    all.push_back({std::string("no ") + file,
                   [file](const StreamRecorderFolder& f) { f.remove(file); },
                   {file, "no such file"}});
  }
  all.insert(
      all.end(),
      {tar_damage("cut within the first image", [] { return two_images().substr(0, 300'000); },
                  {"VLC LF.tar", "holds no whole image", "cut off at byte 300000"}),
       tar_damage("empty file", [] { return std::string(); }, {"VLC LF.tar", "cut off at byte 0"}),
       tar_damage("no member", [] { return HandmadeTar().finished(); },
                  {"VLC LF.tar", "holds no image"}),
       tar_damage("no archive", [] { return std::string(5000, 'x'); }, {"VLC LF.tar"}),
       tar_damage("blanked header",
                  [] {
                    std::string bytes = two_images();
                    bytes.replace(308'224, 512, std::string(512, '\0'));
                    return bytes;
                  },
                  {"VLC LF.tar", "after its end mark"}),
       tar_damage("foreign member", [=] { return one_member("readme.txt", image); },
                  {"VLC LF.tar", "readme.txt", "<ticks>.pgm"}),
       tar_damage("negative time", [=] { return one_member("-5.pgm", image); },
                  {"VLC LF.tar", "-5.pgm"}),
       tar_damage("huge time", [=] { return one_member("99999999999999999999.pgm", image); },
                  {"VLC LF.tar", "99999999999999999999.pgm"}),
       tar_damage("time out of range", [=] { return one_member("9000000000000000000.pgm", image); },
                  {"VLC LF.tar", "9000000000000000000", "285 years"}),
       tar_damage("small image", [] { return one_member("5.pgm", HandmadeTar::pgm(320, 240, 1)); },
                  {"VLC LF.tar", "5.pgm", "320x240 px", "must be 640x480"}),
       tar_damage("short image",
                  [=] { return one_member("5.pgm", image.substr(0, image.size() - 1)); },
                  {"VLC LF.tar", "5.pgm", "307214", "must be 307215"}),
       tar_damage("long image", [=] { return one_member("5.pgm", image + "x"); },
                  {"VLC LF.tar", "5.pgm", "307216", "must be 307215"}),
       tar_damage("16 bit image",
                  [=] { return one_member("5.pgm", "P5\n640 480\n65535\n" + image); },
                  {"VLC LF.tar", "65535", "must be 255"}),
       tar_damage("text image", [] { return one_member("5.pgm", "P2\n640 480\n255\n1 2 3"); },
                  {"VLC LF.tar", "5.pgm", "P5"}),
       tar_damage("PNG that is none", [=] { return one_member("5.png", image); },
                  {"VLC LF.tar", "5.png", "is not a PNG"}),
       tar_damage("small PNG", [] { return one_member("5.png", png(320, 240)); },
                  {"VLC LF.tar", "5.png", "320x240 px", "must be 640x480"}),
       tar_damage("PNG of 16 bits",
                  [] {
                    std::string bytes = png(640, 480);
                    bytes[24] = 16;
                    return one_member("5.png", bytes);
                  },
                  {"VLC LF.tar", "5.png", "eight bits of grey"}),
       tar_damage("broken header", [] { return one_member("5.pgm", "P5\n640 x"); },
                  {"VLC LF.tar", "5.pgm", "broken PGM header"}),
       tar_damage(
           "no pair",
           [=] {
             return HandmadeTar().add_image(StreamRecorderFolder::kStart + 120'000, 0).finished();
           },
           {"no stereo pair", "11.1 ms"})});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  all.insert(all.end(),
             {lut_damage("nan ray", 0, kNan, {"VLC RF_lut.bin", "pixel (17, 4)", "not finite"}),
              lut_damage("nan depth", 2, kNan, {"VLC RF_lut.bin", "pixel (17, 4)", "not finite"}),
              lut_damage("infinite ray", 1, kInf, {"VLC RF_lut.bin", "not finite"}),
              lut_damage("long ray", 0, 3.0F, {"VLC RF_lut.bin", "pixel (17, 4)", "must be 1"}),
              {"backward ray",
               [](const StreamRecorderFolder& f) {
                 std::string rays = StreamRecorderFolder::rays();
                 for (std::size_t i = 2 * sizeof(float) + 3; i < rays.size(); i += 12) {
                   rays[i] = static_cast<char>(rays[i] ^ static_cast<char>(0x80));
                 }
                 f.write("VLC RF_lut.bin", rays);
               },
               {"VLC RF_lut.bin", "must point ahead"}},
              {"short table",
               [](const StreamRecorderFolder& f) { f.write("VLC RF_lut.bin", "short"); },
               {"VLC RF_lut.bin", "5 bytes", "must be 3686400"}},
              {"long table",
               [](const StreamRecorderFolder& f) {
                 f.write("VLC RF_lut.bin", StreamRecorderFolder::rays() + "x");
               },
               {"VLC RF_lut.bin", "3686401 bytes", "3686400"}},
              {"empty table",
               [](const StreamRecorderFolder& f) {
                 f.write("VLC RF_lut.bin", std::string(3'686'400, '\0'));
               },
               {"VLC RF_lut.bin"}}});
  all.insert(
      all.end(),
      {extrinsics_damage("mirrored camera", "0,1,0,0,1,0,0,0,0,0,1,0,0,0,0,1",
                         {"VLC RF_extrinsics.txt", "camera_from_rig", "mirrors", "-1.0", "+1"}),
       extrinsics_damage("nan camera", "0,1,0,0,1,0,0,nan,0,0,-1,0,0,0,0,1",
                         {"VLC RF_extrinsics.txt", "m24", "nan", "finite"}),
       extrinsics_damage("infinite camera", "0,1,0,0,1,0,0,0,0,0,-1,-inf,0,0,0,1",
                         {"VLC RF_extrinsics.txt", "m34", "-inf", "finite"}),
       extrinsics_damage("word", "0,1,0,0,1,0,0,0,0,0,-1,zero,0,0,0,1",
                         {"VLC RF_extrinsics.txt", "m34", "\"zero\"", "number"}),
       extrinsics_damage("15 numbers", "0,1,0,0,1,0,0,0,0,0,-1,0,0,0,0",
                         {"VLC RF_extrinsics.txt", "15 numbers", "must be 16"}),
       extrinsics_damage("17 numbers", "0,1,0,0,1,0,0,0,0,0,-1,0,0,0,0,1,0",
                         {"VLC RF_extrinsics.txt", "17 numbers", "must be 16"}),
       extrinsics_damage("transposed", "0,1,0,0,1,0,0,0,0,0,-1,0,0.1,0,0,1",
                         {"VLC RF_extrinsics.txt", "m41", "0,0,0,1"}),
       extrinsics_damage("scaled", "0,2,0,0,2,0,0,0,0,0,-2,0,0,0,0,1",
                         {"VLC RF_extrinsics.txt", "not rigid"}),
       extrinsics_damage("millimetres", "0,1,0,98.5,1,0,0,0,0,0,-1,0,0,0,0,1",
                         {"VLC RF_extrinsics.txt", "98.5", "limit 1.0"}),
       extrinsics_damage("empty", "", {"VLC RF_extrinsics.txt", "must be 16"}),
       pose_damage("mirrored pose", "5,1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1\n",
                   {"VLC LF_rig2world.txt", "line 1", "world_from_rig", "mirrors"}),
       pose_damage("nan pose", "5,1,0,0,0,0,1,0,0,0,0,1,nan,0,0,0,1\n",
                   {"VLC LF_rig2world.txt", "line 1", "m34", "finite"}),
       pose_damage("no rotation", "5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1\n",
                   {"VLC LF_rig2world.txt", "line 1", "not rigid"}),
       pose_damage("short line", StreamRecorderFolder::pose_line(0) + "132000000000333333,0.9\n",
                   {"VLC LF_rig2world.txt", "line 2", "2 values", "must be 17"}),
       pose_damage("two poses for one time",
                   StreamRecorderFolder::pose_line(0) +
                       "132000000000000000,1,0,0,0,0,1,0,0,0,0,1,9,0,0,0,1\n",
                   {"VLC LF_rig2world.txt", "line 2", "another pose already"}),
       pose_damage("fractional time", "5.5,1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n",
                   {"VLC LF_rig2world.txt", "line 1", "ticks"}),
       pose_damage("time far off", "5,1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n",
                   {"VLC LF_rig2world.txt", "285 years"})});
  return all;
}

class BadRecording : public ::testing::TestWithParam<Damage> {};

TEST_P(BadRecording, IsRefusedInOneLineThatSaysWhy) {
  const StreamRecorderFolder folder({0, kFrame}, {0, kFrame});
  GetParam().apply(folder);
  const std::string line = refusal(folder.path());
  EXPECT_NE(line, "accepted");
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  for (const std::string& part : GetParam().says) {
    EXPECT_THAT(line, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadRecording, ::testing::ValuesIn(damages()), [](const auto& damage) {
  std::string name = damage.param.name;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      c = '_';
    }
  }
  return name;
});

TEST(WholeRecording, IsAccepted) {
  const StreamRecorderFolder folder({0, kFrame}, {0, kFrame});
  EXPECT_EQ(refusal(folder.path()), "accepted");
}

TEST(BadFolder, NamesAMissingOrForeignFolder) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder / "nowhere"), AllOf(HasSubstr("nowhere"), HasSubstr("no such")));
  EXPECT_EQ(ReplayHeadset::open(folder / "nowhere").error().code, ErrorCode::kNotFound);
  write_text(folder / "file", "x");
  EXPECT_THAT(refusal(folder / "file"), HasSubstr("is not a folder"));
  EXPECT_THAT(refusal(folder.path()), AllOf(HasSubstr("VLC LF.tar"), HasSubstr("no such file")));
  EXPECT_EQ(ReplayHeadset::open(folder.path()).error().code, ErrorCode::kNotFound);
  write_text(folder / "vlc_lf.tar", "x");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("vlc_lf.tar: is not a tar archive"));
  std::filesystem::create_directory(folder / "VLC LF.tar");
  std::filesystem::remove(folder / "vlc_lf.tar");
  EXPECT_THAT(refusal(folder.path()), AllOf(HasSubstr("VLC LF.tar"), HasSubstr("is not a file")));
}

}  // namespace
}  // namespace orthonav::replay::bad_recording_test
