#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "engine/session/replan.h"
#include "engine/session/shown_status.h"
#include "engine/session/workflow/workflow.h"
#include "hal/api/devices.h"
#include "hal/api/repeat_watch.h"
#include "nav/registration/check_points.h"
#include "nav/registration/findings.h"

namespace orthonav::engine {

/// Why a touched place does not count.
struct TouchRefusal {
  enum class Kind : std::uint8_t {
    kPressAgain,  ///< the press fell into another step
    kPointerNotSeen,
    kTipMoved,  ///< by `value_m` (root mean square), above `limit_m`
    kHeldTooLong,
    kTooMany,       ///< there are nav::kMaxCheckPoints already
    kTouchesApart,  ///< touches of one place differ by `value_m`, above `limit_m`
    kTooNear,       ///< `value_m` from a patient reference, at least `limit_m` needed
    // For the sleeve over a wire.
    kGuideNotSeen,
    kReferenceNotSeen,
    kSleeveTurned,    ///< by `turn_rad` (root mean square), above `turn_limit_rad`
    kOffTheScrew,     ///< its axis passes the entry at `value_m`, limit `limit_m`
    kAcrossTheScrew,  ///< it is turned off the plan by `turn_rad`, limit `turn_limit_rad`
    kEntryUnsure,     ///< SD `value_m` of the wire's place, limit `limit_m`
    kAngleUnsure,     ///< SD `turn_rad` of its angle, limit `turn_limit_rad`
  };
  Kind kind = Kind::kPressAgain;
  double value_m = 0.0;
  double limit_m = 0.0;
  double turn_rad = 0.0;
  double turn_limit_rad = 0.0;
};

// What the surgeon must be told, as data; engine/session/text/wording.h turns it into text.

struct NotPossibleNow {
  Event event;
};
struct NotUnderstood {};
/// "accept" was said before the registration was shown.
struct SaidBeforeShown {};
struct NothingToDelete {
  enum class What : std::uint8_t { kRegion, kCheckPoint, kHead, kLandmark, kWire };
  What what;
};
/// The last saved region will be deleted if "delete" is said again.
struct ConfirmDelete {
  std::size_t points;
};
struct RegistrationRefused {
  std::vector<nav::RefusalReason> reasons;
  std::optional<Error> error;  ///< in place of reasons: no registration was found at all
  std::optional<nav::BonePlace> stroke_next;
  bool another_level_fits = false;
};
/// "accept" was said while the check points do not confirm the registration.
struct ChecksMissing {
  nav::CheckAdvice advice;
};
struct TouchNotRecorded {
  enum class What : std::uint8_t { kCheckPoint, kHead, kLandmark, kGuideTip, kWire };
  What what;
  TouchRefusal why;
};
/// "next" was said before the landmark was touched.
struct LandmarkMissing {
  bool recorded = false;  ///< it was recorded before
};
/// The guide's tip was corrected by this distance from the pointer's at the same landmark.
struct TipCorrected {
  double by_m = 0.0;
};
/// The guide's axis was corrected by this angle, as measured by its sleeve on a wire.
struct AxisCorrected {
  double by_rad = 0.0;
};
/// The landmark was touched `off_m` from where it was recorded.
struct LandmarkMoved {
  double off_m = 0.0;
  double limit_m = 0.0;
  bool anchored =
      false;  ///< to a patient reference, so that movement together with it stays undetected
};
/// The time since the bone was last found where its registration puts it, and how far the map may
/// have drifted since: two SDs along an axis.
struct BoneUnchecked {
  double for_s = 0.0;
  double drift_m = 0.0;
};
/// "next" was said of a wire beyond a limit, before it was kept or redone.
struct WireUndecided {};
/// There is no other entry through which the screw stays inside the bone.
struct NoOtherEntry {};
/// A screw that was redone `redone` times is redone again if "delete" is said again.
struct ConfirmRedo {
  int redone = 0;
};
/// A screw is redone through another entry.
struct ScrewRedone {
  double from_hole_m = 0.0;
  double clearance_m = 0.0;  ///< to the cortex, as planned now
};
/// A change of the screw was said, but not fully understood.
struct ReplanUnclear {
  Error why;
};
struct NoRod {
  Error why;
};
struct MapMoved {
  Step step;
};
/// References moved against each other.
struct ReferenceMoved {
  Step step;
};
/// The cameras deliver no images, or only old ones.
struct NoImages {
  std::optional<Repeated> repeats = {};
};
struct Ended {};

/// Nothing, or one of these.
using Message =
    std::variant<std::monostate, NotPossibleNow, NotUnderstood, SaidBeforeShown, NothingToDelete,
                 ConfirmDelete, RegistrationRefused, ChecksMissing, TouchNotRecorded,
                 LandmarkMissing, LandmarkMoved, BoneUnchecked, TipCorrected, AxisCorrected,
                 WireUndecided, NoOtherEntry, ConfirmRedo, ScrewRedone, ReplanUnclear,
                 ReplanRefusal, ScrewReplanned, NoRod, MapMoved, ReferenceMoved, NoImages, Ended>;

/// Whether it is about a change of the screw; the step's request then stays visible beside it.
[[nodiscard]] inline bool is_about_replan(const Message& message) {
  return std::holds_alternative<ReplanUnclear>(message) ||
         std::holds_alternative<ReplanRefusal>(message) ||
         std::holds_alternative<ScrewReplanned>(message);
}
/// Whether it says that a command had no effect, or none until it is said again.
[[nodiscard]] bool is_refusal(const Message& message);
/// The subject of the message, for the display.
[[nodiscard]] Notice notice_of(const Message& message);

/// The command as heard. A surgeon who was misheard must see it at once, and one who was heard need
/// not ask.
struct HeardCommand {
  std::string phrase;
  bool sure = false;      ///< confident enough to be acted on
  std::string from = {};  ///< who asked, unless it was said in the room
};

/// The message to the surgeon, until they do something that is accepted, and the phrase heard; both
/// expire after a while.
class Messages {
 public:
  Messages(Duration message_for, Duration heard_for)
      : message_for_(message_for), heard_for_(heard_for) {}

  void say(Message message, Timestamp time);
  /// A surgeon who was misheard must see it at once, and one who was heard need not ask. `from`:
  /// who asked, unless it was said in the room.
  void echo(const Phrase& phrase, bool sure, const std::string& from = {});
  /// Something was accepted, so the last message is settled.
  void clear() { message_ = {}; }
  void expire(Timestamp now);
  /// How often anything was said.
  [[nodiscard]] std::int64_t said() const { return said_; }
  /// Null: none.
  [[nodiscard]] const Message* message() const {
    return std::holds_alternative<std::monostate>(message_) ? nullptr : &message_;
  }
  [[nodiscard]] const HeardCommand* heard() const { return heard_ ? &*heard_ : nullptr; }

 private:
  Duration message_for_;
  Duration heard_for_;
  Message message_;
  Timestamp message_until_{};
  std::int64_t said_ = 0;
  std::optional<HeardCommand> heard_;
  Timestamp heard_until_{};
};

/// An event that the engine detects while it answers another one or processes a pair. A function
/// that returns one does nothing more: the session answers it next.
struct FollowUpEvent {
  /// Implicit: most events bring no message.
  FollowUpEvent(Event what, Message message = {}) : event(what), then_say(std::move(message)) {}

  Event event;
  /// Said after the event was answered, because the answer clears earlier messages.
  Message then_say;
};

}  // namespace orthonav::engine
