#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/translation.h"

namespace orthonav::tools {

/// Every English text that a wearer may read, in the order of data/languages/template.toml.
[[nodiscard]] const std::vector<std::string>& texts_to_translate();

/// The translation of a file (TOML: English text = other text), checked by
/// tools/orthonav/language/language_check.h.
[[nodiscard]] Result<Translation> load_translation(const std::string& path);

/// "de": the one that is built in; "en": null, no translation; otherwise that of a file.
[[nodiscard]] Result<std::shared_ptr<const Translation>> language_named(const std::string& name);

}  // namespace orthonav::tools
