#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/line_log.h"
#include "engine/session/known_errors.h"
#include "engine/session/session_observer.h"

namespace orthonav::engine {

/// How a session ended.
struct JournalEnd {
  std::optional<Timestamp> time;  ///< of the last pair; absent: that of the last line
  std::string reason;             ///< what ended it early; empty: nothing
};

/// A screw that is planned to leave the cortex, and why.
struct AcceptedBreach {
  nav::Side side = nav::Side::kLeft;
  std::string reason;
};

/// The plan of one level.
struct PlannedLevel {
  std::string label;
  std::vector<nav::Side> screws;
  std::vector<AcceptedBreach> breaches = {};
};

[[nodiscard]] PlannedLevel planned(const std::string& label,
                                   const std::vector<nav::ScrewPlan>& screws);

/// What the journal says about the whole session, in its first line.
struct JournalHeader {
  std::string version;
  std::string device;  ///< the headset's name
  std::string method;
  std::string case_name;
  std::uint64_t seed = 0;
  std::int64_t epoch_ticks_100ns = 0;  ///< Headset::epoch_ticks_100ns
  std::vector<PlannedLevel> levels;    ///< in the order of the operation
  bool patient_reference = false;      ///< World is attached to one instead of to the headset's map
  std::optional<ErrorsInUse> errors;   ///< that all strokes share
};

/// The event log of a session: one JSON object per line, the first of which is the header. Times
/// are as in file names (`time_100ns`, with the device's epoch) and in nanoseconds of the device's
/// clock (`time_ns`), lengths in mm, angles in degrees. Grows line by line as NAME.part, which
/// stays readable however the process ends; `finish` renames it. A slow file system does not stall
/// the session.
class Journal : public SessionObserver {
 public:
  static Result<std::unique_ptr<Journal>> create(const std::string& path,
                                                 const JournalHeader& header);
  /// Writes the last line and gives the file its name; an Error if any line could not be written.
  Status finish(const JournalEnd& end = {});
  /// Where earlier journals of the same name were moved; empty: there were none.
  [[nodiscard]] const std::string& earlier_kept_as() const { return log_->earlier_kept_as(); }

  void happened(Timestamp time, Step from, Event event, Cell answer) override;
  void asked_from_outside(const Request& request) override;
  void not_understood(const Phrase& phrase) override;
  void registered(Timestamp time, const LevelState& level,
                  const RegistrationOutcome& outcome) override;
  void registration_restored(Timestamp time, const LevelState& level) override;
  void accepted(Timestamp time, const LevelState& level, std::string_view shown) override;
  void check_point_recorded(Timestamp time, const LevelState& level) override;
  void check_point_dropped(Timestamp time, const LevelState& level) override;
  void landmark_touched(Timestamp time, const LevelState& level,
                        const LandmarkTouch& touch) override;
  void tips_compared(Timestamp time, const TipDifference& difference) override;
  void axis_compared(Timestamp time, const AxisDifference& difference) override;
  void landmark_dropped(Timestamp time, const LevelState& level) override;
  void wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                     const PlacedWire& wire) override;
  void screw_redone(Timestamp time, const LevelState& level, std::size_t screw,
                    const nav::OtherEntry& entry) override;
  void replanned(Timestamp time, const LevelState& level, const Replan& asked,
                 const ScrewReplanned& done) override;
  void screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                  const ToolGuidance* at_depth) override;
  void calibration_found(Timestamp time, const CalibrationInUse& found) override;
  void head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) override;
  void head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) override;
  void rod_done(Timestamp time, const RodState& rod) override;

 private:
  Journal(std::unique_ptr<LineLog> log, std::int64_t epoch_ticks_100ns)
      : log_(std::move(log)), epoch_ticks_100ns_(epoch_ticks_100ns) {}
  void tell_registration(Timestamp time, const LevelState& level,
                         const RegistrationOutcome& outcome, bool restored);
  [[nodiscard]] std::int64_t file_ticks(Timestamp time) const {
    return epoch_ticks_100ns_ + ticks_100ns(time);
  }

  std::unique_ptr<LineLog> log_;
  std::int64_t epoch_ticks_100ns_;
  Timestamp newest_{};  ///< time of the newest line
};

}  // namespace orthonav::engine
