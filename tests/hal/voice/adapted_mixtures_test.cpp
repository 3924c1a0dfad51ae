#include "hal/voice/adapted_mixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "hal/voice/model_bytes.h"
#include "hal/voice/phrase_recognizer.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::voice {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

constexpr int kStreams = 2, kDensities = 3, kSenones = 5;

MixtureWeights some_weights(std::uint64_t seed) {
  MixtureWeights weights{kStreams, kDensities, kSenones, "", ""};
  for (const char* text : {"feature_count 2", "cluster_count 0"}) {
    put(weights.header, static_cast<std::int32_t>(std::string(text).size() + 1));
    weights.header += std::string(text) + '\0';
  }
  for (const std::int32_t number : {0, kDensities, kSenones}) {
    put(weights.header, number);
  }
  Random random(seed);
  for (int i = 0; i < kStreams * kDensities * kSenones; ++i) {
    weights.values += static_cast<char>(160.0 * random.uniform());
  }
  return weights;
}

TEST(AdaptedMixtures, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  const MixtureWeights weights = some_weights(1);
  const auto read = read_mixture_weights(folder.with("sendump", mixture_weights_file(weights)));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->streams, kStreams);
  EXPECT_EQ(read->densities, kDensities);
  EXPECT_EQ(read->senones, kSenones);
  EXPECT_EQ(read->header, weights.header);
  EXPECT_EQ(read->values, weights.values);
}

TEST(AdaptedMixtures, OfTheModelAreShares) {
  const auto read = read_mixture_weights(default_acoustic_model() / "sendump");
  ASSERT_TRUE(read.ok()) << read.error().message;
  for (const int senone : {0, 17, read->senones - 1}) {
    for (int stream = 0; stream < read->streams; ++stream) {
      double sum = 0.0;
      for (int density = 0; density < read->densities; ++density) {
        sum +=
            fraction_of(static_cast<std::uint8_t>(read->values[read->at(stream, density, senone)]));
      }
      EXPECT_NEAR(sum, 1.0, 0.06) << senone;  // a step is a tenth of a share
    }
  }
}

TEST(AdaptedMixtures, AreRefusedWhereTheFileIsAnother) {
  const TemporaryFolder folder;
  const std::string file = mixture_weights_file(some_weights(1));
  std::string negative = file;
  negative[3] = '\x80';
  std::string huge = file;
  huge[3] = '\x7f';
  for (const std::string& bytes : {std::string(), std::string("s3\n"), file.substr(0, 30),
                                   file.substr(0, file.size() - 1), file + "x", negative, huge}) {
    EXPECT_FALSE(read_mixture_weights(folder.with("sendump", bytes)).ok());
  }
  EXPECT_FALSE(read_mixture_weights(folder.file("absent")).ok());
}

TEST(AdaptedMixtures, AreReachedByTheirChangeWhichHoldsWhatDiffers) {
  const MixtureWeights from = some_weights(1);
  MixtureWeights to = from;
  to.values[to.at(1, 2, 3)] = 7;
  to.values[to.at(0, 0, 4)] = 9;
  MixtureWeights changed = from;
  const std::string change = mixture_weights_change(from, to);
  ASSERT_TRUE(apply_change(change, changed).ok());
  EXPECT_EQ(changed.values, to.values);
  const std::size_t none = mixture_weights_change(from, from).size();
  EXPECT_EQ(change.size(), none + 2 * (4 + kStreams * kDensities));
}

TEST(AdaptedMixtures, StayAsTheyAreUnderAChangeThatIsNotTheirs) {
  const MixtureWeights from = some_weights(1);
  MixtureWeights to = from;
  to.values[to.at(1, 2, 3)] = 7;
  const std::string change = mixture_weights_change(from, to);
  MixtureWeights others = some_weights(3);
  const Status applied = apply_change(change, others);
  ASSERT_FALSE(applied.ok());
  EXPECT_THAT(applied.error().message, HasSubstr("not the one"));
  EXPECT_EQ(others.values, some_weights(3).values);
  std::string beyond = change;
  beyond[change.size() - kStreams * kDensities - 4] = kSenones;
  MixtureWeights same = from;
  for (const std::string& bad : {std::string(), change.substr(0, change.size() - 1), beyond}) {
    EXPECT_FALSE(apply_change(bad, same).ok());
    EXPECT_EQ(same.values, from.values);
  }
}

TEST(AdaptedMixtures, KeepSharesWithinHalfAStep) {
  for (const double fraction : {1.0, 0.3, 0.01, 1e-5}) {
    EXPECT_NEAR(fraction_of(quantised_weight(fraction)) / fraction, 1.0, 0.053) << fraction;
  }
  EXPECT_EQ(quantised_weight(0.0), quantised_weight(1e-7));
}

}  // namespace
}  // namespace orthonav::voice
