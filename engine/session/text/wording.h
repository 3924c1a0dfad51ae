#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/length_text.h"
#include "base/translation.h"
#include "engine/session/log/saving.h"
#include "engine/session/operation_state.h"
#include "engine/session/text/messages.h"
#include "engine/session/text/status_line.h"
#include "nav/registration/check_points.h"
#include "nav/registration/findings.h"

namespace orthonav::engine {

// All words that a surgeon reads are made from data here and, of a step, in its file of steps/: in
// English, or where a WearersLanguage lives, in the wearer's language (base/translation.h). No
// decision ever depends on these texts.
//
// The status line is rewritten for every frame, into strings that keep their capacity: the `append`
// functions do not allocate once the frame loop is warm.

// Values in the formats of what is said.

/// A length for a `%s`: "1.2 mm", "-- mm" if it is not finite.
[[nodiscard]] inline std::string format_mm(double length_m) {
  std::string text;  // shorter than what a string allocates for
  append_mm(text, length_m);
  return text;
}

/// Puts a format around what was appended since `begin`, which takes the place of its `%s`.
inline void enclose(std::string& out, std::size_t begin, std::string_view format) {
  constexpr std::string_view kPlace = "%s";
  const std::size_t place = format.find(kPlace);
  out.insert(begin, format.substr(0, place));
  if (place != std::string_view::npos) {
    out.append(format.substr(place + kPlace.size()));
  }
}

/// Appends a format with a text in the place of its `%s`.
inline void append_with(std::string& out, std::string_view format, std::string_view text) {
  const std::size_t begin = out.size();
  out.append(text);
  enclose(out, begin, format);
}

// The findings of a registration, each as one clause.

/// "left" or "right".
[[nodiscard]] std::string_view word_of(Side side);
/// " (registration only)": follows a bound that leaves out the errors common to all strokes.
void append_registration_only(std::string& out);
/// "digitize the left lamina".
void append(std::string& out, const nav::BonePlace& place);
/// "cranial-caudal shift (0.4 mm at the screws)".
void append(std::string& out, const nav::UncertainMotion& motion);
/// "registration RMSE 3.4 mm, limit 3.0 mm".
void append(std::string& out, const nav::RefusalReason& reason);
/// Every reason, or a text that there is none to name.
void append(std::string& out, std::span<const nav::RefusalReason> reasons);

/// The text of a single finding.
template <class Finding>
[[nodiscard]] std::string text_of(const Finding& finding) {
  std::string out;
  append(out, finding);
  return out;
}

/// A message to the surgeon in words, in several parts where needed.
void write_message(PartedText text, const Message& message);

/// "NOT SAVED" or "NOT RECORDED", in English; null where nothing is amiss.
[[nodiscard]] const char* not_kept_text(Saved saved);

/// "guide L4 left".
void append_step(std::string& out, const StepOnDisplay& at);
/// What follows the step: first a lost tool, which no message may hide, then the message or the
/// state of the step. May be empty. `parts`, if given, receives which parts are dropped first.
void append_detail(std::string& out, const StatusLine& line, StatusParts* parts = nullptr);
/// The detail and the command heard, or a mark once everything is saved: "guide lost | heard:
/// next", "guide lost | ✓".
void append_beside_step(std::string& out, const StatusLine& line, StatusParts* parts = nullptr);
/// "heard: save".
void append_heard(std::string& out, const HeardCommand& heard);
/// "L4 left".
void append_screw(std::string& out, std::string_view level, Side side);
/// Step and detail: "guide L4 left | guide lost".
void append_without_heard(std::string& out, const StatusLine& line);
/// The whole line: "guide L4 left | guide lost | heard: next".
void append_status(std::string& out, const StatusLine& line);
[[nodiscard]] std::string step_text(const StepOnDisplay& at);
[[nodiscard]] std::string detail_text(const StatusLine& line);

/// Why a registration does not count, every reason in one line; empty if it does.
[[nodiscard]] std::string refusal_text(const RegistrationOutcome& outcome);
void append(std::string& out, const Message& message);
/// "pointer: tag 2.0 % larger than stated, check print and unit".
void append_tag_size_off(std::string& out, std::string_view tool, double fraction);

// For `translated`.
namespace words {
inline constexpr const char* kToolLost = translatable("tool lost");
inline constexpr const char* kHeadNotLocated =
    translatable("Head not located: nothing is shown in the world");
inline constexpr const char* kNotYet = translatable("not yet:");
inline constexpr const char* kTouchTheLandmark = translatable("touch the landmark");
inline constexpr const char* kTouchANewLandmark = translatable("touch a new landmark");
inline constexpr const char* kKeepOrRedo =
    translatable("say accept result to keep it, delete last to redo it");
inline constexpr const char* kNoOtherEntry =
    translatable("no other entry stays inside the bone, say accept result to keep it");
/// Between the angle of a bend and its place along the rod.
inline constexpr const char* kAt = translatable("at");
}  // namespace words

}  // namespace orthonav::engine
