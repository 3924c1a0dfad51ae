#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/random.h"
#include "tests/support/synthetic_speech.h"

namespace orthonav::test {

enum class Noise { kWhite, kPink, kBabble };
[[nodiscard]] const char* name_of(Noise noise);

/// The source of babble: each has its own voices and texts, so that choices made with one are
/// measured with another.
enum class Babble { kMeasured, kTuning, kTraining };

/// `count` samples of unit power. Babble: six voices that read at once, none of which says a
/// command.
[[nodiscard]] std::vector<double> noise_of(Noise noise, std::size_t count, Random& random,
                                           Babble babble = Babble::kMeasured);

/// Root mean square over the 10 ms frames within 30 dB of the loudest: the level to which
/// signal-to-noise ratios refer.
[[nodiscard]] double active_rms(std::span<const std::int16_t> samples);

/// Sound that is assembled: silence, speech, and finally noise under all of it.
class Soundtrack {
 public:
  static constexpr double kSpeechRms = 3000.0;
  void silence(double length_s);
  /// Appends speech at `kSpeechRms`; where it begins and ends, in samples.
  std::pair<std::int64_t, std::int64_t> speech(std::span<const std::int16_t> samples);
  /// With noise `snr_db` below the speech.
  [[nodiscard]] std::vector<std::int16_t> with_noise(Noise noise, double snr_db, Random& random,
                                                     Babble babble = Babble::kMeasured) const;

 private:
  std::vector<double> samples_;
};

}  // namespace orthonav::test
