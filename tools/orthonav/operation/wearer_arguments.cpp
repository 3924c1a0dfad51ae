#include "tools/orthonav/operation/wearer_arguments.h"

#include <utility>

#include "base/translation.h"
#include "engine/holograms/shapes/hologram_colours.h"
#include "tools/orthonav/language/language_file.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

void WearerArguments::add_to(CLI::App& command) {
  command
      .add_option("--language", language_,
                  "of holograms and status line: en, de or a file (docs/languages.md)")
      ->check(some_text())
      ->type_name("en|de|FILE")
      ->capture_default_str();
  command
      .add_option(
          "--colours", colours_,
          "of holograms: standard, colour-blind, or changes as in good=#40C4FF,poor=#FF3B1F "
          "(docs/holograms.md)")
      ->check(some_text())
      ->type_name("standard|colour-blind|LIST")
      ->capture_default_str();
}

Status WearerArguments::use() const {
  const auto colours = engine::read_colours(colours_);
  if (!colours) {
    return Error{"--colours: " + colours.error().message, colours.error().code};
  }
  auto translation = language_named(language_);
  if (!translation) {
    return Error{"--language: " + translation.error().message, translation.error().code};
  }
  engine::use_colours(*colours);
  use_translation(*std::move(translation));
  return {};
}

}  // namespace orthonav::tools
