#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/translation.h"
#include "engine/session/guidance.h"
#include "engine/session/log/operation_json.h"
#include "engine/session/session_state.h"
#include "engine/session/tool_in_vertebra.h"
#include "nav/guidance/drill_watch.h"
#include "nav/guidance/screw_numbers.h"
#include "nav/guidance/shown_clearance.h"

namespace orthonav::engine {

class GuideChecks;
class Placing;

/// A tip farther off the planned axis is not at the screw. Depth along the axis alone would include
/// a tool laid down beside the patient.
inline constexpr double kOffTheScrew_m = 0.015;

/// The step in which screws are guided.
class Guiding {
 public:
  /// Selects the level's first screw that is not done, or its first.
  void select_open_screw(const LevelState& level);
  /// Another level begins: guidance of the previous one no longer applies.
  void begin_level();
  /// All guidance so far is void; the screw stays selected.
  void forget_guidance() { approach_ = {}; }
  /// The tool was not measured in this pair: drops what was based on the last measurement.
  void lose_measurement();
  /// The surgeon said "drill".
  void begin_drill() { approach_.drill.begin(); }
  void toggle(bool OnRequest::*what) { asked_.*what = !(asked_.*what); }
  /// The selected screw is done, with its wire where one was placed.
  [[nodiscard]] Event finish_screw(SessionState& work, const Placing& placing,
                                   Timestamp time) const;

  [[nodiscard]] std::size_t screw() const { return screw_; }
  [[nodiscard]] const nav::DrillView& drill() const { return approach_.drill.view(); }
  /// Clearance of the selected screw if it were driven along the tool's axis; none if the tool is
  /// not near the plan (15 mm, 30°). Where the registration's uncertainty is known, takes the
  /// tool's relative to the bone into account, and how far a drill goes astray (`DrillSkiving`).
  /// Allocates nothing.
  [[nodiscard]] std::optional<nav::ScrewClearance> clearance_along(
      const LevelState& level, const nav::TrackedPose& pose, const nav::ToolGeometry& tool,
      const DrillSkiving& astray) const;
  /// Writes the selected screw and, in this step, the tool relative to it unless guidance is
  /// hidden.
  void write(const SessionState& work, const GuideChecks& checks, bool hidden, Guidance& out);

 private:
  /// What was measured on the way to the selected screw.
  struct Approach {
    /// The last measurement with the tool at its greatest depth along the screw. Poses after its
    /// withdrawal do not count.
    std::optional<ToolGuidance> at_depth;
    nav::TrackedPose pose_at_depth;  ///< of the tool, if there is an `at_depth`
    double deepest_m = 0.0;          ///< the greatest depth past the entry so far
    nav::ScrewNumberWriter numbers;
    nav::ScrewSizeWriter sizes;
    nav::DepthWriter depth;
    nav::ClearanceWriter clearance;
    nav::DrillWatch drill;
    bool drilled = false;  ///< since the approach began
    bool was_set = false;  ///< on the bone at the entry, or drilled
    nav::TrajectoryAtDepth path;

    /// Feeds the drill's watch. The first time that the tip is set on the bone at the entry, what
    /// was measured on the way there is forgotten: beside the screw a tip may lie deeper than where
    /// it is set, as at the landmark, and a sleeve never gets deeper than there.
    void watch_drill(const nav::DrillReading& reading);
  };

  /// The tool relative to the selected screw. Absent without a fresh pose to guide on.
  [[nodiscard]] std::optional<ToolGuidance> guide(const SessionState& work, Timestamp now,
                                                  Timestamp display_time);
  /// Feeds the tool's pose measured in this pair to numbers, drill and path.
  void take_measurement(ToolGuidance& guidance, const LevelState& level,
                        const nav::TrackedPose& pose, const nav::ToolGeometry& tool);
  void remember_depth(const ToolGuidance& guidance, const nav::ScrewGuidance& measured,
                      const nav::TrackedPose& pose);
  [[nodiscard]] ToolInVertebra in_bone(const LevelState& level, const nav::TrackedPose& pose,
                                       const nav::ToolGeometry& tool) const;
  /// Adds `clearance_along`, and its displayed form, to guidance on a measurement.
  void add_clearance(ToolGuidance& guidance, const SessionState& work, const nav::TrackedPose& pose,
                     const nav::ToolGeometry& tool);

  ToolErrors errors_;  ///< of the tool in this pair; World's drift is in the level (BoneFound)
  std::size_t screw_ = 0;
  Approach approach_;
  OnRequest asked_;
};

// Its records in the log; `json` holds time and level already.

/// Of a screw that is done.
void log_screw(LogJson& json, const LevelState& level, std::size_t screw,
               const ToolGuidance* at_depth);
void read_screw(const JsonNode& node, Timestamp time, ScrewState& screw);

// Its numbers in a surgeon's words. Like the dots of the target cross, they say where the tip is
// and where the tool aims, never where to go.

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
