#include "hal/voice/speech_features.h"

#include <sphinxbase/fe.h>

#include <algorithm>

namespace orthonav::voice {

std::vector<Cepstrum> cepstra_of(fe_s* front_end, std::span<const std::int16_t> samples) {
  // The mean that the acoustic model comes with (-cmninit in its feat.params).
  constexpr Cepstrum kZero = {41.00F, -5.29F, -0.12F, 5.09F,  2.48F,  -4.07F, -1.37F,
                              -1.78F, -5.08F, -2.05F, -6.45F, -1.42F, 1.17F};
  mfcc_t** block = nullptr;
  int32 count = 0;
  if (fe_start_utt(front_end) != 0 ||
      fe_process_utt(front_end, samples.data(), samples.size(), &block, &count) != 0 || !block) {
    return {};
  }
  std::vector<Cepstrum> cepstra(static_cast<std::size_t>(std::max(count, 0)));
  for (std::size_t t = 0; t < cepstra.size(); ++t) {
    for (std::size_t i = 0; i < kZero.size(); ++i) {
      cepstra[t][i] = block[t][i] - kZero[i];
    }
  }
  fe_free_2d(block);
  return cepstra;
}

}  // namespace orthonav::voice
