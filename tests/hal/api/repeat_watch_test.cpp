#include <gtest/gtest.h>

#include "hal/api/repeat_watch.h"
#include "tests/support/scripted_session.h"

namespace orthonav {
namespace {

using test::scripted_image;
using test::scripted_pose;

constexpr MayRepeat kSensors{};

class Repeats : public ::testing::Test {
 protected:
  /// The next pair, by the numbers of its pictures and of its pose.
  std::optional<Repeated> pair(int left, int right, int pose, MayRepeat may = kSensors) {
    return watch_.look(scripted_image(static_cast<std::uint64_t>(left)),
                       scripted_image(static_cast<std::uint64_t>(1000 + right)),
                       scripted_pose(pose), may, std::nullopt);
  }
  RepeatWatch watch_;
};

TEST_F(Repeats, NothingOfASensorThatWorks) {
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(pair(i, i, i), std::nullopt) << i;
  }
}

TEST_F(Repeats, OneGreyValueOfOnePixelIsAnotherPicture) {
  GreyImage picture = scripted_image(1);
  EXPECT_EQ(watch_.look(picture, scripted_image(2), scripted_pose(0), kSensors, std::nullopt),
            std::nullopt);
  for (const std::size_t pixel : {std::size_t{0}, std::size_t{100'001}, std::size_t{307'199}}) {
    picture.pixels[pixel] ^= 1U;
    EXPECT_EQ(watch_.look(picture, scripted_image(pixel + 3),
                          scripted_pose(static_cast<int>(pixel) + 1), kSensors, std::nullopt),
              std::nullopt);
  }
}

TEST_F(Repeats, APictureOfEitherCameraOrOfBoth) {
  EXPECT_EQ(pair(0, 0, 0), std::nullopt);
  EXPECT_EQ(pair(0, 1, 1), Repeated::kLeftPicture);
  EXPECT_EQ(pair(2, 1, 2), Repeated::kRightPicture);
  EXPECT_EQ(pair(2, 1, 3), Repeated::kBothPictures);
}

TEST_F(Repeats, AFewOldPicturesOverAndOver) {
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(pair(i, i, i), std::nullopt);
  }
  for (int i = 4; i < 40; ++i) {
    EXPECT_EQ(pair(i % 4, i % 4, i), Repeated::kBothPictures) << i;
  }
}

TEST_F(Repeats, ThePoseWhilePicturesChange) {
  EXPECT_EQ(pair(0, 0, 0), std::nullopt);
  EXPECT_EQ(pair(1, 1, 0), Repeated::kHeadPose);
  EXPECT_EQ(pair(2, 2, 1), std::nullopt);
}

/// A device that interpolates between two equal poses rounds; a head that rests moves by more.
TEST_F(Repeats, APoseThatIsEqualUpToRounding) {
  const auto moved = [](double by_m) {
    const auto pose = scripted_pose(0);
    return Transform<World, Rig>(pose.rotation(), pose.translation() + Vec3{by_m, 0, 0});
  };
  int number = 0;
  const auto look = [&](double by_m) {
    ++number;
    return watch_.look(scripted_image(static_cast<std::uint64_t>(number)),
                       scripted_image(static_cast<std::uint64_t>(1000 + number)), moved(by_m),
                       kSensors, std::nullopt);
  };
  EXPECT_EQ(look(0.0), std::nullopt);
  EXPECT_EQ(look(1e-15), Repeated::kHeadPose);
  EXPECT_EQ(look(1e-7), std::nullopt) << "a ten-thousandth of a millimetre";
}

/// Every second picture of a stream at twice its camera's rate: left out alone.
TEST_F(Repeats, OfEachPictureTwiceTheFirstIsTaken) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(pair(i / 2, i / 2, i).has_value(), i % 2 == 1) << i;
  }
}

/// A picture that stands still, coded anew with each key frame, looks new once.
TEST_F(Repeats, ANewPictureAfterAFrozenOneIsTakenOnlyIfTheNextIsNewToo) {
  EXPECT_EQ(pair(0, 0, 0), std::nullopt);
  EXPECT_EQ(pair(0, 0, 1), Repeated::kBothPictures);
  EXPECT_EQ(pair(0, 0, 2), Repeated::kBothPictures);
  EXPECT_EQ(pair(1, 1, 3), Repeated::kBothPictures);
  EXPECT_EQ(pair(1, 1, 4), Repeated::kBothPictures);
  EXPECT_EQ(pair(1, 1, 5), Repeated::kBothPictures);
  EXPECT_EQ(pair(2, 2, 6), Repeated::kBothPictures);
  EXPECT_EQ(pair(3, 3, 7), std::nullopt);
}

TEST_F(Repeats, OnlyWhatTheDeviceDoesNotSayOfItself) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(pair(0, 0, 0, {true, true}), std::nullopt);
  }
  EXPECT_EQ(pair(0, 0, 0, {.pictures = true}), std::nullopt) << "the first pose that is looked at";
  EXPECT_EQ(pair(0, 0, 0, {.pictures = true}), Repeated::kHeadPose);
  RepeatWatch fresh;
  watch_ = fresh;
  EXPECT_EQ(pair(0, 0, 0, {.head_pose = true}), std::nullopt);
  EXPECT_EQ(pair(0, 0, 0, {.head_pose = true}), Repeated::kBothPictures);
}

/// Tools that a tracker measures itself come without pictures, and its cameras stand still.
TEST_F(Repeats, NothingWithoutPictures) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(watch_.look({}, {}, Transform<World, Rig>(), kSensors, std::nullopt), std::nullopt);
  }
}

}  // namespace
}  // namespace orthonav
