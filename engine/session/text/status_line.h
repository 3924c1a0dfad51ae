#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "engine/session/guide_checks.h"
#include "engine/session/landmark.h"
#include "engine/session/log/saving.h"
#include "engine/session/placed_wire.h"
#include "engine/session/shown_status.h"
#include "engine/session/text/messages.h"
#include "engine/session/touched_heads.h"
#include "engine/session/work_watch.h"
#include "nav/registration/check_points.h"

namespace orthonav::engine {

/// Priority of a part of the status line when there is no room for all: the last is dropped first.
enum class Importance {
  kDanger,   ///< what must not be trusted now: a lost tool, a moved map
  kNext,     ///< what to do
  kMessage,  ///< what happened, and the first reason
  kHeard,    ///< the command as heard
  kMore,     ///< the other reasons
  kFigures,  ///< how good the registration is
  kCount     ///< how much there is
};

/// A part of a text, up to the beginning of the next part.
struct StatusPart {
  Importance importance = Importance::kMessage;
  std::size_t begin = 0;
  std::size_t separator = 0;  ///< bytes at the beginning that are dropped at the start of a row
};

/// The parts of a text, in order. Parts beyond `kMost` are merged into the last.
struct StatusParts {
  static constexpr std::size_t kMost = 24;
  std::array<StatusPart, kMost> parts{};
  std::size_t count = 0;

  void clear() { count = 0; }
  void add(const StatusPart& part) {
    if (count < kMost) {
      parts[count++] = part;
    }
  }
};

/// A text being written and, if wanted, where its parts begin.
struct PartedText {
  std::string& out;
  StatusParts* parts = nullptr;

  /// Begins a new part with what is appended next.
  void begin(Importance importance, std::string_view separator = "") {
    if (parts != nullptr) {
      parts->add({importance, out.size(), separator.size()});
    }
    out += separator;
  }
};

struct Coaching;

// The state of each step, as the status line shows it while there is nothing more urgent.

/// While the bone is stroked.
struct StrokesSoFar {
  std::size_t points = 0;
  const Coaching* coaching = nullptr;  ///< null: nothing is known about them yet
};
/// A registration that is verified by eye alone, or was.
struct ByEye {};
/// While a registration is verified by touch.
struct ChecksSoFar {
  const nav::CheckVerdict* verdict = nullptr;
  /// How far the landmark has moved, so that the registration is verified again.
  std::optional<double> moved_m = {};
};
/// A registration accepted by touch, before a screw.
struct LandmarkSoFar {
  bool recorded = false;              ///< the landmark was touched before
  std::optional<LandmarkTouch> last;  ///< newest touch since the last screw
  const TipCheck* tips = nullptr;     ///< of the guide and the pointer; null: not compared
  const AxisCheck* axis = nullptr;    ///< of the guide, by earlier wires; null: not checked
};
/// While a wire is in the bone, before its screw is done.
struct WireSoFar {
  const PlacedWire* wire = nullptr;  ///< null: not measured
  bool no_other_entry = false;       ///< it can't be redone
};
struct HeadsSoFar {
  std::size_t count = 0;
  std::optional<double> cut_length_m;  ///< of the rod through them, if it has instructions
  std::size_t bends = 0;
  std::optional<HeadTouch> last = {};  ///< the newest touch
  /// The head that is to be touched again, since the rod is not sure to lie within 1.0 mm of all;
  /// from 0.
  std::optional<std::size_t> touch_again = {};
  /// No plan says whether this side has a rod: the surgeon does, by touching heads or by "done".
  bool unplanned = false;
  /// The rod is taken to lie this far from the touched places, towards the bone, since no planned
  /// screw tells it.
  std::optional<double> seat_by_pointer_m = {};
};
using StepState = std::variant<std::monostate, StrokesSoFar, ByEye, ChecksSoFar, LandmarkSoFar,
                               WireSoFar, HeadsSoFar>;

/// Everything that the status line says, as data; engine/session/text/wording.h turns it into text.
/// The pointers and views look into the session: valid until its next step.
struct StatusLine {
  StepOnDisplay at;
  std::string_view tool;   ///< of the step, if it has one
  bool tool_lost = false;  ///< it was seen before
  /// The two cameras' pictures contradict each other, so that nothing is measured.
  bool pictures_apart = false;
  std::optional<double> tag_size_off;  ///< its tag is larger than stated by this fraction
  /// How far the guide's depth stop lets the drill go past the target of the selected screw.
  std::optional<double> stop_past_target_m;
  std::string_view unused_tool;      ///< in hand, with a role that the step does not use
  const Message* message = nullptr;  ///< null: none
  StepState state;
  const HeardCommand* heard = nullptr;  ///< null: nothing recently
  Saved saved = Saved::kNothingNew;
  std::optional<Part> stalled;  ///< hangs, so nothing is guided
  bool no_clicker = false;      ///< it is not there now
};

/// What is asked of a surgeon who verifies by touch, as far as the line says it.
[[nodiscard]] ChecksAsked checks_asked(const StatusLine& line);

}  // namespace orthonav::engine
