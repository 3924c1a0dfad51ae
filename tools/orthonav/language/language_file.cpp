#include "tools/orthonav/language/language_file.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <toml++/toml.h>

#include "base/one_line.h"
#include "embedded/language_de.h"
#include "embedded/language_template.h"
#include "engine/io/json_document.h"
#include "tools/orthonav/language/language_check.h"

namespace orthonav::tools {
namespace {

int line_of(const toml::source_region& where) { return static_cast<int>(where.begin.line); }

/// In the order of the file.
Result<std::vector<LanguageLine>> lines_of(std::string_view content, const std::string& path) {
  std::vector<LanguageLine> lines;
  try {
    for (const auto& [english, node] : toml::parse(content, path)) {
      const auto* text = node.as_string();
      const int line = line_of(node.source());
      if (text == nullptr) {
        return Error{path + ":" + std::to_string(line) + ": \"" +
                     one_line(std::string(english.str())) + "\" must be a text"};
      }
      lines.push_back({std::string(english.str()), text->get(), line});
    }
  } catch (const toml::parse_error& error) {
    return Error{path + ":" + std::to_string(line_of(error.source())) + ": " +
                 one_line(std::string(error.description()))};
  }
  std::sort(lines.begin(), lines.end(),
            [](const LanguageLine& a, const LanguageLine& b) { return a.line < b.line; });
  return lines;
}

Result<Translation> translation_of(std::string_view content, const std::string& path) {
  const auto lines = lines_of(content, path);
  return lines ? checked_translation(path, *lines, texts_to_translate())
               : Result<Translation>(lines.error());
}

}  // namespace

const std::vector<std::string>& texts_to_translate() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> texts;
    if (auto lines = lines_of(embedded::language_template(), "template.toml")) {
      for (LanguageLine& line : *lines) {
        texts.push_back(std::move(line.english));
      }
    }
    return texts;
  }();
  return all;
}

Result<Translation> load_translation(const std::string& path) {
  constexpr std::size_t kMostBytes = 1u << 20u;
  const auto content = engine::read_text(path, kMostBytes);
  return content ? translation_of(*content, path) : Result<Translation>(content.error());
}

Result<std::shared_ptr<const Translation>> language_named(const std::string& name) {
  if (name == "en") {
    return std::shared_ptr<const Translation>();
  }
  auto translation =
      name == "de" ? translation_of(embedded::language_de(), "de.toml") : load_translation(name);
  if (!translation) {
    return translation.error();
  }
  return std::shared_ptr<const Translation>(std::make_shared<Translation>(*std::move(translation)));
}

}  // namespace orthonav::tools
