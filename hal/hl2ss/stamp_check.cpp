#include "hal/hl2ss/stamp_check.h"

#include <array>
#include <cmath>

#include "base/findings.h"

namespace orthonav::hl2ss {
namespace {

/// Stamps jitter by about 2 ms; with a head turning at 30 degrees per second, a pose that is 10 ms
/// early is 2 mm off at a pointer's tip.
constexpr double kMaxOffS = 0.010;
/// With this surplus of images that agree with one another but not with the past, a clock was set,
/// or the first accepted image was wrong.
constexpr int kBelievedAfter = 20;
constexpr std::array<double, 2> kTickS = {1e-9, 1e-7};

}  // namespace

double StampCheck::ahead_s(const Moment& from, const Moment& to) {
  // Unsigned ticks wrap around; the signed difference is right in both cases.
  const auto ticks =
      static_cast<double>(static_cast<std::int64_t>(to.sensor_ticks - from.sensor_ticks));
  const double stamps_s = seconds(to.stamp - from.stamp);
  const double of_ns = stamps_s - ticks * kTickS[0];
  const double of_100ns = stamps_s - ticks * kTickS[1];
  return std::abs(of_ns) <= std::abs(of_100ns) ? of_ns : of_100ns;
}

Status StampCheck::check(Timestamp stamp, std::uint64_t sensor_ticks) {
  const Moment next{stamp, sensor_ticks};
  const double off_s = trusted_ ? ahead_s(*trusted_, next) : 0.0;
  leapt_.reset();
  if (std::abs(off_s) > kMaxOffS) {
    doubt(next);
    if (votes_ < kBelievedAfter) {
      return refused(off_s < 0.0
                         ? "stamp %.1f ms before where the sensor's clock puts it, limit %.1f ms"
                         : "stamp %.1f ms after where the sensor's clock puts it, limit %.1f ms",
                     std::abs(off_s) * 1e3, kMaxOffS * 1e3);
    }
    leapt_ = from_seconds(off_s);
  }
  trusted_ = next;
  doubted_.reset();
  votes_ = 0;
  return {};
}

/// The majority vote of Boyer and Moore (1981), which single wrong stamps in between only delay.
void StampCheck::doubt(const Moment& next) {
  const bool agrees = doubted_ && std::abs(ahead_s(*doubted_, next)) <= kMaxOffS;
  if (agrees || votes_ == 0) {
    doubted_ = next;
    ++votes_;
  } else {
    --votes_;
  }
}

}  // namespace orthonav::hl2ss
