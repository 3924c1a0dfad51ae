#include "tests/support/synthetic_speech.h"

#include <espeak-ng/speak_lib.h>
#include <samplerate.h>

#include <algorithm>
#include <cmath>

namespace orthonav::test {

namespace {

constexpr int kOutHz = 16000;

int keep(short* samples, int count, espeak_EVENT* events) {
  auto* out = events ? static_cast<std::vector<float>*>(events->user_data) : nullptr;
  if (samples && out) {
    for (int i = 0; i < count; ++i) {
      out->push_back(static_cast<float>(samples[i]) / 32768.0F);
    }
  }
  return 0;
}

/// Starts the synthesiser, once per process. Its sample rate, or 0 if it can't be started.
int start_synthesiser() {
  static const int rate_hz = [] {
    const int rate =
        espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 200, nullptr, espeakINITIALIZE_DONT_EXIT);
    espeak_SetSynthCallback(&keep);
    return std::max(rate, 0);
  }();
  return rate_hz;
}

}  // namespace

Result<std::vector<std::int16_t>> spoken(const std::string& text, const Speaker& speaker) {
  const int rate_hz = start_synthesiser();
  if (rate_hz == 0) {
    return Error{"espeak-ng can't be started"};
  }
  if (espeak_SetVoiceByName(speaker.voice.c_str()) != EE_OK) {
    return Error{"espeak-ng has no voice " + speaker.voice};
  }
  espeak_SetParameter(espeakRATE, speaker.words_a_minute, 0);
  std::vector<float> own_rate;
  if (espeak_Synth(text.c_str(), text.size() + 1, 0, POS_CHARACTER, 0, espeakCHARS_UTF8, nullptr,
                   &own_rate) != EE_OK) {
    return Error{"espeak-ng can't say \"" + text + "\""};
  }
  espeak_Synchronize();
  const double ratio = static_cast<double>(kOutHz) / rate_hz;
  std::vector<float> resampled(
      static_cast<std::size_t>(static_cast<double>(own_rate.size()) * ratio) + 16);
  SRC_DATA work{};
  work.data_in = own_rate.data();
  work.input_frames = static_cast<long>(own_rate.size());
  work.data_out = resampled.data();
  work.output_frames = static_cast<long>(resampled.size());
  work.src_ratio = ratio;
  if (src_simple(&work, SRC_SINC_MEDIUM_QUALITY, 1) != 0) {
    return Error{"speech can't be resampled"};
  }
  std::vector<std::int16_t> samples;
  for (long i = 0; i < work.output_frames_gen; ++i) {
    samples.push_back(static_cast<std::int16_t>(
        std::lround(std::clamp(resampled[static_cast<std::size_t>(i)], -1.0F, 1.0F) * 32767.0F)));
  }
  return samples;
}

}  // namespace orthonav::test
