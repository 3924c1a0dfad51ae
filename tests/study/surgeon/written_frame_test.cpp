#include "study/surgeon/written_frame.h"

#include <gmock/gmock.h>

namespace orthonav::sim::written_frame_test {
namespace {

using engine::ChecksAsked;
using engine::HologramKind;
using engine::Notice;
using engine::ShownFrame;
using engine::ShownStatus;
using engine::Step;
using ::testing::HasSubstr;

ShownFrame guiding() {
  ShownFrame frame;
  frame.display_time = Timestamp(Duration(12));
  frame.pose_time = Timestamp(Duration(-5));
  frame.status = ShownStatus{{Step::kGuide, "L4", orthonav::Side::kLeft},
                             Notice::kTouchNotRecorded,
                             ChecksAsked::kTouchMore,
                             true,
                             "guide L4 left",
                             "heard: next"};
  frame.holograms = {{.kind = HologramKind::kEntry,
                      .level = "L4",
                      .side = orthonav::Side::kRight,
                      .text = "L4 right"},
                     {.kind = HologramKind::kAngle, .reading = 0.25},
                     {.kind = HologramKind::kRod, .points_in_world = {{{1, 2, 3}}}}};
  return frame;
}

TEST(WrittenFrame, IsReadAsItWas) {
  const ShownFrame frame = guiding();
  const auto shown = shown_in(written(frame));
  ASSERT_TRUE(shown.ok()) << shown.error().message;
  EXPECT_EQ(shown->display_time, frame.display_time);
  EXPECT_EQ(shown->pose_time, frame.pose_time);
  ASSERT_TRUE(shown->status.has_value());
  EXPECT_EQ(shown->status->at, frame.status->at);
  EXPECT_EQ(shown->status->notice, Notice::kTouchNotRecorded);
  EXPECT_EQ(shown->status->checks, ChecksAsked::kTouchMore);
  EXPECT_TRUE(shown->status->strokes_enough);
  EXPECT_EQ(shown->status->text, "guide L4 left");
  EXPECT_EQ(shown->status->heard, "heard: next");
  ASSERT_EQ(shown->holograms.size(), 3u);
  EXPECT_EQ(shown->holograms[0].kind, HologramKind::kEntry);
  EXPECT_EQ(shown->holograms[0].level, "L4");
  EXPECT_EQ(shown->holograms[0].side, orthonav::Side::kRight);
  EXPECT_EQ(shown->holograms[0].text, "L4 right");
  EXPECT_EQ(shown->holograms[0].reading, std::nullopt);
  EXPECT_EQ(shown->holograms[1].reading, 0.25);
  EXPECT_EQ(shown->holograms[1].side, std::nullopt);
  EXPECT_EQ(shown->holograms[2].points_in_world[0].v, (Vec3{1, 2, 3}));
}

TEST(WrittenFrame, IsReadInTheWorldOfTheWearer) {
  WornFrame frame = written(guiding());
  frame.wearer_from_drawn = {Mat3::identity(), {10, 0, 0}};
  EXPECT_EQ(shown_in(frame)->holograms[2].points_in_world[0].v, (Vec3{11, 2, 3}));
}

TEST(WrittenFrame, WithAValueThatNoneHasIsRefused) {
  WornFrame frame = written(guiding());
  // Behind a time and the mark of a status: the step.
  constexpr std::size_t kStepAt = 8 + 1;
  frame.content[kStepAt] = 99;
  EXPECT_THAT(shown_in(frame).error().message, HasSubstr("unknown step, 99"));
}

TEST(WrittenFrame, OfAnotherLengthIsRefused) {
  WornFrame frame = written(guiding());
  const std::vector<std::uint8_t> whole = frame.content;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    frame.content.resize(size);
    EXPECT_FALSE(shown_in(frame).ok()) << size;
    frame.content = whole;
  }
  frame.content.push_back(0);
  EXPECT_THAT(shown_in(frame).error().message, HasSubstr("do not fit"));
}

}  // namespace
}  // namespace orthonav::sim::written_frame_test
