#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::test {

/// A speaker of espeak-ng.
struct Speaker {
  std::string voice;  ///< "en-us", "en-gb-x-rp+f3": accent and variant
  int words_a_minute = 150;
};

/// Speech at 16 kHz, as loud as espeak-ng makes it; the same bits each time. One thread at a time:
/// the library is one synthesiser for the process.
Result<std::vector<std::int16_t>> spoken(const std::string& text, const Speaker& speaker);

}  // namespace orthonav::test
