#include <gmock/gmock.h>

#include <limits>

#include "hal/sim/surgeon/surgeon.h"
#include "tests/hal/sim/hovering_headset.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim::sim_headset_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(RoomDescription room, SimOptions options = hovering()) {
  const auto headset = SimHeadset::open(std::move(room), options);
  return headset.ok() ? "accepted" : headset.error().message;
}

TEST(SimHeadset, RefusesWhatMakesNoSenseInOneLine) {
  RoomDescription room = synthetic_case().room;
  EXPECT_EQ(refusal(room), "accepted");
  SimOptions options = hovering();
  options.error_model.tremor_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(room, options), HasSubstr("tremor_m"));
  options = hovering();
  options.frame_rate_hz = 0.0;
  EXPECT_THAT(refusal(room, options), HasSubstr("frame rate is 0"));
  options = hovering();
  options.limit_s = -1.0;
  EXPECT_THAT(refusal(room, options), HasSubstr("time limit is -1"));
  options = hovering();
  options.frame_rate_hz = 200.0;
  options.error_model.exposure_s = 0.02;
  EXPECT_THAT(refusal(room, options), HasSubstr("longer than a frame"));
  options = hovering();
  for (const double factor : {0.0, 10.1, std::numeric_limits<double>::quiet_NaN()}) {
    options.told_sd_factor = factor;
    EXPECT_THAT(refusal(room, options), HasSubstr("must lie in [0.1, 10]")) << factor;
  }
  options.told_sd_factor = 10.0;
  EXPECT_EQ(refusal(room, options), "accepted");
}

TEST(SimHeadset, RefusesBrokenRooms) {
  const RoomDescription good = synthetic_case().room;
  RoomDescription room = good;
  room.levels[1].label = "L4";
  EXPECT_THAT(refusal(room), HasSubstr("\"L4\": label is given twice"));
  room = good;
  room.levels[0].triangles[5][1] = 1'000'000;
  EXPECT_THAT(refusal(room), HasSubstr("vertex 1000000"));
  room = good;
  room.levels[0].vertices_m[3].y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(room), HasSubstr("not finite"));
  room = good;
  room.levels[0].triangles.clear();
  EXPECT_THAT(refusal(room), HasSubstr("no triangles"));
  room = good;
  room.operated = {"L9"};
  EXPECT_THAT(refusal(room), HasSubstr("\"L9\" does not exist"));
  room = good;
  room.tools[1].id = room.tools[0].id;
  EXPECT_THAT(refusal(room), HasSubstr("given twice"));
  room = good;
  room.tools[1].family = "tag99h9";
  EXPECT_THAT(refusal(room),
              AllOf(HasSubstr("\"guide\": unknown tag family \"tag99h9\""),
                    HasSubstr("tag36h11, tag36h10, tag25h9, tag16h5, tagStandard41h12")));
  room = good;
  room.tools[1].id = 587;
  EXPECT_THAT(refusal(room), HasSubstr("tag id is 587, tag36h11 has 0 to 586"));
  room.tools[1].id = -1;
  EXPECT_THAT(refusal(room), HasSubstr("tag id is -1"));
  room.tools[1].id = 586;
  EXPECT_EQ(refusal(room), "accepted");
  room = good;
  room.tools[0].axis_in_marker = {};
  EXPECT_THAT(refusal(room), HasSubstr("axis has length 0"));
  room = good;
  room.tools.pop_back();
  EXPECT_EQ(refusal(room), "accepted");
  SimOptions surgery = hovering();
  surgery.surgeon = [](const Workplace&) { return std::unique_ptr<Surgeon>(); };
  EXPECT_THAT(refusal(room, surgery), HasSubstr("no guide"));
  room.phrases.next.clear();
  EXPECT_THAT(refusal(room, surgery), HasSubstr("lacks a phrase to say"));
}

}  // namespace
}  // namespace orthonav::sim::sim_headset_test
