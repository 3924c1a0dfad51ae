#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/house/rules.h"

namespace orthonav::house {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const fs::path kRoot = ORTHONAV_SOURCE_DIR;

std::vector<fs::path> sources() {
  std::vector<fs::path> found;
  for (const char* folder : {"hal", "nav", "render", "engine", "tools"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(House, IsBuiltByItsRules) {
  const std::vector<fs::path> files = sources();
  ASSERT_GT(files.size(), 100u) << "the sources were not found";
  std::vector<std::string> broken;
  for (const fs::path& file : files)
    for (std::string& line :
         broken_rules(fs::relative(file, kRoot).generic_string(), text_of(file)))
      broken.push_back(std::move(line));
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, WouldNoticeEveryWrongInclude) {
  const auto broken = [](const std::string& path, const std::string& include) {
    return broken_rules(path, "#pragma once\n\n#include " + include + "\n");
  };
  const auto one = ElementsAre(HasSubstr(": "));
  EXPECT_THAT(broken("nav/geometry/mesh.h", "\"engine/session.h\""), one);
  EXPECT_THAT(broken("nav/geometry/mesh.cpp", "\"hal/sim/sim_headset.h\""), one);
  EXPECT_THAT(broken("render/scene.h", "\"hal/api/vec.h\""), one);
  EXPECT_THAT(broken("render/vulkan/device.cpp", "\"nav/geometry/mesh.h\""), one);
  EXPECT_THAT(broken("hal/api/vec.h", "\"nav/geometry/mesh.h\""), one);
  EXPECT_THAT(broken("hal/sim/surgeon.cpp", "\"nav/guidance/screw.h\""), one);
  EXPECT_THAT(broken("hal/replay/replay.cpp", "\"hal/sim/sim_headset.h\""), one);
  EXPECT_THAT(broken("engine/session.cpp", "\"tools/command.h\""), one);
  EXPECT_THAT(broken("engine/session.cpp", "\"hal/sim/truth.h\""), one);
  EXPECT_THAT(broken("tools/demo_command.cpp", "\"hal/sim/truth.h\""), one);
  EXPECT_THAT(broken("engine/scene_builder.cpp", "<vulkan/vulkan.h>"), one);
  EXPECT_THAT(broken("engine/scene_builder.h", "<glm/glm.hpp>"), one);
  EXPECT_THAT(broken("nav/tracking/tag_pose.h", "<Eigen/Core>"), one);
  EXPECT_THAT(broken("nav/tracking/marker_detector.h", "<apriltag/apriltag.h>"), one);
  EXPECT_THAT(broken("nav/tracking/marker_detector.h", "<opencv2/core.hpp>"), one);
  EXPECT_THAT(broken("engine/plan_file.h", "<nlohmann/json.hpp>"), one);
}

TEST(House, LetsTheRightIncludesPass) {
  const auto broken = [](const std::string& path, const std::string& include) {
    return broken_rules(path, "#include " + include + "\n");
  };
  EXPECT_THAT(broken("nav/geometry/mesh.h", "\"hal/api/vec.h\""), IsEmpty());
  EXPECT_THAT(broken("nav/tracking/tag_pose.cpp", "<Eigen/Core>"), IsEmpty());
  EXPECT_THAT(broken("engine/evaluation.cpp", "\"hal/sim/truth.h\""), IsEmpty());
  EXPECT_THAT(broken("engine/plan_file.cpp", "<nlohmann/json.hpp>"), IsEmpty());
  EXPECT_THAT(broken("render/vulkan/device.h", "<vulkan/vulkan.h>"), IsEmpty());
  EXPECT_THAT(broken("hal/open/open.cpp", "\"hal/replay/replay.h\""), IsEmpty());
}

TEST(House, WouldNoticeAFileThatGrewTooLong) {
  std::string text;
  for (int line = 0; line < 300; ++line) text += "\n";
  EXPECT_THAT(broken_rules("nav/geometry/mesh.cpp", text), IsEmpty());
  EXPECT_THAT(broken_rules("nav/geometry/mesh.cpp", text + "\n"),
              ElementsAre(HasSubstr("301 lines, limit 300")));
}

}  // namespace
}  // namespace orthonav::house
