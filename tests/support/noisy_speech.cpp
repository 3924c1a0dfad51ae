#include "tests/support/noisy_speech.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orthonav::test {

namespace {

constexpr std::size_t kRateHz = 16000;
constexpr std::size_t kFrame = kRateHz / 100;

std::vector<double> frame_powers(std::span<const std::int16_t> samples) {
  std::vector<double> powers;
  for (std::size_t at = 0; at + kFrame <= samples.size(); at += kFrame) {
    double power = 0.0;
    for (const double sample : samples.subspan(at, kFrame)) {
      power += sample * sample;
    }
    powers.push_back(power / kFrame);
  }
  return powers;
}

void to_unit_power(std::vector<double>& samples) {
  double power = 0.0;
  for (const double sample : samples) {
    power += sample * sample;
  }
  const double scale = std::sqrt(static_cast<double>(samples.size()) / std::max(power, 1e-12));
  for (double& sample : samples) {
    sample *= scale;
  }
}

struct Talkers {
  std::array<const char*, 4> texts;
  std::array<const char*, 6> voices;
};

constexpr Talkers kMeasured = {
    {"The patient was brought in this morning after a long journey from the coast, and everyone "
     "had coffee.",
     "I think we should look at the other side before lunch, shouldn't we?",
     "Numbers on the monitor are fine, pressure one hundred and twenty over eighty.",
     "Yesterday the train was late again and I had to walk the whole way home."},
    {"gmw/en+m1", "en-us+f1", "en-029+m4", "en-gb-scotland+f2", "en-us+m3", "en-gb-x-rp+m8"}};
constexpr Talkers kTuning = {
    {"If it rains again tomorrow we shall stay in and play cards.",
     "Nobody knew where the keys had gone until Friday evening.",
     "The second lecture was longer than the first, but far more amusing.",
     "A hundred and forty boxes arrived, most of them empty, some full of paper."},
    {"en-us+f5", "gmw/en+m2", "en-gb-x-rp+m6", "en-us-nyc+f4", "en-us+m2", "en-gb-x-gbclan+f5"}};
constexpr Talkers kTraining = {
    {"She opened the window because it was rather warm inside, and a bird flew in.",
     "My brother works at the harbour and comes home at six.",
     "The bread is in the oven, so please keep an eye on the clock.",
     "They painted the fence green, which nobody in the village had expected."},
    {"en-us+Alex", "gmw/en+linda", "en-gb-x-rp+Mario", "en-us-nyc+Annie", "en-us+robert",
     "en-gb-x-gbclan+steph"}};

/// Twelve seconds, played in a loop.
std::vector<double> make_babble(const Talkers& talkers) {
  std::vector<double> babble(12 * kRateHz, 0.0);
  for (std::size_t v = 0; v < talkers.voices.size(); ++v) {
    for (std::size_t at = 3000 * v, text = v; at < (v + 12) * kRateHz; ++text) {
      const auto said = spoken(talkers.texts[text % talkers.texts.size()],
                               {talkers.voices[v], 150 + 10 * static_cast<int>(v)});
      if (!said) {
        return {};
      }
      for (std::size_t i = 0; i < said->size(); ++i) {
        babble[(at + i) % babble.size()] += (*said)[i];
      }
      at += said->size();
    }
  }
  to_unit_power(babble);
  return babble;
}

const std::vector<double>& sound_of(Babble babble) {
  if (babble == Babble::kTuning) {
    static const std::vector<double> tuning = make_babble(kTuning);
    return tuning;
  }
  if (babble == Babble::kTraining) {
    static const std::vector<double> training = make_babble(kTraining);
    return training;
  }
  static const std::vector<double> measured = make_babble(kMeasured);
  return measured;
}

}  // namespace

const char* name_of(Noise noise) {
  if (noise == Noise::kWhite) {
    return "white";
  }
  return noise == Noise::kPink ? "pink" : "babble";
}

std::vector<double> noise_of(Noise noise, std::size_t count, Random& random, Babble babble) {
  std::vector<double> samples(count);
  if (noise == Noise::kWhite) {
    for (double& sample : samples) {
      sample = random.normal();
    }
  }
  if (noise == Noise::kPink) {
    // Three poles that together fall by 3 dB per octave (P. Kellet's filter).
    double slow = 0.0, middle = 0.0, fast = 0.0;
    for (double& sample : samples) {
      const double white = random.normal();
      slow = 0.99765 * slow + 0.0990460 * white;
      middle = 0.96300 * middle + 0.2965164 * white;
      fast = 0.57000 * fast + 1.0526913 * white;
      sample = slow + middle + fast + 0.1848 * white;
    }
    to_unit_power(samples);
  }
  if (noise == Noise::kBabble) {
    const std::vector<double>& sound = sound_of(babble);
    if (sound.empty()) {
      return samples;
    }
    const auto start =
        static_cast<std::size_t>(random.uniform() * static_cast<double>(sound.size()));
    for (std::size_t i = 0; i < count; ++i) {
      samples[i] = sound[(start + i) % sound.size()];
    }
  }
  return samples;
}

double active_rms(std::span<const std::int16_t> samples) {
  const std::vector<double> powers = frame_powers(samples);
  double most = 0.0;
  for (const double power : powers) {
    most = std::max(most, power);
  }
  double sum = 0.0;
  int count = 0;
  for (const double power : powers) {
    if (power < 1e-3 * most) {
      continue;
    }
    sum += power;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

void Soundtrack::silence(double length_s) {
  samples_.resize(samples_.size() + static_cast<std::size_t>(length_s * kRateHz), 0.0);
}

std::pair<std::int64_t, std::int64_t> Soundtrack::speech(std::span<const std::int16_t> samples) {
  const double gain = kSpeechRms / std::max(active_rms(samples), 1.0);
  std::int64_t first = -1;
  std::int64_t last = 0;
  const auto begin = static_cast<std::int64_t>(samples_.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double sample = gain * samples[i];
    // Samples 40 dB below the speech are inaudible: the synthesiser ends in silence.
    if (std::abs(sample) > 0.01 * kSpeechRms) {
      last = static_cast<std::int64_t>(i);
      if (first < 0) {
        first = last;
      }
    }
    samples_.push_back(sample);
  }
  return {begin + std::max<std::int64_t>(first, 0), begin + last + 1};
}

std::vector<std::int16_t> Soundtrack::with_noise(Noise noise, double snr_db, Random& random,
                                                 Babble babble) const {
  const double level = kSpeechRms * std::pow(10.0, -snr_db / 20.0);
  const std::vector<double> noises = noise_of(noise, samples_.size(), random, babble);
  std::vector<std::int16_t> mixed;
  mixed.reserve(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    mixed.push_back(static_cast<std::int16_t>(
        std::clamp(std::lround(samples_[i] + level * noises[i]), -32767L, 32767L)));
  }
  return mixed;
}

}  // namespace orthonav::test
