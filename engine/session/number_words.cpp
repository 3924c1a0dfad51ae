#include "engine/session/number_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace orthonav::engine {
namespace {

constexpr std::array<std::string_view, 20> kUpToNineteen = {
    "zero",     "one",     "two",     "three",     "four",     "five",    "six",
    "seven",    "eight",   "nine",    "ten",       "eleven",   "twelve",  "thirteen",
    "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"};
constexpr std::array<std::string_view, 8> kTens = {"twenty", "thirty",  "forty",  "fifty",
                                                   "sixty",  "seventy", "eighty", "ninety"};
constexpr double kMostSaid = 99.9;

std::optional<int> place_in(std::span<const std::string_view> words, std::string_view word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    return std::nullopt;
  }
  return static_cast<int>(found - words.begin());
}

/// A digit from `least` to nine.
std::optional<int> digit_word(std::string_view word, int least) {
  const auto digit = place_in(std::span(kUpToNineteen).first(10), word);
  return digit && *digit >= least ? digit : std::nullopt;
}

std::optional<double> typed_number(std::string_view word) {
  const bool digits = !word.empty() && word.find_first_not_of("0123456789.") == word.npos;
  double value = 0.0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
  if (!digits || read.ec != std::errc() || read.ptr != word.data() + word.size() ||
      !(value <= kMostSaid)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

std::vector<std::string> words_of(std::string_view phrase) {
  std::vector<std::string> words;
  bool within = false;
  for (const char c : phrase) {
    const bool space = c == ' ' || c == '\t';
    if (!space) {
      if (!within) {
        words.emplace_back();
      }
      words.back() += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    within = !space;
  }
  return words;
}

bool NumberWords::take_word(std::span<const std::string_view> any_of) {
  const bool found = !at_end() && place_in(any_of, word()).has_value();
  next_ += found ? 1 : 0;
  return found;
}

/// Takes nothing if no number comes next.
std::optional<double> NumberWords::take_whole() {
  if (const auto tens = place_in(kTens, word())) {
    ++next_;
    const auto ones = digit_word(word(), 1);
    next_ += ones ? 1 : 0;
    return 20.0 + 10.0 * *tens + ones.value_or(0);
  }
  if (const auto small = place_in(kUpToNineteen, word())) {
    ++next_;
    return *small;
  }
  if (const auto typed = typed_number(word())) {
    ++next_;
    return typed;
  }
  return std::nullopt;
}

/// What follows a whole number: ".5" of "six point five".
double NumberWords::take_fraction() {
  if (word() == "point" && digit_word(word(1), 0)) {
    next_ += 2;
    return 0.1 * *digit_word(words_[next_ - 1], 0);
  }
  if (word() == "and" && word(1) == "a" && word(2) == "half") {
    next_ += 3;
    return 0.5;
  }
  return 0.0;
}

std::optional<double> NumberWords::take() {
  if (word() == "half") {
    ++next_;
    return 0.5;
  }
  if (word() == "point" && digit_word(word(1), 0)) {
    return take_fraction();
  }
  auto whole = take_whole();
  if (whole) {
    *whole += take_fraction();
  }
  return whole;
}

std::optional<double> NumberWords::take_diameter() {
  auto diameter = take();
  const bool whole = diameter && *diameter == std::floor(*diameter) && *diameter < 20.0;
  const auto tenth = digit_word(word(), 0);
  if (!whole || !tenth) {
    return diameter;
  }
  NumberWords after = *this;
  ++after.next_;
  // "six five forty five" is 6.5 and 45; "six five" alone leaves five for the length.
  if (after.take()) {
    ++next_;
    *diameter += 0.1 * *tenth;
  }
  return diameter;
}

}  // namespace orthonav::engine
