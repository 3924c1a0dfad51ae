#include "engine/session/workflow/commands.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "base/angle.h"
#include "base/reason.h"
#include "base/translation.h"
#include "base/units.h"

namespace orthonav::engine {

std::vector<std::string> headset_phrases() {
  std::vector<std::string> phrases;
  for (const Command& command : kCommands) {
    phrases.emplace_back(command.phrase);
    if (command.by_name) {
      phrases.emplace_back(command.name);
    }
  }
  return phrases;
}

std::vector<std::string> spotted_phrases() {
  std::vector<std::string> phrases;
  for (const Command& command : kCommands) {
    if (command.spotted) {
      phrases.emplace_back(command.phrase);
    }
  }
  return phrases;
}

std::optional<Event> command_event(std::string_view text) {
  for (const Command& command : kCommands) {
    if (command.event != Event::kSayReplan && (command.phrase == text || command.name == text)) {
      return command.event;
    }
  }
  return std::nullopt;
}

std::optional<std::string_view> phrase_of(Event event) {
  const auto* const command = std::ranges::find(kCommands, event, &Command::event);
  return command == kCommands.end() || event == Event::kSayReplan ? std::nullopt
                                                                  : std::optional(command->phrase);
}

namespace {

constexpr std::array<std::string_view, 20> kUpToNineteen = {
    "zero",     "one",     "two",     "three",     "four",     "five",    "six",
    "seven",    "eight",   "nine",    "ten",       "eleven",   "twelve",  "thirteen",
    "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"};
constexpr std::array<std::string_view, 8> kTens = {"twenty", "thirty",  "forty",  "fifty",
                                                   "sixty",  "seventy", "eighty", "ninety"};
constexpr double kMaxSaid = 99.9;

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
      !(value <= kMaxSaid)) {
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

namespace {

using nav::ScrewDirection;
using nav::ScrewPart;
using NextSize = NextScrewSize::Which;

constexpr std::array<std::pair<std::string_view, ScrewDirection>, 4> kDirections = {
    {{"cranial", ScrewDirection::kCranial},
     {"caudal", ScrewDirection::kCaudal},
     {"medial", ScrewDirection::kMedial},
     {"lateral", ScrewDirection::kLateral}}};
constexpr std::array<std::pair<std::string_view, ScrewPart>, 3> kScrewParts = {
    {{"move", ScrewPart::kWhole}, {"entry", ScrewPart::kEntry}, {"target", ScrewPart::kTarget}}};
constexpr std::array<std::pair<std::string_view, NextSize>, 4> kNextSizes = {
    {{"longer", NextSize::kLonger},
     {"shorter", NextSize::kShorter},
     {"thicker", NextSize::kThicker},
     {"thinner", NextSize::kThinner}}};
constexpr std::array<std::string_view, 5> kMillimetres = {"mm", "millimetre", "millimetres",
                                                          "millimeter", "millimeters"};
constexpr std::array<std::string_view, 3> kDegreeWords = {"degree", "degrees", "deg"};
constexpr std::array<std::string_view, 2> kBetweenSizes = {"by", "x"};

template <std::size_t N, class Value>
std::optional<Value> meaning(const std::array<std::pair<std::string_view, Value>, N>& words,
                             std::string_view word) {
  const auto found = std::find_if(words.begin(), words.end(),
                                  [word](const auto& known) { return known.first == word; });
  return found == words.end() ? std::nullopt : std::optional<Value>(found->second);
}

constexpr const char* kNotToItsEnd = translatable("use the known form");

/// One line, whatever was typed.
Error unclear(const std::string& verb, const char* problem, const std::string& example) {
  return refused({translatable("%s: %s, such as \"%s\""), {verb, problem, example}});
}

struct SaidStep {
  ScrewDirection direction = ScrewDirection::kCranial;
  double by = 0.0;
};

/// "cranial one", with or without its unit.
Result<SaidStep> step_from(std::span<const std::string> words,
                           std::span<const std::string_view> unit, const std::string& example) {
  const std::string& verb = words[0];
  const auto direction = meaning(kDirections, words.size() > 1 ? words[1] : std::string());
  if (!direction) {
    return unclear(verb, translatable("say cranial, caudal, medial or lateral"), example);
  }
  NumberWords numbers(words.subspan(2));
  const auto by = numbers.take();
  if (!by) {
    return unclear(verb, translatable("say how far"), example);
  }
  (void)numbers.take_word(unit);
  if (!numbers.at_end()) {
    return unclear(verb, kNotToItsEnd, example);
  }
  if (!(*by > 0.0)) {
    return unclear(verb, translatable("say more than zero"), example);
  }
  return SaidStep{*direction, *by};
}

Result<Replan> move_from(std::span<const std::string> words, ScrewPart part) {
  const auto step = step_from(words, kMillimetres, words[0] + " cranial one");
  if (!step) {
    return step.error();
  }
  return Replan(MoveScrew{part, step->direction, step->by * kMetresPerMm});
}

Result<Replan> tilt_from(std::span<const std::string> words) {
  const auto step = step_from(words, kDegreeWords, "tilt cranial two");
  if (!step) {
    return step.error();
  }
  return Replan(TiltScrew{step->direction, step->by * kRadiansPerDegree});
}

Result<Replan> size_from(std::span<const std::string> words) {
  constexpr const char* kExample = "screw six forty five";
  NumberWords numbers(words.subspan(1));
  const auto diameter = numbers.take_diameter();
  (void)(diameter && numbers.take_word(kMillimetres));
  (void)(diameter && numbers.take_word(kBetweenSizes));
  const auto length = diameter ? numbers.take() : std::nullopt;
  if (!length) {
    return unclear("screw", translatable("say diameter and length"), kExample);
  }
  (void)numbers.take_word(kMillimetres);
  if (!numbers.at_end()) {
    return unclear("screw", kNotToItsEnd, kExample);
  }
  return Replan(SetScrewSize{*diameter * kMetresPerMm, *length * kMetresPerMm});
}

Result<Replan> one_size_from(std::span<const std::string> words) {
  const bool diameter = words[0] == "diameter";
  const std::string example = diameter ? "diameter six" : "length forty five";
  NumberWords numbers(words.subspan(1));
  const auto value = numbers.take();
  if (!value) {
    return unclear(words[0], translatable("say a number"), example);
  }
  (void)numbers.take_word(kMillimetres);
  if (!numbers.at_end()) {
    return unclear(words[0], kNotToItsEnd, example);
  }
  const double metres = *value * kMetresPerMm;
  return Replan(diameter ? SetScrewSize{metres, {}} : SetScrewSize{{}, metres});
}

Result<Replan> alone(std::span<const std::string> words, Replan replan) {
  if (words.size() > 1) {
    return refused({translatable("%s: nothing may follow it"), {words[0]}});
  }
  return replan;
}

}  // namespace

std::optional<Result<Replan>> replan_from(std::string_view phrase) {
  const std::vector<std::string> words = words_of(phrase);
  const std::string verb = words.empty() ? std::string() : words[0];
  if (const auto part = meaning(kScrewParts, verb)) {
    return move_from(words, *part);
  }
  if (const auto which = meaning(kNextSizes, verb)) {
    return alone(words, NextScrewSize{*which});
  }
  if (verb == "tilt") {
    return tilt_from(words);
  }
  if (verb == "screw") {
    return size_from(words);
  }
  if (verb == "diameter" || verb == "length") {
    return one_size_from(words);
  }
  if (verb == "undo") {
    return alone(words, UndoChange{});
  }
  return std::nullopt;
}

}  // namespace orthonav::engine
