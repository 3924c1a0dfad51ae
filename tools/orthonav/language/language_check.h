#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/translation.h"

namespace orthonav::tools {

/// One line of a translation's file.
struct LanguageLine {
  std::string english;
  std::string text;
  int line = 0;
};

/// Checks the lines of `file` against the texts there are, in the order in which they are listed:
/// each must be translated, and nothing else. A translation must have the conversions of the
/// English text in the same order, keep the commands that it tells the wearer to say, and hold only
/// characters of the display's font. Everything is refused at the first breach, in one line: a
/// display is never half in English.
[[nodiscard]] Result<Translation> checked_translation(const std::string& file,
                                                      const std::vector<LanguageLine>& lines,
                                                      const std::vector<std::string>& texts);

}  // namespace orthonav::tools
