#include "engine/case/line_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

// English, its short forms, and German.
constexpr std::array<std::string_view, 3> kLeft = {"left", "lt", "links"};
constexpr std::array<std::string_view, 4> kRight = {"right", "rt", "rechts", "r"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// Letters and the digits after them, in lower case: "L4_ScrewLeft-2" has l4, screw and left.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t first = i;
    while (i < text.size() && is_letter(text[i]) &&
           (i == first || is_capital(text[i - 1]) || !is_capital(text[i]))) {
      ++i;
    }
    const bool has_letters = i > first;
    while (i < text.size() && is_digit(text[i])) {
      ++i;
    }
    if (has_letters) {
      words.push_back(lower_case(text.substr(first, i - first)));
    }
    if (i == first) {
      ++i;
    }
  }
  return words;
}

bool is_level(const std::string& word) {
  return (word.size() == 2 || word.size() == 3) &&
         std::string("ctls").find(word[0]) != std::string::npos && is_digit(word[1]) &&
         is_digit(word.back());
}

std::string as_level(std::string word) {
  word[0] = static_cast<char>(std::toupper(word[0]));
  return word;
}

bool is_one_of(const auto& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

LineName parsed_line_name(const std::string& name) {
  LineName parsed;
  bool after_level = false;
  for (const std::string& word : words_of(name)) {
    parsed.left = parsed.left || is_one_of(kLeft, word) || (after_level && word == "l");
    parsed.right = parsed.right || is_one_of(kRight, word);
    after_level = is_level(word);
    if (after_level) {
      parsed.level = as_level(word);
    }
  }
  return parsed;
}

std::vector<std::string> levels_named(const std::string& name) {
  std::vector<std::string> levels;
  for (const std::string& word : words_of(name)) {
    if (is_level(word)) {
      levels.push_back(as_level(word));
    }
  }
  return levels;
}

}  // namespace orthonav::engine
