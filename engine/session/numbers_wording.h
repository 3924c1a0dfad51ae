#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/translation.h"
#include "nav/guidance/drill_watch.h"
#include "nav/guidance/screw_numbers.h"
#include "nav/guidance/shown_clearance.h"

namespace orthonav::engine {

// The numbers of step `guide` in a surgeon's words (part of engine/session/wording.h). Like the
// dots of the target cross, they say where the tip is and where the tool aims, never where to go.

/// The four numbers in reading order.
enum class NumberRow : std::size_t { kTipCranial, kTipMedial, kAimCranial, kAimMedial };
inline constexpr std::size_t kNumberRows = 4;

[[nodiscard]] const nav::ShownNumber& number_of(const nav::ScrewNumbers& numbers, NumberRow row);
/// "1.2 mm cranial"; "0.0 mm"; if uncertain, "1.2 ± 0.8 mm cranial", and "1.2 ± -- mm cranial" if
/// the uncertainty is unknown.
void append_number(std::string& out, const nav::ScrewNumbers& numbers, NumberRow row);
// A single number that is not sure is its bound, "≤ 2.6 mm"; "2.6 mm?" where nobody knows.

/// "1.2°".
void append_angle(std::string& out, const nav::ShownSize& angle);
/// "tip 0.4 mm".
void append_offset(std::string& out, const nav::ShownSize& offset);
/// "12.3 mm to entry", "31.0 mm to target", "1.2 mm past target"; a bound of what is left begins
/// with "≥".
void append_depth(std::string& out, const nav::ShownDepth& depth);
/// "63 mm".
void append_rounded_mm(std::string& out, double length_m);
[[nodiscard]] bool all_sure(const nav::ScrewNumbers& numbers);

/// "2.4 mm"; "-0.4 mm" with a real minus sign, U+2212.
void append_clearance(std::string& out, int tenths);
/// "may break through medially", or "breaks through medially" if the clearance itself is below 0.
void append_breach(std::string& out, const nav::ShownClearance& clearance);
/// All in one line: "clearance 2.4 mm, at least 1.1 mm"; "clearance 0.4 mm: may break through
/// medially"; "clearance 2.4 mm" if the bound is not known. `registration_only`: the bound leaves
/// out the errors common to all strokes, and says so.
void append_clearance_line(std::string& out, const nav::ShownClearance& clearance,
                           bool registration_only = false);

/// Of a drill in the bone: "drilling", "stop"; "stop, tool not seen" while the tool is hidden.
void append_drill(std::string& out, const nav::DrillView& drill);
/// Whether the stop is too deep by a tenth of a millimetre or more.
[[nodiscard]] bool stop_too_deep(const nav::DrillView& drill);
/// "stop lets the drill 4 mm past the target", rounded up.
void append_stop_too_deep(std::string& out, double past_target_m);

// For `translated`.
namespace words {
inline constexpr const char* kClearance = translatable("clearance");
inline constexpr const char* kAtLeast = translatable("at least");
inline constexpr const char* kTip = translatable("tip");
inline constexpr const char* kAims = translatable("aims");
inline constexpr const char* kToEntry = translatable("to entry");
inline constexpr const char* kToTarget = translatable("to target");
inline constexpr const char* kPastTarget = translatable("past target");
inline constexpr const char* kSdOfRegistrationOnly = translatable("± registration only");
}  // namespace words

}  // namespace orthonav::engine
