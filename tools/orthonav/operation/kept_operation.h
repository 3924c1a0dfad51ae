#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/posix_env.h"
#include "engine/live/assembled_operation.h"
#include "engine/session/log/operation_log.h"

namespace orthonav::tools {

/// The log of the operation that a command runs, in the folder of its results.
class KeptOperation {
 public:
  /// Facts that the operation itself does not know.
  struct About {
    std::string case_name;
    std::string method;
    bool patient_reference = false;
    std::string device;            ///< the headset's name
    std::int64_t epoch_100ns = 0;  ///< Headset::epoch_ticks_100ns
    /// Of a simulated patient, whose time stands still while the disk writes; absent: a real one.
    std::optional<std::uint64_t> seed;
    bool replaces_earlier = false;  ///< overwrites the folder's earlier log
  };
  /// Looks for the last operation in the folder and locks the folder. An Error in one line: there
  /// is none, it was completed, or it can't be read.
  Status find(const std::string& folder);
  /// Refuses a folder in which another program operates, before anything is written into it.
  [[nodiscard]] Status check_free(const std::string& folder);
  /// Whether one was found that has not been resumed yet.
  [[nodiscard]] bool found() const { return found_.has_value(); }
  /// Where patient references lie in the World of the operation found.
  [[nodiscard]] std::vector<nav::ReferencePlace> reference_places() const;
  /// Refuses the operation found if it differs in patient, plan, tool or method. Does not change
  /// the folder.
  [[nodiscard]] Status check(const engine::Session& session, const About& about) const;
  /// Begins the log, or resumes the operation found and reports its remainder. From now on the
  /// operation's status line says what is saved.
  Status begin(engine::AssembledOperation& operation, const std::string& folder,
               const About& about);
  /// Null: none.
  [[nodiscard]] engine::OperationLog* log() const { return log_.get(); }
  /// When the operation began, for people, by this machine's clock; for a resumed one, when it
  /// first began. Empty before `begin`.
  [[nodiscard]] const std::string& begun() const { return begun_; }
  /// Closes the log; an Error if not everything was saved.
  Status finish(bool done, const std::string& reason, std::optional<Timestamp> last_pair = {});

 private:
  Status resume(engine::AssembledOperation& operation, const About& about,
                engine::RecordWriter::Waits waits);
  Status begin_anew(const engine::AssembledOperation& operation, const std::string& folder,
                    const About& about, engine::RecordWriter::Waits waits);

  engine::PosixEnv env_;
  std::optional<engine::OperationLog::Found> found_;
  std::unique_ptr<engine::OperationLog> log_;
  std::string begun_;
};

}  // namespace orthonav::tools
