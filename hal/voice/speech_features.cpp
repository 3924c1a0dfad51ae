#include "hal/voice/speech_features.h"

#include <sphinxbase/fe.h>

#include <algorithm>

namespace orthonav::voice {

std::vector<Cepstrum> cepstra_of(fe_s* front_end, std::span<const std::int16_t> samples) {
  mfcc_t** block = nullptr;
  int32 count = 0;
  if (fe_start_utt(front_end) != 0 ||
      fe_process_utt(front_end, samples.data(), samples.size(), &block, &count) != 0 || !block) {
    return {};
  }
  std::vector<Cepstrum> cepstra(static_cast<std::size_t>(std::max(count, 0)));
  for (std::size_t t = 0; t < cepstra.size(); ++t) {
    std::copy_n(block[t], cepstra[t].size(), cepstra[t].begin());
  }
  fe_free_2d(block);
  return cepstra;
}

}  // namespace orthonav::voice
