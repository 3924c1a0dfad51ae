#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/io/image_file.h"

namespace orthonav::preview {

namespace fs = std::filesystem;

/// A shell script run with a display of its own, in an empty folder. Its models are prepared once
/// for all.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* needed : {"Xvfb", "xdotool"}) {
      if (std::system((std::string("command -v ") + needed + " >/dev/null").c_str()) != 0) {
        GTEST_SKIP() << "needs " << needed << " (tools/setup installs it)";
      }
    }
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("preview-") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) {
      fs::remove_all(folder_);
    }
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
  /// Returns the exit code. `$preview` is the command with a hasty surgeon in a perfect world,
  /// `$server` the X server, which chooses a free display number.
  int shell(const std::string& commands) const {
    write("commands", "cd '" + folder_.string() +
                          R"('
mkfifo number
Xvfb -displayfd 3 -screen 0 1600x1000x24 -nolisten tcp 3>number >/dev/null 2>&1 & server=$!
trap 'code=$?; kill $server 2>/dev/null; exit $code' EXIT
read display <number
export DISPLAY=:$display
window=')" ORTHONAV_COMMAND
                          R"( preview --levels L5 --size 640x360 --out .'
preview="$window --perfect --pace 4"
plan="$window --plan"
unset window
)" + commands);
    const int status = std::system(("timeout -k 5 120 sh '" + (folder_ / "commands").string() +
                                    "' >'" + (folder_ / "out").string() + "' 2>&1")
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  RgbaImage picture(const std::string& name) const {
    auto image = engine::read_png(folder_ / name);
    EXPECT_TRUE(image.ok()) << (image ? "" : image.error().message) << content("out");
    return image ? *image : RgbaImage{};
  }

  fs::path folder_;
};

/// How many pixels differ visibly; all of them if the sizes differ.
inline std::size_t different(const RgbaImage& a, const RgbaImage& b) {
  if (a.pixels.size() != b.pixels.size()) {
    return std::max(a.pixels.size(), b.pixels.size()) / 4;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(int{a.pixels[i + c]} - int{b.pixels[i + c]}));
    }
    count += most > 16 ? 1 : 0;
  }
  return count;
}

/// Pixels close to a colour; sRGB.
inline std::size_t coloured(const RgbaImage& image, const std::array<int, 3>& colour) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(int{image.pixels[i + c]} - colour[c]));
    }
    count += most < 40 ? 1 : 0;
  }
  return count;
}

/// Commands for a window with real keys: `begin` waits for its first picture, `there` for a file.
inline constexpr const char* kRealKeys = R"(
begin() {
  "$@" & pid=$!
  window=$(timeout 60 xdotool search --sync --onlyvisible --name 'orthonav preview: ' | head -1)
  xdotool windowfocus --sync $window
}
there() { for i in $(seq 600); do [ -s "$1" ] && return; sleep 0.1; done; echo "no $1"; exit 9; }
)";

}  // namespace orthonav::preview
