#pragma once

#include <regex>
#include <string>
#include <vector>

#include "base/translation.h"
#include "tests/support/language_in_use.h"
#include "tools/orthonav/language/language_file.h"

namespace orthonav::test {

/// A language of brackets: of each text only its values are left, as in "[3.2 3.0]". A letter that
/// still appears is English that was not translated.
class PseudoLanguage {
 public:
  PseudoLanguage() : in_use_(entries()) {}

 private:
  static std::vector<Translation::Entry> entries() {
    std::vector<Translation::Entry> entries;
    for (const std::string& english : tools::texts_to_translate()) {
      std::string text = "[";
      for (const std::string_view conversion : conversions_of(english)) {
        text.append(text.size() == 1 ? "" : " ").append(conversion);
      }
      entries.push_back({english, text + "]"});
    }
    return entries;
  }

  LanguageInUse in_use_;
};

/// The words in a text that are neither numbers and units nor names of the operation: tools,
/// levels, commands in quotation marks, or `heard`.
inline std::string english_left(const std::string& text, const std::string& heard = "mm") {
  const std::regex allowed("\\b(mm|inf|pointer|guide|reference|L[0-9]|" + heard +
                           ")\\b|\"(begin guiding|save points|delete last|accept result|reject "
                           "level|go to next|finish rod|move "
                           "template|twin screw|show numbers|drill)\"");
  static const std::regex kNoLetters("[^A-Za-z\"]+");
  return std::regex_replace(std::regex_replace(text, allowed, ""), kNoLetters, "");
}

}  // namespace orthonav::test
