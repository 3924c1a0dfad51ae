#include "engine/session/part_wording.h"

#include <array>

namespace orthonav::engine {

std::string_view stalled_text(Part part) {
  constexpr std::array<std::string_view, kPartCount> kTexts = {
      "camera stalled: nothing is guided", "tracker stalled: nothing is guided",
      "renderer stalled: nothing is guided", "coach stalled: nothing is guided",
      "voice stalled: nothing is guided"};
  return kTexts[static_cast<std::size_t>(part)];
}

std::string_view word_of(Part part) {
  const std::string_view text = stalled_text(part);
  return text.substr(0, text.find(' '));
}

}  // namespace orthonav::engine
