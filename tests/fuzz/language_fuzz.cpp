#include "tests/fuzz/input_file.h"
#include "tools/orthonav/language/language_file.h"

namespace orthonav::fuzz {

/// Translations: an accepted one has every text, and no value is lost in it.
void fuzz_language(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto translation = tools::load_translation(file.path());
  if (!translation) {
    insist_one_line(translation.error());
    return;
  }
  insist(translation->entries().size() == tools::texts_to_translate().size());
  for (const Translation::Entry& entry : translation->entries()) {
    insist(conversions_of(entry.english) == conversions_of(entry.text));
  }
}

}  // namespace orthonav::fuzz
