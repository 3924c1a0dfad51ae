#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/session/status_line.h"
#include "nav/registration/check_points.h"
#include "nav/registration/findings.h"

namespace orthonav::engine {

struct Coaching;

// The findings of a registration in words: a part of engine/session/wording.h. Each is appended as
// one clause, without allocating if the string has enough capacity.

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
/// What is wrong with the check points, and what to do; nothing if all is well.
void append(std::string& out, const nav::CheckAdvice& advice);

/// "expected error 0.6 mm, digitize the left lamina".
void append(std::string& out, const Coaching& coaching);
/// The same in parts; the separator comes before the first.
void write_coaching(PartedText text, const Coaching& coaching, std::string_view separator);

/// The text of a single finding.
template <class Finding>
[[nodiscard]] std::string text_of(const Finding& finding) {
  std::string out;
  append(out, finding);
  return out;
}

}  // namespace orthonav::engine
