#include "hal/voice/resampler.h"

#include <samplerate.h>

#include <string>

namespace orthonav::voice {

void Resampler::Free::operator()(SRC_STATE_tag* state) const { src_delete(state); }

Result<Resampler> Resampler::create(int from_hz, int to_hz) {
  constexpr int kLeastHz = 8000;
  constexpr int kMaxHz = 192000;
  for (const int rate_hz : {from_hz, to_hz}) {
    if (rate_hz < kLeastHz || rate_hz > kMaxHz) {
      return Error{"sound: sample rate " + std::to_string(rate_hz) +
                   " Hz, must lie in [8000, 192000] Hz"};
    }
  }
  Resampler made;
  made.ratio_ = static_cast<double>(to_hz) / from_hz;
  if (from_hz == to_hz) {
    return made;
  }
  int code = 0;
  made.state_.reset(src_new(SRC_SINC_FASTEST, 1, &code));
  if (!made.state_) {
    return Error{std::string("sound: ") + src_strerror(code)};
  }
  return made;
}

Status Resampler::push(std::span<const std::int16_t> samples, std::vector<std::int16_t>& out) {
  if (!state_) {
    out.insert(out.end(), samples.begin(), samples.end());
    return {};
  }
  in_.resize(samples.size());
  src_short_to_float_array(samples.data(), in_.data(), static_cast<int>(samples.size()));
  out_.resize(static_cast<std::size_t>(static_cast<double>(samples.size()) * ratio_) + 64);
  SRC_DATA work{};
  work.data_in = in_.data();
  work.input_frames = static_cast<long>(in_.size());
  work.src_ratio = ratio_;
  while (work.input_frames > 0) {
    work.data_out = out_.data();
    work.output_frames = static_cast<long>(out_.size());
    if (const int code = src_process(state_.get(), &work); code != 0) {
      return Error{std::string("sound: ") + src_strerror(code)};
    }
    const std::size_t before = out.size();
    out.resize(before + static_cast<std::size_t>(work.output_frames_gen));
    src_float_to_short_array(out_.data(), out.data() + before,
                             static_cast<int>(work.output_frames_gen));
    if (work.input_frames_used == 0 && work.output_frames_gen == 0) {
      break;
    }
    work.data_in += work.input_frames_used;
    work.input_frames -= work.input_frames_used;
  }
  return {};
}

}  // namespace orthonav::voice
