#include "hal/api/microphone.h"

#include <string>

namespace orthonav {

Result<std::size_t> Microphone::read(std::span<std::int16_t> samples) {
  if (samples.empty()) {
    return std::size_t{0};
  }
  Result<std::size_t> count = do_read(samples);
  if (count && *count > samples.size()) {
    return Error{"microphone: delivered " + std::to_string(*count) + " samples, room was for " +
                 std::to_string(samples.size())};
  }
  return count;
}

}  // namespace orthonav
