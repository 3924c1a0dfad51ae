#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/io/record_writer.h"
#include "engine/session/log/logged_operation.h"
#include "engine/session/log/operation_json.h"
#include "engine/session/log/saving.h"
#include "engine/session/log/session_observer.h"

namespace orthonav::engine {

/// The log of an operation, `operation.resume` in its folder: everything that happens in its
/// session, each event a record in SI units. Another program resumes the operation from it, and
/// reports are made of it (docs/journal.md). The folder is locked meanwhile. A slow file system
/// does not stall the session, and a disk failure does not end it.
class OperationLog : public SessionObserver, public SaveWatch {
 public:
  /// Creates the log of an operation that has not begun.
  static Result<std::unique_ptr<OperationLog>> begin(Env& env, const std::string& folder,
                                                     const OperationIdentity& identity,
                                                     std::span<const LevelState> levels,
                                                     RecordWriter::Waits waits,
                                                     RecordLog::Earlier earlier);

  /// The last operation of a folder, which stays locked.
  struct Found {
    LoggedOperation operation;
    std::string path;
    std::unique_ptr<FolderLock> lock;
  };
  /// The log of the last operation in a folder; an Error, `kNotFound`, if there is none.
  static Result<std::string> path_in(Env& env, const std::string& folder);
  /// Changes nothing in the folder. A one-line Error if there is no log or it can't be read.
  static Result<Found> find(Env& env, const std::string& folder);
  /// Continues its log, on a device whose clock began at `epoch_100ns`. If the disk can't be
  /// written to any more, the operation goes on unsaved, and `written` says why.
  static std::unique_ptr<OperationLog> reopen(Env& env, Found found, RecordWriter::Waits waits,
                                              std::int64_t epoch_100ns = 0);

  /// Removes a new log in which nothing was recorded, unless `finish` was called.
  ~OperationLog() override;
  OperationLog(const OperationLog&) = delete;
  OperationLog& operator=(const OperationLog&) = delete;

  /// Writes the last record: whether the operation was done, or why it ended, and the time of the
  /// last pair, where it is known. An Error if not everything was saved.
  Status finish(bool done, const std::string& reason, std::optional<Timestamp> last_pair = {});
  /// Waits for the disk. An Error if not everything is saved.
  [[nodiscard]] Status written() { return writer_.finish(); }
  /// What an earlier log was renamed to; empty: there was none.
  [[nodiscard]] const std::string& earlier_kept_as() const { return writer_.earlier_kept_as(); }

  [[nodiscard]] Saved saved(Timestamp now, Duration lately) const override;

  void happened(Timestamp time, Step from, Event event, Cell answer) override;
  void asked_from_outside(const Request& request) override;
  void not_understood(const Phrase& phrase) override;
  void registration_restored(Timestamp time, const LevelState& level) override;
  void calibration_found(Timestamp time, const CalibrationInUse& found) override;
  void region_saved(Timestamp time, const LevelState& level, const nav::Region& region) override;
  void region_dropped(Timestamp time, const LevelState& level) override;
  void level_cleared(Timestamp time, const LevelState& level) override;
  void acceptance_withdrawn(Timestamp time, const LevelState& level) override;
  void places_forgotten(Timestamp time) override;
  void references_placed(Timestamp time, std::span<const nav::ReferencePlace> places) override;
  void registered(Timestamp time, const LevelState& level,
                  const RegistrationOutcome& outcome) override;
  void check_point_recorded(Timestamp time, const LevelState& level) override;
  void check_point_dropped(Timestamp time, const LevelState& level) override;
  void accepted(Timestamp time, const LevelState& level, std::string_view shown) override;
  void landmark_touched(Timestamp time, const LevelState& level,
                        const LandmarkTouch& touch) override;
  void landmark_dropped(Timestamp time, const LevelState& level) override;
  void tips_compared(Timestamp time, const TipDifference& difference) override;
  void axis_compared(Timestamp time, const AxisDifference& difference) override;
  void wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                     const PlacedWire& wire) override;
  void screw_redone(Timestamp time, const LevelState& level, std::size_t screw,
                    const nav::OtherEntry& entry) override;
  void replanned(Timestamp time, const LevelState& level, const Replan& asked,
                 const ScrewReplanned& done) override;
  void screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                  const ToolGuidance* at_depth) override;
  void head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) override;
  void head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) override;
  void rod_done(Timestamp time, const RodState& rod) override;

 private:
  OperationLog(Env& env, std::unique_ptr<FolderLock> lock, std::unique_ptr<RecordLog> log,
               std::vector<std::string> levels, RecordWriter::Waits waits);
  [[nodiscard]] LogJson about(Timestamp time, const LevelState& level) const;
  /// Of what the surgeon is told that it is saved.
  void add(OperationRecord type, Timestamp time, const LogJson& payload);
  /// Of anything else.
  void note(OperationRecord type, const LogJson& payload);

  Env& env_;
  std::unique_ptr<FolderLock> lock_;  ///< released last
  std::vector<std::string> levels_;
  RecordWriter writer_;
  std::uint64_t told_ = 0;  ///< number of the newest record of `add`
  Timestamp told_at_{};
  bool stays_ = false;  ///< the file is kept, even if nothing was recorded
};

}  // namespace orthonav::engine
