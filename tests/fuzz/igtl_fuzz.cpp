#include <algorithm>
#include <cstdint>
#include <span>

#include "hal/igtl/incoming.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// What a stranger sends to the OpenIGTLink port. However the network cuts it, the same comes of
/// it.
void fuzz_igtl(std::span<const std::uint8_t> input) {
  igtl::Incoming whole;
  const Status at_once = whole.take(input);
  igtl::Incoming parts;
  Status piecemeal;
  const std::size_t step = input.empty() ? 1 : 1 + input[0] % 97;
  for (std::size_t at = 0; at < input.size() && piecemeal; at += step) {
    piecemeal = parts.take(input.subspan(at, std::min(step, input.size() - at)));
  }
  insist(at_once.ok() == piecemeal.ok());
  insist(whole.messages() == parts.messages());
}

}  // namespace orthonav::fuzz
