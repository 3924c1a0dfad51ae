#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "tests/tools/command_line.h"

namespace orthonav::test::golden_command_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(GoldenCommand, ListsTheScenes) {
  const Called called = orthonav({"golden", "list"});
  EXPECT_EQ(called.code, 0) << called.err;
  for (const char* scene :
       {"h1_", "h2_", "h3_", "h4_", "h5_red", "h6_angle", "h10_", "h11_", "guidance"}) {
    EXPECT_THAT(called.out, HasSubstr(scene));
  }
}

TEST(GoldenCommand, DrawsTheSameBitsWithAnyNumberOfThreads) {
  const ScratchFolder folder;
  for (const char* threads : {"0", "1", "2"}) {
    setenv("LP_NUM_THREADS", threads, 1);
    const Called called = orthonav(
        {"golden", "render", "guidance", "h10_rod", "h5_red", "--out", folder.file(threads)});
    ASSERT_EQ(called.code, 0) << called.err;
  }
  unsetenv("LP_NUM_THREADS");
  const Called again = orthonav(
      {"golden", "render", "guidance", "h10_rod", "h5_red", "--out", folder.file("again")});
  ASSERT_EQ(again.code, 0) << again.err;
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("0"))) {
    const std::string name = entry.path().filename().string();
    const std::string bytes = content_of(entry.path().string());
    for (const char* other : {"1", "2", "again"}) {
      EXPECT_EQ(content_of(folder.file(other) + "/" + name) == bytes, true) << name << " " << other;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3 * 9);
}

/// The pictures of three scenes, by file name, on a processor with only these instructions.
std::map<std::string, std::string> drawn_with(const char* instructions) {
  const ScratchFolder folder;
  setenv("GALLIUM_OVERRIDE_CPU_CAPS", instructions, 1);
  const Called called =
      orthonav({"golden", "render", "guidance", "h10_rod", "h5_red", "--out", folder.file("out")});
  unsetenv("GALLIUM_OVERRIDE_CPU_CAPS");
  EXPECT_EQ(called.code, 0) << called.err;
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("out"))) {
    files[entry.path().filename().string()] = content_of(entry.path().string());
  }
  EXPECT_EQ(files.size(), 9u);
  return files;
}

// docs/decisions/0027-pictures-to-the-bit.md lists further measurements.
TEST(GoldenCommand, DrawsTheSameBitsWithAVXAloneAndTheSameLabelsWithout) {
  const auto all = drawn_with("");
  const auto avx = drawn_with("avx");
  const auto sse = drawn_with("sse4.1");
  bool differ = false;
  for (const auto& [name, bytes] : all) {
    EXPECT_TRUE(avx.at(name) == bytes) << name;
    if (name.find(".labels.") != std::string::npos) {
      EXPECT_TRUE(sse.at(name) == bytes) << name;
    }
    differ = differ || sse.at(name) != bytes;
  }
  EXPECT_TRUE(differ) << "the twin: without AVX, other code ran";
}

TEST(GoldenCommand, ReviewFindsApprovedScenesAlikeAndChangedOnesNot) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("images"));
  const Called missing = orthonav({"golden", "review", "h5_red", "--out", folder.file("a.html"),
                                   "--dir", folder.file("images")});
  EXPECT_EQ(missing.code, 1) << missing.err;
  EXPECT_THAT(missing.out, HasSubstr("h5_red: "));
  const Called approved =
      orthonav({"golden", "approve", "h5_red", "--why", "first", "--dir", folder.file("images")});
  EXPECT_EQ(approved.code, 0) << approved.err;
  EXPECT_EQ(content_of(folder.file("images/reasons.txt")), "h5_red: first\n");
  const Called alike = orthonav({"golden", "review", "h5_red", "--out", folder.file("b.html"),
                                 "--dir", folder.file("images")});
  EXPECT_EQ(alike.code, 0) << alike.out;
  const std::string page = content_of(folder.file("b.html"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  std::filesystem::copy_file(folder.file("images/h5_red.over.png"),
                             folder.file("images/h5_red.additive.png"),
                             std::filesystem::copy_options::overwrite_existing);
  const Called changed = orthonav({"golden", "review", "h5_red", "--out", folder.file("c.html"),
                                   "--dir", folder.file("images")});
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.out, HasSubstr("h5_red: additive: "));
}

TEST(GoldenCommand, ReviewNamesOrphans) {
  const ScratchFolder folder;
  ASSERT_FALSE(folder.with("old.labels.png", "x").empty());
  const Called called = orthonav(
      {"golden", "review", "h5_red", "--out", folder.file("a.html"), "--dir", folder.file(".")});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(called.out, HasSubstr("old.labels.png belongs to no scene"));
}

TEST(GoldenCommand, RefusesBadArgumentsInOneLine) {
  const ScratchFolder folder;
  const Called unknown = orthonav({"golden", "review", "h99", "--out", folder.file("a.html")});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(unknown.err, "orthonav: no golden scene 'h99'; see: orthonav golden list\n");
  EXPECT_EQ(orthonav({"golden"}).code, 2);
  EXPECT_EQ(orthonav({"golden", "approve", "h5_red"}).code, 2) << "a reason is required";
  const Called empty =
      orthonav({"golden", "approve", "h5_red", "--why", "", "--dir", folder.file(".")});
  EXPECT_EQ(empty.code, 2);
  const Called device =
      orthonav({"golden", "render", "--device", "nothing", "--out", folder.file("o")});
  EXPECT_EQ(device.code, 2);
  EXPECT_THAT(device.err, HasSubstr("no usable Vulkan device named 'nothing'"));
  const Called nowhere =
      orthonav({"golden", "approve", "h5_red", "--why", "x", "--dir", folder.file("no")});
  EXPECT_EQ(nowhere.code, 2);
}

TEST(GoldenCommand, WithoutVulkanSaysSoInOneLine) {
  const ScratchFolder folder;
  for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) {
    setenv(name, "/none.json", 1);
  }
  const Called called = orthonav({"golden", "render", "h5_red", "--out", folder.file("o")});
  for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) {
    unsetenv(name);
  }
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("no Vulkan"));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(folder.file("o"))) << "no half-written image";
}

}  // namespace
}  // namespace orthonav::test::golden_command_test
