#include "hal/hl2ss/standin_message.h"

#include <gmock/gmock.h>

namespace orthonav::hl2ss::parser_test {
namespace {

using ::testing::HasSubstr;

TEST(StandinMessages, ComeBackAsTheyWere) {
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
  std::vector<std::uint8_t> bytes;
  append(bytes, StandinMessage{StandinShown{frame}});
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FALSE(read_standin_message(Bytes(bytes).first(i))->has_value());
  }
  const auto read = read_standin_message(bytes);
  ASSERT_TRUE(read.ok() && *read);
  EXPECT_EQ((*read)->bytes, bytes.size());
  const auto& shown = std::get<StandinShown>((*read)->message).frame;
  EXPECT_EQ(shown.display_time, frame.display_time);
  ASSERT_TRUE(shown.status.has_value());
  EXPECT_EQ(shown.status->at, frame.status->at);
  EXPECT_EQ(shown.status->notice, Notice::kTouchNotRecorded);
  EXPECT_EQ(shown.status->checks, ChecksAsked::kTouchMore);
  EXPECT_EQ(shown.status->text, "guide L4 left");
  EXPECT_EQ(shown.status->heard, "heard: next");
  ASSERT_EQ(shown.holograms.size(), 3u);
  EXPECT_EQ(shown.holograms[0].kind, HologramKind::kEntry);
  EXPECT_EQ(shown.holograms[0].level, "L4");
  EXPECT_EQ(shown.holograms[0].side, orthonav::Side::kRight);
  EXPECT_EQ(shown.holograms[0].text, "L4 right");
  EXPECT_EQ(shown.holograms[0].reading, std::nullopt);
  EXPECT_EQ(shown.holograms[1].reading, 0.25);
  EXPECT_EQ(shown.holograms[1].side, std::nullopt);
  EXPECT_EQ(shown.holograms[2].points_in_world[0].v, (Vec3{1, 2, 3}));
}

TEST(StandinMessages, WithAValueThatNoFrameHasAreRefused) {
  ShownFrame frame;
  frame.status.emplace();
  std::vector<std::uint8_t> bytes;
  append(bytes, StandinMessage{StandinShown{frame}});
  // Behind size, kind, two times and the mark of a status: the step.
  constexpr std::size_t kStepAt = 5 + 16 + 1;
  bytes[kStepAt] = 99;
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("unknown step, 99"));
}

TEST(StandinMessages, OfAnotherServerAreRefused) {
  std::vector<std::uint8_t> bytes;
  append(bytes, std::uint32_t{21});
  bytes.push_back(0);
  bytes.resize(26);
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("no greeting"));
  bytes[4] = 99;
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("unknown message 99"));
}

}  // namespace
}  // namespace orthonav::hl2ss::parser_test
