#include "engine/session/spoken_replan.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "base/units.h"
#include "engine/session/number_words.h"

namespace orthonav::engine {
namespace {

using nav::ScrewDirection;
using nav::ScrewPart;
using Which = NextScrewSize::Which;

constexpr std::array<std::pair<std::string_view, ScrewDirection>, 4> kDirections = {
    {{"cranial", ScrewDirection::kCranial},
     {"caudal", ScrewDirection::kCaudal},
     {"medial", ScrewDirection::kMedial},
     {"lateral", ScrewDirection::kLateral}}};
constexpr std::array<std::pair<std::string_view, ScrewPart>, 3> kParts = {
    {{"move", ScrewPart::kWhole}, {"entry", ScrewPart::kEntry}, {"target", ScrewPart::kTarget}}};
constexpr std::array<std::pair<std::string_view, Which>, 4> kNextSizes = {
    {{"longer", Which::kLonger},
     {"shorter", Which::kShorter},
     {"thicker", Which::kThicker},
     {"thinner", Which::kThinner}}};
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

constexpr const char* kNotToItsEnd = translatable("not understood to its end, say it");

/// One line, whatever was typed.
Error unclear(const std::string& verb, const char* problem, const std::string& example) {
  return Error{
      printed(translatable("%s: %s, such as \"%s\""), verb.c_str(), problem, example.c_str())};
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
    return Error{printed(translatable("%s: stands alone"), words[0].c_str())};
  }
  return replan;
}

}  // namespace

std::optional<Result<Replan>> replan_from(std::string_view phrase) {
  const std::vector<std::string> words = words_of(phrase);
  const std::string verb = words.empty() ? std::string() : words[0];
  if (const auto part = meaning(kParts, verb)) {
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

std::vector<std::string> replan_phrases() {
  std::vector<std::string> phrases;
  for (const std::string verb : {"move ", "tilt "}) {
    for (const auto& direction : kDirections) {
      phrases.push_back(verb + std::string(direction.first) + " one");
    }
  }
  for (const auto& size : kNextSizes) {
    phrases.emplace_back(size.first);
  }
  phrases.emplace_back("undo");
  return phrases;
}

}  // namespace orthonav::engine
