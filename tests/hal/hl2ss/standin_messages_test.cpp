#include "hal/hl2ss/standin_message.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace orthonav::hl2ss::parser_test {
namespace {

using ::testing::HasSubstr;

TEST(StandinMessages, ComeBackAsTheyWere) {
  WornFrame frame;
  frame.display_time = Timestamp(Duration(12));
  frame.wearer_from_drawn = {rotation_from_vector({0.1, -0.2, 0.3}), {1.0, 2.0, -3.0}};
  frame.content = {7, 0, 255};
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
  EXPECT_EQ(shown.wearer_from_drawn, frame.wearer_from_drawn);
  EXPECT_EQ(shown.content, frame.content);
}

TEST(StandinMessages, OfAFrameInNoWorldAreRefused) {
  std::vector<std::uint8_t> bytes;
  append(bytes, StandinMessage{StandinShown{}});
  // Behind size, kind and time: the transform, of which nothing is left.
  std::fill(bytes.begin() + 13, bytes.end(), std::uint8_t{0});
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("not rigid"));
}

TEST(StandinMessages, OfAFrameCutShortAreRefused) {
  std::vector<std::uint8_t> bytes;
  append(bytes, std::uint32_t{20});
  bytes.push_back(4);
  bytes.resize(25);
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("does not fit"));
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
