#include "engine/session/work_watch.h"

#include <array>

#include "base/translation.h"

namespace orthonav::engine {

namespace {

constexpr std::array<const char*, kPartCount> kStalledTexts = {
    translatable("camera stalled: nothing is guided"),
    translatable("tracker stalled: nothing is guided"),
    translatable("renderer stalled: nothing is guided"),
    translatable("coach stalled: nothing is guided"),
    translatable("voice stalled: nothing is guided"),
    translatable("registration stalled: nothing is guided")};

static_assert(kStalledTexts.back() != nullptr, "every part has its text");

}  // namespace

std::string_view stalled_text(Part part) {
  return translated(std::string_view(kStalledTexts[static_cast<std::size_t>(part)]));
}

std::string_view word_of(Part part) {
  const std::string_view text = kStalledTexts[static_cast<std::size_t>(part)];
  return text.substr(0, text.find(' '));
}

}  // namespace orthonav::engine
