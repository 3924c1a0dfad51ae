#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "engine/session/replan.h"
#include "engine/session/workflow.h"

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

/// What is said for each command, lower case: "go to next". Keys, scripts and logs use a command's
/// name: "next".
[[nodiscard]] std::vector<std::string> spoken_commands();

/// Those that our own recognition knows. The others come from the headset's recognition and from
/// scripts; the session also detects by itself what they announce.
[[nodiscard]] std::vector<std::string> recognized_commands();

/// What a phrase or a command's name asks for; nothing if it is not a command.
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
