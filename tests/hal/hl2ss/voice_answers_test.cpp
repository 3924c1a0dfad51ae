#include "hal/hl2ss/voice.h"

#include <gmock/gmock.h>

namespace orthonav::hl2ss::parser_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(VoiceAnswers, ComeWhole) {
  const std::vector<VoiceResult> results = {{2, 0, 5, 6, 0.9}, {9, 3, 7, 8, 0.1}};
  const auto bytes = voice_answer_bytes(results);
  ASSERT_EQ(bytes.size(), 4u + 2 * 32);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FALSE(read_voice_answer(Bytes(bytes).first(i))->has_value());
  }
  const auto read = read_voice_answer(bytes);
  ASSERT_TRUE(read.ok() && *read);
  EXPECT_EQ((*read)->bytes, bytes.size());
  EXPECT_EQ((*read)->results[1].index, 9u);
  EXPECT_EQ((*read)->results[1].start, 8u);
}

TEST(VoiceAnswers, WithTooManyOrUnknownResultsAreRefused) {
  std::vector<std::uint8_t> bytes;
  append(bytes, std::uint32_t{0xffffffff});
  EXPECT_THAT(read_voice_answer(bytes).error().message, HasSubstr("4294967295 results, limit 64"));
  EXPECT_THAT(read_voice_answer(voice_answer_bytes({{0, 4, 0, 0, 0.0}})).error().message,
              HasSubstr("confidence 4"));
}

TEST(VoiceAnswers, HaveConfidencesAsPhrasesDo) {
  std::vector<double> confidences;
  for (const std::uint32_t confidence : {0u, 1u, 2u, 3u}) {
    confidences.push_back(VoiceResult{0, confidence}.confidence_of_phrase());
  }
  EXPECT_THAT(confidences, ElementsAre(0.9, 0.6, 0.3, 0.0));
}

}  // namespace
}  // namespace orthonav::hl2ss::parser_test
