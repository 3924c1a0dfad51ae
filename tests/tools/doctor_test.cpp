#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/command_line.h"

namespace orthonav::test::doctor_test {
namespace {

using ::testing::HasSubstr;

/// An environment variable for the processes that a test starts.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { ::unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

/// What doctor says of the first offer with this name.
nlohmann::json offer(const Called& called, const std::string& name) {
  const nlohmann::json out = nlohmann::json::parse(called.out, nullptr, false);
  EXPECT_FALSE(out.is_discarded()) << called.out;
  for (const auto& entry : out["offers"]) {
    if (entry["name"] == name) {
      return entry;
    }
  }
  ADD_FAILURE() << "says nothing of " << name << ":\n" << called.out;
  return {};
}

TEST(Doctor, FindsWhatTheDemoNeeds) {
  const Called called = orthonav({"doctor", "--json"});
  EXPECT_EQ(called.code, 0) << called.out << called.err;
  EXPECT_EQ(offer(called, "Vulkan device")["finding"], "found");
  EXPECT_EQ(offer(called, "H.264 encoder")["finding"], "found");
  EXPECT_EQ(offer(called, "Case")["what"], "built-in phantom: L1 L2 L3 L4 L5");
  EXPECT_EQ(called.err, "") << "results on standard output, and nothing else happened";
}

TEST(Doctor, SaysTheSameInWords) {
  const Called called = orthonav({"doctor"});
  EXPECT_EQ(called.code, 0);
  EXPECT_THAT(called.out, HasSubstr("found    Vulkan device"));
  EXPECT_THAT(called.out, HasSubstr("Everything that the demo needs is here."));
}

TEST(Doctor, AnswersNoWithoutAVulkanDevice) {
  const Environment icd("VK_ICD_FILENAMES", "/nowhere.json");
  const Environment drivers("VK_DRIVER_FILES", "/nowhere.json");
  const Called called = orthonav({"doctor", "--json"});
  EXPECT_EQ(called.code, 1);
  const nlohmann::json device = offer(called, "Vulkan device");
  EXPECT_EQ(device["finding"], "missing");
  EXPECT_THAT(device["how_to_get_it"].get<std::string>(), HasSubstr("mesa-vulkan-drivers"));
}

TEST(Doctor, FindsMicrophoneClickerAndRuntimeWhereTheKernelListsThem) {
  const ScratchFolder root;
  for (const char* folder : {"proc/asound", "proc/bus/input", "dev/input", "etc/xdg/openxr/1"}) {
    std::filesystem::create_directories(root.file(folder));
  }
  std::ignore = root.with("proc/asound/pcm", "00-00: ALC : ALC : playback 1 : capture 1\n");
  std::ignore = root.with("proc/bus/input/devices",
                          "I: Bus=0005\nN: Name=\"Clicker 2\"\nH: Handlers=sysrq kbd event7\n\n"
                          "I: Bus=0003\nN: Name=\"A mouse\"\nH: Handlers=mouse0 event3\n");
  std::ignore = root.with("dev/input/event7", "");
  std::ignore = root.with("etc/xdg/openxr/1/active_runtime.json", "{}");
  const std::string model = "usr/share/pocketsphinx/model/en-us/en-us";
  std::filesystem::create_directories(root.file(model));
  std::ignore = root.with(model + "/mdef", "");
  const Called called = orthonav({"doctor", "--json", "--root", root.file("")});
  EXPECT_EQ(offer(called, "Microphone")["finding"], "found");
  EXPECT_EQ(offer(called, "Voice model")["finding"], "found");
  EXPECT_EQ(offer(called, "Clicker or keyboard")["finding"], "found");
  EXPECT_THAT(offer(called, "Clicker or keyboard")["what"].get<std::string>(),
              HasSubstr("Clicker 2"));
  EXPECT_THAT(offer(called, "OpenXR runtime")["what"].get<std::string>(),
              HasSubstr("active_runtime.json"));
}

TEST(Doctor, SaysHowToGetWhatIsAbsent) {
  const ScratchFolder root;
  const Called called = orthonav({"doctor", "--json", "--root", root.file("")});
  for (const char* name : {"Vulkan validation layer", "Microphone", "Voice model",
                           "Clicker or keyboard", "OpenXR runtime"}) {
    EXPECT_EQ(offer(called, name)["finding"], "absent") << name;
    const nlohmann::json how = offer(called, name).value("how_to_get_it", nlohmann::json());
    EXPECT_TRUE(how.is_string() && !how.get<std::string>().empty()) << name << ": " << how;
  }
  EXPECT_EQ(called.code, 0) << "none of these is needed by the demo";
}

TEST(Doctor, AnswersNoWhereTheHeadsetsCamerasDoNotAnswer) {
  const Called called = orthonav({"doctor", "--headset", "hl2ss://127.0.0.1?port=1"});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(called.out, HasSubstr("missing  HoloLens 2: left camera"));
  EXPECT_THAT(called.err, HasSubstr("cameras do not answer"));
}

TEST(Doctor, RefusesArgumentsItDoesNotKnow) { EXPECT_EQ(orthonav({"doctor", "--fix"}).code, 2); }

}  // namespace
}  // namespace orthonav::test::doctor_test
