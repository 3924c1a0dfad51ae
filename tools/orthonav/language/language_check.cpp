#include "tools/orthonav/language/language_check.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "base/one_line.h"
#include "base/printed.h"
#include "engine/session/workflow/commands.h"
#include "render/text/font.h"
#include "render/text/text_layout.h"

namespace orthonav::tools {
namespace {

std::string listed(const std::vector<std::string_view>& conversions) {
  std::string out;
  for (const std::string_view conversion : conversions) {
    out.append(out.empty() ? "" : " ").append(conversion);
  }
  return out.empty() ? "none" : out;
}

bool has_word(std::string_view text, std::string_view word) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    if ((at == 0 || !letter(at - 1)) && !letter(at + word.size())) {
      return true;
    }
  }
  return false;
}

/// The first command that the English text tells the wearer to say and the other does not. "Drill"
/// is one only after "say".
std::optional<std::string> lost_command(std::string_view english, std::string_view text) {
  const bool say = has_word(english, "say");
  for (const engine::Command& command : engine::kCommands) {
    const bool told =
        command.event != engine::Event::kSayReplan && (say || command.phrase != "drill");
    if (told && has_word(english, command.phrase) && !has_word(text, command.phrase)) {
      return std::string(command.phrase);
    }
  }
  return std::nullopt;
}

/// What the display can't show.
std::optional<std::string> odd_character(std::string_view text, const render::Font& font) {
  if (!render::is_utf8(text)) {
    return "is not UTF-8";
  }
  while (const auto code = render::take_code_point(text)) {
    const auto number = static_cast<unsigned>(*code);
    if (number < 0x20 || (number >= 0x7f && number < 0xa0)) {
      return printed("holds a control character, U+%04x", number);
    }
    if (!font.has(*code)) {
      return printed("holds U+%04x, which the display's font lacks", number);
    }
  }
  return std::nullopt;
}

/// What is wrong with a translation.
std::optional<std::string> problem_of(const LanguageLine& line, const render::Font& font) {
  if (auto odd = odd_character(line.text, font)) {
    return odd;
  }
  if (line.text.front() == ' ' || line.text.back() == ' ') {
    return "begins or ends with a space";
  }
  const auto wanted = conversions_of(line.english);
  if (const auto found = conversions_of(line.text); found != wanted) {
    return "has the conversions " + listed(found) + ", must have " + listed(wanted) +
           (wanted.empty() ? " (a percent sign is written %%)" : "");
  }
  if (const auto command = lost_command(line.english, line.text)) {
    return "lacks the command \"" + *command + "\", which is said in English";
  }
  return std::nullopt;
}

}  // namespace

Result<Translation> checked_translation(const std::string& file,
                                        const std::vector<LanguageLine>& lines,
                                        const std::vector<std::string>& texts) {
  std::map<std::string_view, const LanguageLine*> known;
  for (const std::string& text : texts) {
    known.emplace(text, nullptr);
  }
  const render::Font font;
  for (const LanguageLine& line : lines) {
    const std::string place = file + ":" + std::to_string(line.line) + ": ";
    const auto found = known.find(line.english);
    if (found == known.end()) {
      return Error{place + "\"" + one_line(line.english) + "\" is not a text of this version"};
    }
    if (line.text.empty()) {
      continue;
    }
    if (const auto problem = problem_of(line, font)) {
      return Error{place + "the translation of \"" + line.english + "\" " + *problem};
    }
    found->second = &line;
  }
  const auto missing = [&](const std::string& text) { return known[text] == nullptr; };
  if (const auto count = std::count_if(texts.begin(), texts.end(), missing); count > 0) {
    return Error{file + ": lacks " + std::to_string(count) + " of " + std::to_string(texts.size()) +
                 " texts, the first is \"" + *std::find_if(texts.begin(), texts.end(), missing) +
                 "\""};
  }
  std::vector<Translation::Entry> entries;
  for (const auto& [english, line] : known) {
    entries.push_back({line->english, line->text});
  }
  return Translation(std::move(entries));
}

}  // namespace orthonav::tools
