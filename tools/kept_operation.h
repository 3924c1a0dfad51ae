#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/posix_env.h"
#include "engine/live/assembled_operation.h"
#include "engine/session/operation_log.h"

namespace orthonav::tools {

/// The log of the operation that a command runs, in the folder of its results.
class KeptOperation {
 public:
  /// What the operation itself does not know of it.
  struct About {
    std::string case_name;
    std::string method;
    bool patient_reference = false;
    std::string room;  ///< a simulated patient; empty: a real one
    nav::CommonErrors common;
    bool time_stands_still = false;  ///< simulated time, while the disk writes
    bool replaces_earlier = false;   ///< overwrites the folder's earlier log

    /// The patient is the simulated one of this seed.
    void simulate(std::uint64_t seed) {
      room = "seed " + std::to_string(seed);
      time_stands_still = true;
    }
  };
  /// Looks for the last operation of the folder, which is then locked. An Error in one line: there
  /// is none, it was done, or it can't be read.
  Status find(const std::string& folder);
  /// Whether one was found that is not gone on with yet.
  [[nodiscard]] bool found() const { return found_.has_value(); }
  /// Where patient references lie in the World of the operation found.
  [[nodiscard]] std::vector<nav::ReferencePlace> reference_places() const;
  /// Refuses the operation found if it is not this one: another patient, plan, tool or method.
  /// Nothing in the folder was changed by then.
  [[nodiscard]] Status check(const engine::Session& session, const About& about) const;
  /// Begins the log, or goes on with the operation found and says what is left of it. From now on
  /// the operation's status line says what is saved.
  Status begin(engine::AssembledOperation& operation, const std::string& folder,
               const About& about);
  /// Null: none.
  [[nodiscard]] engine::OperationLog* log() const { return log_.get(); }
  /// When the operation began, for people, by this machine's clock: of one that was resumed, when
  /// it began first. Empty before `begin`.
  [[nodiscard]] const std::string& begun() const { return begun_; }
  /// Closes it; an Error when not all was saved.
  Status finish(bool done, const std::string& reason);

 private:
  Status resume(engine::AssembledOperation& operation, engine::RecordWriter::Waits waits);
  Status begin_anew(const engine::Session& session, const std::string& folder, const About& about,
                    engine::RecordWriter::Waits waits);

  engine::PosixEnv env_;
  std::optional<engine::OperationLog::Found> found_;
  std::unique_ptr<engine::OperationLog> log_;
  std::string begun_;
};

}  // namespace orthonav::tools
