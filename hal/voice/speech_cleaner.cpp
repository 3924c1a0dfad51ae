#include "hal/voice/speech_cleaner.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "base/random.h"
#include "hal/voice/speech_segments.h"

namespace orthonav::voice {

namespace {

constexpr double kOverSubtraction = 1.5;  ///< times the background's power
constexpr double kLeastGain = 0.1;        ///< of any frequency, to avoid ringing in gaps
constexpr double kSpeechRms = 3000.0;     ///< of the loudest frames
constexpr double kMasking_db =
    -30.0;  ///< level of the white noise that is added, relative to the speech
constexpr std::size_t kWindow = 512;  // 32 ms
constexpr std::size_t kHop = kWindow / 2;
constexpr std::size_t kBins = kWindow / 2 + 1;
using Spectrum = std::vector<std::complex<float>>;

/// Square root of a Hann window: applied before and after, halves that overlap add up to one.
const std::vector<float>& window() {
  static const std::vector<float> values = [] {
    std::vector<float> made(kWindow);
    for (std::size_t i = 0; i < kWindow; ++i) {
      made[i] =
          static_cast<float>(std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / kWindow));
    }
    return made;
  }();
  return values;
}

class Stft {
 public:
  Stft() { fft_.SetFlag(Eigen::FFT<float>::HalfSpectrum); }
  void forward(const float* samples, Spectrum& spectrum) {
    frame_.resize(kWindow);
    for (std::size_t i = 0; i < kWindow; ++i) {
      frame_[i] = samples[i] * window()[i];
    }
    fft_.fwd(spectrum, frame_);
  }
  void add_inverse(const Spectrum& spectrum, float* samples) {
    fft_.inv(frame_, spectrum, kWindow);
    for (std::size_t i = 0; i < kWindow; ++i) {
      samples[i] += frame_[i] * window()[i];
    }
  }

 private:
  Eigen::FFT<float> fft_;
  std::vector<float> frame_;
};

std::vector<float> mean_power(Stft& stft, std::span<const float> samples) {
  std::vector<float> power(kBins, 0.0F);
  Spectrum spectrum;
  int frames = 0;
  for (std::size_t at = 0; at + kWindow <= samples.size(); at += kHop, ++frames) {
    stft.forward(samples.data() + at, spectrum);
    for (std::size_t b = 0; b < kBins; ++b) {
      power[b] += std::norm(spectrum[b]);
    }
  }
  // There are few frames: averaging over neighbouring frequencies steadies the estimate.
  std::vector<float> smooth(kBins, 0.0F);
  for (std::size_t b = 0; b < kBins; ++b) {
    const std::size_t first = b < 2 ? 0 : b - 2;
    const std::size_t last = std::min(b + 2, kBins - 1);
    for (std::size_t k = first; k <= last; ++k) {
      smooth[b] += power[k] / static_cast<float>(last - first + 1);
    }
  }
  for (float& p : smooth) {
    p /= static_cast<float>(std::max(frames, 1));
  }
  return smooth;
}

/// Decision-directed Wiener gain (Ephraim and Malah 1984).
void filter(Stft& stft, std::vector<float>& samples, const std::vector<float>& background) {
  constexpr float kMemory = 0.9F;
  std::vector<float> out(samples.size() + kWindow, 0.0F);
  samples.resize(samples.size() + kWindow, 0.0F);
  std::vector<float> before(kBins, 0.0F);
  Spectrum spectrum;
  const auto least = static_cast<float>(kLeastGain);
  for (std::size_t at = 0; at + kWindow <= samples.size(); at += kHop) {
    stft.forward(samples.data() + at, spectrum);
    for (std::size_t b = 0; b < kBins; ++b) {
      const float noise = static_cast<float>(kOverSubtraction) * background[b] + 1e-3F;
      const float now = std::max(std::norm(spectrum[b]) / noise - 1.0F, 0.0F);
      const float prior = kMemory * before[b] + (1.0F - kMemory) * now;
      const float gain = std::max(prior / (1.0F + prior), least);
      spectrum[b] *= gain;
      before[b] = std::norm(spectrum[b]) / noise;
    }
    stft.add_inverse(spectrum, out.data() + at);
  }
  samples.assign(out.begin(), out.end() - static_cast<std::ptrdiff_t>(kWindow));
}

/// RMS of the frames within 20 dB of the loudest.
double loudness(std::span<const float> samples) {
  constexpr std::size_t kFrame = kSpeechRateHz / 100;
  std::vector<double> powers;
  for (std::size_t at = 0; at + kFrame <= samples.size(); at += kFrame) {
    double power = 0.0;
    for (std::size_t i = 0; i < kFrame; ++i) {
      power += double{samples[at + i]} * samples[at + i];
    }
    powers.push_back(power / kFrame);
  }
  if (powers.empty()) {
    return 0.0;
  }
  const double most = *std::max_element(powers.begin(), powers.end());
  double sum = 0.0;
  int count = 0;
  for (const double power : powers) {
    if (power < 0.01 * most) {
      continue;
    }
    sum += power;
    ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace

std::vector<std::int16_t> cleaned(std::span<const std::int16_t> samples,
                                  std::size_t background_samples) {
  std::vector<float> sound(samples.begin(), samples.end());
  Stft stft;
  const auto background =
      mean_power(stft, std::span(sound).first(std::min(background_samples, sound.size())));
  filter(stft, sound, background);
  const double loud = loudness(sound);
  const double gain = loud > 0.0 ? kSpeechRms / loud : 0.0;
  const double mask = kSpeechRms * std::pow(10.0, kMasking_db / 20.0);
  Random random(1);
  std::vector<std::int16_t> out;
  if (sound.size() <= background_samples) {
    return out;
  }
  for (const float sample : std::span(sound).subspan(background_samples)) {
    out.push_back(static_cast<std::int16_t>(
        std::clamp(gain * double{sample} + mask * random.normal(), -32767.0, 32767.0)));
  }
  return out;
}

}  // namespace orthonav::voice
