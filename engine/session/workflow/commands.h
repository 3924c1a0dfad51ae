#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "engine/session/replan.h"
#include "engine/session/workflow/workflow.h"

namespace orthonav::engine {

/// A request of another program: the words that would be said in the room, or a new plan of a
/// screw. It is answered as if it had been said at `time`.
struct Request {
  std::string text;  ///< "next"; with a change, its description: "plan L4 left"
  std::string from;  ///< who asks, for the surgeon and the log
  Timestamp time{};
  std::optional<Replan> change;  ///< of the current screw
};

class Requests {
 public:
  virtual ~Requests() = default;
  /// Appends the requests up to `until`, in order of time, each once. Does not block.
  virtual void take(Timestamp until, std::vector<Request>& requests) = 0;
};

/// What can be said, and who listens for it. Every device has its phrases and keys from here.
struct Command {
  std::string_view name;    ///< what keys, scripts, logs and other programs call it: "next"
  std::string_view phrase;  ///< what is said, lower case: "go to next"
  Event event;              ///< of a change of the screw: kSayReplan; `replan_from` reads which
  char key = '\0';          ///< in the preview; 0: none
  /// Our own recognition listens for it too. What the others announce, the session also detects.
  bool spotted = false;
  bool by_name = false;  ///< a headset's own recognition takes its name too
};

// Phrases are long and unlike what else is said in a room: words of one syllable sound like too
// many others ("stop" like "start"). A headset's recognition takes one step of a move or tilt;
// `replan_from` takes any.
inline constexpr auto kCommands = std::to_array<Command>({
    {"start", "begin guiding", Event::kSayStart, 's', true},
    {"save", "save points", Event::kSaySave, 'v', true, true},      // by name as well,
    {"delete", "delete last", Event::kSayDelete, 'd', true, true},  // as in the publication
    {"accept", "accept result", Event::kSayAccept, 'a', true},
    {"reject", "reject level", Event::kSayReject, 'r', true},
    {"next", "go to next", Event::kSayNext, 'n', true},
    {"done", "finish rod", Event::kSayDone, 'f', true},
    {"move rod", "move template", Event::kSayMoveRod, 'm', true},
    {"twin", "twin screw", Event::kSayTwin, 't', true},
    {"numbers", "show numbers", Event::kSayNumbers, 'w'},
    {"drill", "drill", Event::kSayDrill},
    {"move cranial one", "move cranial one", Event::kSayReplan, 'y'},
    {"move caudal one", "move caudal one", Event::kSayReplan, 'b'},
    {"move medial one", "move medial one", Event::kSayReplan, 'g'},
    {"move lateral one", "move lateral one", Event::kSayReplan, 'j'},
    {"tilt cranial one", "tilt cranial one", Event::kSayReplan},
    {"tilt caudal one", "tilt caudal one", Event::kSayReplan},
    {"tilt medial one", "tilt medial one", Event::kSayReplan},
    {"tilt lateral one", "tilt lateral one", Event::kSayReplan},
    {"longer", "longer", Event::kSayReplan, ']'},
    {"shorter", "shorter", Event::kSayReplan, '['},
    {"thicker", "thicker", Event::kSayReplan, '.'},
    {"thinner", "thinner", Event::kSayReplan, ','},
    {"undo", "undo", Event::kSayReplan, 'z'},
});

/// What a headset's own recognition is told to listen for: every phrase.
[[nodiscard]] std::vector<std::string> headset_phrases();
/// What our own recognition listens for.
[[nodiscard]] std::vector<std::string> spotted_phrases();

/// What a phrase or a name asks for; nothing if it is no command, or a change of the screw.
[[nodiscard]] std::optional<Event> command_event(std::string_view text);

/// What is said for an event; nothing if it is not a command.
[[nodiscard]] std::optional<std::string_view> phrase_of(Event event);

/// The words of a phrase, split at spaces, in lower case.
[[nodiscard]] std::vector<std::string> words_of(std::string_view phrase);

/// Reads spoken and typed numbers from words, one after another. Words that it does not understand
/// are not consumed.
class NumberWords {
 public:
  explicit NumberWords(std::span<const std::string> words) : words_(words) {}

  /// "six", "forty five", "twelve point five", "half", "two and a half", "6.5": from 0 to 99.9.
  [[nodiscard]] std::optional<double> take();
  /// A diameter as surgeons say it before a length: also "six five" for 6.5 if another number
  /// follows.
  [[nodiscard]] std::optional<double> take_diameter();
  /// Takes the next word if it is one of these.
  [[nodiscard]] bool take_word(std::span<const std::string_view> any_of);
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  [[nodiscard]] std::string_view word(std::size_t ahead = 0) const {
    return next_ + ahead < words_.size() ? std::string_view(words_[next_ + ahead])
                                         : std::string_view();
  }
  [[nodiscard]] std::optional<double> take_whole();
  [[nodiscard]] double take_fraction();

  std::span<const std::string> words_;
  std::size_t next_ = 0;
};

/// The change of the current screw that a phrase asks for; nothing if it does not begin like such a
/// phrase. A one-line Error if it does, but the rest is missing or not understood: nothing is
/// guessed. Lengths are in mm and angles in degrees, whether said or not; typed numbers work like
/// words.
///
///     screw six forty five       6 × 45 mm; "six five forty" and "six point five forty": 6.5 × 40
///     diameter six, length forty five, thicker, thinner, longer, shorter
///     move cranial one           the whole screw; also entry, target; caudal, medial, lateral
///     tilt medial two            about its entry
///     undo
[[nodiscard]] std::optional<Result<Replan>> replan_from(std::string_view phrase);

}  // namespace orthonav::engine
