#include "tools/language_argument.h"

#include <utility>

#include "base/translation.h"
#include "tools/arguments.h"
#include "tools/language_file.h"

namespace orthonav::tools {

void LanguageArgument::add_to(CLI::App& command) {
  command
      .add_option("--language", name_,
                  "of holograms and status line: en, de or a file (docs/languages.md)")
      ->check(some_text())
      ->type_name("LANGUAGE")
      ->capture_default_str();
}

Status LanguageArgument::use() const {
  auto translation = language_named(name_);
  if (!translation) {
    return Error{"--language: " + translation.error().message, translation.error().code};
  }
  use_translation(*std::move(translation));
  return {};
}

}  // namespace orthonav::tools
