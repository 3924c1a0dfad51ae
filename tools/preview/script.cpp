#include "tools/preview/script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "base/printed.h"
#include "engine/io/json_document.h"
#include "engine/io/text_fields.h"

namespace orthonav::preview {
namespace {

/// Longer than any step of an operation takes, even on a slow machine.
constexpr Duration kPatience = std::chrono::seconds(300);

/// Nine hours of pairs.
constexpr double kMaxPairs = 1e6;

constexpr auto kWords = std::to_array<ScriptWord>({
    {"key", Follows::kKey},                           // down and up
    {"press", Follows::kKey},                         // down
    {"release", Follows::kKey},                       // up
    {"say", Follows::kText},                          // as the surgeon says it
    {"until", Follows::kText},                        // waits until the step begins with this
    {"first", Follows::kText},                        // the same, then pauses, shows its first pair
    {"pause", Follows::kNothing},                     // waits until nothing moves any more
    {"pairs", Follows::kWhole, 0, kMaxPairs},         // waits until that many more have passed
    {"scrub", Follows::kWhole, 0, kMaxPairs},         // pauses, waits until that pair is shown
    {"wait", Follows::kWhole, 0, 10'000},             // lets that many pictures of the window go by
    {"drag", Follows::kTwoNumbers, -10'000, 10'000},  // orbits by hundredths of the height
    {"zoom", Follows::kNumber, -100, 100},
    {"hide", Follows::kWhole, 1, kLastHologram},
    {"show", Follows::kWhole, 1, kLastHologram},
    kResize,
    {"screenshot", Follows::kText},
});

/// The words that change the view without waiting.
void change_view(const ScriptLine& line, Look& look, const ScriptStage& stage) {
  const auto two = numbers_in(line.rest, 2).value_or(std::array<double, 2>{});
  const double one = numbers_in(line.rest, 1).value_or(std::array<double, 2>{})[0];
  if (line.word == "drag") {
    look.camera.orbit(0.01 * Vec2{two[0], two[1]});
  } else if (line.word == "zoom") {
    look.camera.zoom(one);
  } else if (line.word == "hide" || line.word == "show") {
    look.holograms.show(static_cast<unsigned>(one), line.word == "show");
  } else if (line.word == "resize") {
    stage.resize(static_cast<int>(two[0]), static_cast<int>(two[1]));
  } else if (line.word == "screenshot") {
    stage.screenshot(line.rest);
  }
}

}  // namespace

std::span<const ScriptWord> script_words() { return kWords; }

std::optional<std::array<double, 2>> numbers_in(const std::string& text, int count) {
  std::istringstream in(text);
  std::array<double, 2> values{};
  for (int i = 0; i < count; ++i) {
    if (!(in >> values[static_cast<std::size_t>(i)])) {
      return std::nullopt;
    }
  }
  std::string more;
  if (in >> more) {
    return std::nullopt;
  }
  return values;
}

Result<Script> Script::load(const std::filesystem::path& path, std::span<const ScriptWord> words) {
  const auto text = engine::read_text(path.string());
  if (!text) {
    return text.error();
  }
  return parse(*text, path.string(), words);
}

Result<Script> Script::parse(const std::string& text, const std::string& name,
                             std::span<const ScriptWord> words) {
  Script script(name, {});
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = engine::trimmed(std::string_view(line).substr(0, line.find('#')));
    if (line.empty()) {
      continue;
    }
    const auto space = line.find(' ');
    ScriptLine parsed{number, line.substr(0, space), {}};
    if (space != std::string::npos) {
      parsed.rest = engine::trimmed(std::string_view(line).substr(space));
    }
    if (const Status known = script.check(parsed, words); !known) {
      return known.error();
    }
    script.lines_.push_back(std::move(parsed));
  }
  return script;
}

Error Script::error(const ScriptLine& line, const std::string& why) const {
  return Error{name_ + ":" + std::to_string(line.number) + ": " + line.word + ": " + why};
}

Status Script::check(const ScriptLine& line, std::span<const ScriptWord> words) const {
  const auto word = std::find_if(words.begin(), words.end(),
                                 [&](const ScriptWord& w) { return w.word == line.word; });
  if (word == words.end()) {
    return Error{name_ + ":" + std::to_string(line.number) + ": unknown script command \"" +
                 line.word + "\""};
  }
  switch (word->follows) {
    case Follows::kNothing:
      if (!line.rest.empty()) {
        return error(line, "nothing may follow it");
      }
      return {};
    case Follows::kText:
      if (line.rest.empty()) {
        return error(line, "lacks what follows it");
      }
      return {};
    case Follows::kKey:
      if (!key_named(line.rest)) {
        return error(line, "there is no key \"" + line.rest + "\"");
      }
      return {};
    case Follows::kWhole:
    case Follows::kNumber:
    case Follows::kTwoWhole:
    case Follows::kTwoNumbers:
      break;
  }
  return check_numbers(line, *word);
}

Status Script::check_numbers(const ScriptLine& line, const ScriptWord& word) const {
  const bool two = word.follows == Follows::kTwoWhole || word.follows == Follows::kTwoNumbers;
  const bool whole = word.follows == Follows::kWhole || word.follows == Follows::kTwoWhole;
  const int count = two ? 2 : 1;
  const auto numbers = numbers_in(line.rest, count);
  if (!numbers) {
    return error(line, two ? "needs two numbers" : "needs a number");
  }
  for (int i = 0; i < count; ++i) {
    const double number = (*numbers)[static_cast<std::size_t>(i)];
    if (!(number >= word.low && number <= word.high) || (whole && number != std::floor(number))) {
      return error(line, printed("%g", number) + " must be a" + (whole ? " whole" : "") +
                             " number from " + printed("%.0f", word.low) + " to " +
                             printed("%.0f", word.high));
    }
  }
  return {};
}

Status Script::advance(PreviewModel& model, const ScriptStage& stage, Timestamp now, bool ended) {
  while (!done()) {
    const ScriptLine& line = lines_[next_];
    if (!perform(line, model, stage)) {
      if (!waits_since_) {
        waits_since_ = now;
      }
      if (ended && line.word != "wait") {
        return error(line, "waits for " + line.rest + ", but nothing more comes");
      }
      if (now - *waits_since_ > kPatience) {
        return error(line, "waited " + std::to_string(seconds(now - *waits_since_)) + " s for " +
                               line.rest + " (limit " + std::to_string(seconds(kPatience)) + " s)");
      }
      return {};
    }
    waits_since_.reset();
    wait_for_pair_.reset();
    waited_ = 0;
    ++next_;
    // A picture shows the result of everything before it, so a call takes at most one.
    if (line.word == "screenshot" || line.word == "resize") {
      return {};
    }
  }
  return {};
}

Status Script::advance(const std::function<Status(const ScriptLine&)>& perform) {
  while (!done()) {
    const ScriptLine& line = lines_[next_++];
    if (const Status performed = perform(line); !performed) {
      return error(line, performed.error().message);
    }
    // A picture shows the result of everything before it, so a call takes at most one.
    if (line.word == "screenshot" || line.word == "resize") {
      return {};
    }
  }
  return {};
}

bool Script::perform(const ScriptLine& line, PreviewModel& model, const ScriptStage& stage) {
  const double one = numbers_in(line.rest, 1).value_or(std::array<double, 2>{})[0];
  if (line.word == "until") {
    const auto shown = model.shown();
    return shown && engine::name_of(shown->at).starts_with(line.rest);
  }
  if (line.word == "first") {
    const auto first = model.timeline().first_of(line.rest);
    if (first) {
      model.scrub_to(first->pair);
    }
    return first != nullptr;
  }
  if (line.word == "pause") {
    if (!model.gate().paused()) {
      model.pause(true);
    }
    return model.at_rest();
  }
  if (line.word == "pairs" || line.word == "scrub") {
    return reaches_pair(static_cast<std::int64_t>(one), line.word == "scrub", model);
  }
  if (line.word == "say") {
    model.say(line.rest);
    return true;
  }
  if (line.word == "wait") {
    return waited_++ >= static_cast<int>(one);
  }
  if (const auto key = key_named(line.rest);
      key && (line.word == "key" || line.word == "press" || line.word == "release")) {
    if (line.word != "release") {
      model.key(*key, true);
    }
    if (line.word != "press") {
      model.key(*key, false);
    }
  }
  change_view(line, model.look(), stage);
  return true;
}

/// Asks for the pair once; true when it is shown.
bool Script::reaches_pair(std::int64_t pair, bool absolute, PreviewModel& model) {
  const auto shown = model.shown();
  if (!wait_for_pair_) {
    wait_for_pair_ = absolute ? pair : model.gate().passed() + pair;
    if (absolute) {
      model.scrub_to(pair);
    }
  }
  return shown && shown->pair >= *wait_for_pair_;
}

}  // namespace orthonav::preview
