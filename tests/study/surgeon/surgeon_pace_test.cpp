#include <gmock/gmock.h>

#include <cmath>

#include "hal/sim/surgeon/stroke_plan.h"
#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim::surgeon_pace_test {
namespace {

struct Digitized {
  double duration_s = 0.0;
  double pressed_s = 0.0;
  int presses = 0;
  int samples = 0;
  int deleted = 0;
};

Digitized digitized(const TestCase& test_case, int seed, const ErrorModel& error_model) {
  auto headset = SimHeadset::open(test_case.room, without_pixels(seed, error_model));
  EXPECT_TRUE(headset.ok());
  FakeEngine engine(**headset, test_case);
  EXPECT_GT(engine.run(), 0);
  EXPECT_EQ(engine.history().back(), "done") << "seed " << seed;
  const DigitizedLevel& level = engine.levels().at(test_case.room.operated.at(0));
  Digitized out{level.duration_s, 0.0, 0, level.saved_samples, level.deleted_regions};
  double pressed_at_s = 0.0;
  for (const ClickerEvent& click : engine.clicks()) {
    const double time_s = seconds(click.time.time_since_epoch());
    if (click.action == ClickerAction::kPress) {
      pressed_at_s = time_s;
      ++out.presses;
    } else if (click.action == ClickerAction::kRelease) {
      out.pressed_s += time_s - pressed_at_s;
    } else if (click.action == ClickerAction::kDoubleClick) {
      break;
    }
  }
  return out;
}

// Liebmann et al. 2019: 125 ± 27 s and 1,983 ± 404 points for a level, at 30 Hz.
constexpr double kPublished_s = 125.0;
constexpr double kPublishedSd_s = 27.0;
constexpr double kPublishedPoints = 1983.0;
constexpr double kPublishedSdPoints = 404.0;
constexpr double kFrameRate_hz = 30.0;
/// The simulated surgeon slips in one region of ten and repeats it; one who never slips needs this
/// much less time. Points of a region that slipped are deleted, so their number stays.
constexpr double kSlips = 0.1;
/// The tolerance for the simulation's own steps: a tick of a press, the hops from stroke to stroke.
constexpr double kDurationOff = 0.02;
constexpr double kPointsOff = 0.005;

bool at_published_pace(const Digitized& d) {
  const double without_slips_s = (1.0 - kSlips) * kPublished_s;
  return std::abs(d.duration_s / without_slips_s - 1.0) < kDurationOff &&
         std::abs(d.samples / kPublishedPoints - 1.0) < kPointsOff;
}

/// For any size, shape and number of strokes, with strokes without randomness.
TEST(Surgeon, KeepsThePaperPaceOnEveryRealVertebra) {
  for (const char* label : {"L1", "L2", "L3", "L4", "L5"}) {
    const auto test_case = visible_human_case({label});
    if (!test_case) {
      GTEST_SKIP() << "needs tests/data/anatomy";
    }
    ErrorModel model = ErrorModel::perfect();
    const Digitized d = digitized(*test_case, 1, model);
    EXPECT_TRUE(at_published_pace(d)) << label << " " << d.duration_s << " s " << d.samples;
    EXPECT_EQ(d.deleted, 0);
    // A point a frame, and only while the button is pressed: one more or less for each press.
    EXPECT_NEAR(d.samples, kFrameRate_hz * d.pressed_s, d.presses) << label;
    // The control: a surgeon who works 3 % faster does not keep the pace.
    model.pace = 1.03;
    EXPECT_FALSE(at_published_pace(digitized(*test_case, 1, model))) << label;
  }
}

struct Spread {
  double mean = 0.0;
  double sd = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Spread out;
  for (const double v : values) {
    out.mean += v / n;
  }
  for (const double v : values) {
    out.sd += (v - out.mean) * (v - out.mean) / (n - 1.0);
  }
  out.sd = std::sqrt(out.sd);
  return out;
}

struct Surgeons {
  Spread duration_s;
  Spread samples;
  int deleted = 0;
};

Surgeons many(const TestCase& test_case, int seeds, const ErrorModel& error_model) {
  std::vector<double> durations_s;
  std::vector<double> samples;
  Surgeons out;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Digitized d = digitized(test_case, seed, error_model);
    durations_s.push_back(d.duration_s);
    samples.push_back(d.samples);
    out.deleted += d.deleted;
  }
  out.duration_s = spread_of(durations_s);
  out.samples = spread_of(samples);
  return out;
}

TEST(Surgeon, KeepsThePaperPaceOnARealVertebra) {
  const auto test_case = visible_human_case({"L4"});
  if (!test_case) {
    GTEST_SKIP() << "needs tests/data/anatomy";
  }
  constexpr int kSeeds = 20;
  const Surgeons all = many(*test_case, kSeeds, {});
  // Three standard errors of as many draws: SD / sqrt(n) of a mean, SD / sqrt(2n) of an SD.
  const double of_mean = 3.0 / std::sqrt(kSeeds);
  const double of_sd = 3.0 / std::sqrt(2.0 * kSeeds);
  EXPECT_NEAR(all.duration_s.mean, kPublished_s, of_mean * kPublishedSd_s);
  EXPECT_NEAR(all.duration_s.sd, kPublishedSd_s, of_sd * kPublishedSd_s);
  EXPECT_NEAR(all.samples.mean, kPublishedPoints, of_mean * kPublishedSdPoints);
  EXPECT_NEAR(all.samples.sd, kPublishedSdPoints, of_sd * kPublishedSdPoints);
  // Regions repeated: each slips until it does not, a geometric number of times.
  const double regions =
      static_cast<double>(kSeeds * plan_strokes(test_case->room.levels.at(3)).size());
  EXPECT_NEAR(all.deleted, regions * kSlips / (1.0 - kSlips),
              3.0 * std::sqrt(regions * kSlips) / (1.0 - kSlips));
  // The control: the spread is that between surgeons; for a single one it is far below the bounds.
  ErrorModel same;
  same.pace_sd = 0.0;
  const Surgeons one = many(*test_case, 5, same);
  EXPECT_LT(one.duration_s.sd, (1.0 - of_sd) * kPublishedSd_s);
  EXPECT_LT(one.samples.sd, (1.0 - of_sd) * kPublishedSdPoints);
}

}  // namespace
}  // namespace orthonav::sim::surgeon_pace_test
