#include "hal/voice/adapted_means.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::voice {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

AcousticMeans some_means(std::uint64_t seed) {
  AcousticMeans means{4, {3, 2}, 8, {}};
  Random random(seed);
  means.values.resize(std::size_t{4} * 8 * 5);
  for (float& value : means.values) {
    value = static_cast<float>(random.normal(1.0, 2.0));
  }
  return means;
}

TEST(AdaptedMeans, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  const AcousticMeans means = some_means(1);
  const auto read = read_means(folder.with("means", means_file(means)));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->codebooks, means.codebooks);
  EXPECT_EQ(read->densities, means.densities);
  EXPECT_EQ(read->stream_widths, means.stream_widths);
  EXPECT_EQ(read->values, means.values);
}

TEST(AdaptedMeans, AreRefusedWhereTheFileIsAnother) {
  const TemporaryFolder folder;
  const std::string file = means_file(some_means(1));
  for (const std::string& bytes :
       {std::string(), std::string("s3\n"), file.substr(0, 30), file.substr(0, file.size() - 1)}) {
    EXPECT_FALSE(read_means(folder.with("means", bytes)).ok());
  }
  EXPECT_FALSE(read_means(folder.file("absent")).ok());
}

TEST(AdaptedMeans, AreReachedByTheirChange) {
  const AcousticMeans from = some_means(1);
  AcousticMeans to = from;
  Random random(2);
  for (float& value : to.values) {
    value += static_cast<float>(random.normal(0.0, 1.0));
  }
  AcousticMeans changed = from;
  ASSERT_TRUE(apply_change(means_change(from, to), changed).ok());
  // Half a step, of a spread that is drawn about 2.
  for (std::size_t i = 0; i < to.values.size(); ++i) {
    EXPECT_NEAR(changed.values[i], to.values[i], 0.5 * kStepOfSpread * 3.0);
  }
}

TEST(AdaptedMeans, RefuseAChangeThatWasMadeForOthers) {
  const AcousticMeans from = some_means(1);
  AcousticMeans others = some_means(3);
  const Status applied = apply_change(means_change(from, from), others);
  ASSERT_FALSE(applied.ok());
  EXPECT_THAT(applied.error().message, HasSubstr("not the one"));
  EXPECT_FALSE(apply_change("", others).ok());
}

}  // namespace
}  // namespace orthonav::voice
