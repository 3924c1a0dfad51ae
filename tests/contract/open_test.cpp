#include "hal/open/open.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace orthonav {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal(const std::string& uri) {
  const auto headset = open_headset(uri);
  return headset.ok() ? "accepted" : headset.error().message;
}

/// A short simulated time is enough here.
OpenOptions brief() {
  OpenOptions options;
  options.sim.limit_s = 0.2;
  return options;
}

GreyImage first_image(const std::string& uri) {
  auto headset = open_headset(uri, brief());
  EXPECT_TRUE(headset.ok()) << uri << ": " << headset.error().message;
  StereoFrame frame;
  if (!headset) {
    return {};
  }
  const auto answer = (*headset)->cameras()->next(frame);
  EXPECT_TRUE(answer.ok() && *answer == Next::kFrame);
  return frame.left;
}

TEST(OpenHeadset, NamesWhatItKnowsWhenItKnowsNothingOfAUri) {
  for (const char* uri : {"kinect:", "sim", "", "Sim:", "http://host/"}) {
    EXPECT_THAT(refusal(uri),
                AllOf(HasSubstr("known are sim:, replay:PATH, hl2ss://HOST"),
                      HasSubstr("openxr:+URI"), HasSubstr(uri), Not(HasSubstr("\n"))));
  }
}

TEST(RegisteredScheme, IsOpenedCheckedAndNamedLikeTheOthers) {
  const auto check = [](const std::string& rest) {
    return rest == "1" ? Status{} : Status(Error{"must be 1"});
  };
  std::vector<std::string> asked;
  const auto open = [&asked](const std::string&,
                             const std::vector<std::string>& phrases) -> Result<OpenedDevice> {
    asked = phrases;
    return OpenedDevice{*open_headset("sim:?perfect", brief()), "its lid is open"};
  };
  EXPECT_FALSE(register_scheme({"sim", "", nullptr, open}).ok()) << "is ours";
  EXPECT_FALSE(register_scheme({"Mine", "", nullptr, open}).ok()) << "capital letter";
  EXPECT_FALSE(register_scheme({"mine", "", nullptr, nullptr}).ok()) << "nothing opens it";
  ASSERT_TRUE(register_scheme({"mine", "mine:N", check, open}).ok());
  EXPECT_FALSE(register_scheme({"mine", "", nullptr, open}).ok()) << "is taken";
  EXPECT_THAT(refusal("mine:2"), HasSubstr("headset URI \"mine:2\": must be 1"));
  EXPECT_THAT(refusal("yours:"), HasSubstr("openxr:+URI and mine:N"));
  EXPECT_FALSE(first_image("mine:1").pixels.empty());
  OpenOptions options;
  options.phrases = {"ortho accept"};
  for (const char* uri : {"mine:1", "openxr:?rig=RIG+mine:1"}) {
    const test::TemporaryFolder folder;
    std::string text = uri;
    if (const auto rig = text.find("RIG"); rig != std::string::npos) {
      text.replace(rig, 3, folder.with("rig.json", R"({"view_from_rig":
          [[1,0,0,-50],[0,1,0,10],[0,0,1,-30],[0,0,0,1]]})"));
    }
    asked.clear();
    const auto opened = open_with_room(text, options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    EXPECT_EQ(asked, options.phrases) << text;
    EXPECT_EQ(opened->warning, "its lid is open") << text;
  }
}

TEST(OpenHeadset, KnowsTrackersOverOpenIgtLink) {
  EXPECT_THAT(refusal("igtl://host?"), HasSubstr("headset URI \"igtl://host?\": "));
  EXPECT_THAT(check_headset_uri("igtl://host?pointer=StylusToTracker").ok(), true);
}

TEST(OpenHeadset, NamesTheKnownKeys) {
  EXPECT_THAT(refusal("sim:?sead=3"),
              AllOf(HasSubstr("\"sead\""), HasSubstr("seed=N, perfect, realtime and depth")));
  EXPECT_THAT(refusal("sim:seed=3"), HasSubstr("?key=value"));
  EXPECT_THAT(refusal("sim:?perfect=1"), HasSubstr("takes no value"));
  EXPECT_THAT(refusal("sim:?seed=1&seed=2"), HasSubstr("twice"));
  EXPECT_THAT(refusal("sim:?&"), HasSubstr("unknown key \"\""));
}

TEST(OpenHeadset, TakesWholeSeedsOnly) {
  for (const char* seed : {"", "-1", "1.5", "0x10", "three", "18446744073709551616", " 1", "1 "}) {
    EXPECT_THAT(refusal(std::string("sim:?seed=") + seed), HasSubstr("not a whole number")) << seed;
  }
}

TEST(OpenHeadset, WantsCamerasForAnOpenxrHeadset) {
  EXPECT_THAT(refusal("openxr:+"), HasSubstr("openxr:+sim:"));
  EXPECT_THAT(refusal("openxr:+openxr:+sim:"), HasSubstr("can't be another one's"));
  EXPECT_THAT(refusal("openxr:+sim:?sead=3"), HasSubstr("\"sead\""));
  EXPECT_THAT(refusal("openxr:?rug=x+sim:"), HasSubstr("known is rig=FILE"));
}

TEST(OpenHeadset, WantsARigOfCamerasOnTheHead) {
  EXPECT_THAT(refusal("openxr:+hl2ss://host"), HasSubstr("need rig=FILE"));
  EXPECT_THAT(refusal("openxr:?rig=/nowhere.json+sim:"), HasSubstr("/nowhere.json: can't be read"));
}

TEST(OpenHeadset, ChecksTheRigFile) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    const std::string path = (folder.path() / "rig.json").string();
    std::ofstream(path) << text;
    return refusal("openxr:?rig=" + path + "+sim:");
  };
  EXPECT_EQ(refused(R"({"view_from_rig": [[1,0,0,-50],[0,1,0,10],[0,0,1,-30],[0,0,0,1]]})"),
            "accepted");
  EXPECT_THAT(refused("{"), HasSubstr("is not JSON"));
  EXPECT_THAT(refused("[]"), HasSubstr("four rows of four numbers"));
  EXPECT_THAT(refused(R"({"view_from_rig": [[1,0,0],[0,1,0],[0,0,1],[0,0,0]]})"),
              HasSubstr("four rows of four numbers"));
  EXPECT_THAT(refused(R"({"view_from_rig": [[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})"),
              HasSubstr("mirror"));
  EXPECT_THAT(refused(R"({"view_from_rig": [[1,0,0,2000],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})"),
              HasSubstr("limit 1000"));
  EXPECT_THAT(refused(R"({"view_from_rig": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]})"),
              HasSubstr("0 0 0 1"));
}

TEST(OpenHeadset, PassesOnWhyARecordingCannotBeOpened) {
  EXPECT_THAT(refusal("replay:/nowhere/at/all"), HasSubstr("/nowhere/at/all"));
  EXPECT_THAT(refusal("replay:"), HasSubstr("names no folder"));
  EXPECT_THAT(refusal("replay:?pace=fast"), HasSubstr("names no folder"));
  EXPECT_THAT(refusal("replay:/x?pace=slow"), HasSubstr("known are fast, realtime and step"));
  EXPECT_THAT(refusal("replay:/nowhere?pace=step"), HasSubstr("/nowhere: no such recording"));
  for (const char* keys : {"?stamps=exact", "?pace=fast&stamps=exact", "?stamps=recorder"}) {
    EXPECT_THAT(refusal(std::string("replay:/nowhere") + keys),
                HasSubstr("/nowhere: no such recording"));
  }
  EXPECT_THAT(refusal("replay:/x?stamps=late"), HasSubstr("known are pace=fast"));
}

TEST(OpenHeadset, SeedsTheSimulation) {
  const GreyImage three = first_image("sim:?seed=3");
  EXPECT_TRUE(first_image("sim:?seed=3") == three);
  EXPECT_FALSE(first_image("sim:?seed=4") == three);
  EXPECT_FALSE(first_image("sim:?seed=3&perfect") == three);
}

}  // namespace
}  // namespace orthonav
