#pragma once

#include <memory>
#include <string>

#include "engine/io/posix_env.h"
#include "engine/live/assembled_operation.h"
#include "engine/session/operation_log.h"

namespace orthonav::tools {

/// The log of the operation that a command runs, in the folder of its results.
class KeptOperation {
 public:
  /// What of it the operation itself does not know.
  struct About {
    std::string case_name;
    std::string method;
    bool patient_reference = false;
    std::string room;  ///< a simulated patient; empty: a real one
    nav::CommonErrors common;
    bool time_stands_still = false;  ///< while the disk writes
    bool replaces_earlier = false;   ///< logs of the same folder
  };
  /// Begins the log. From now on the operation's status line says what is saved.
  Status begin(engine::AssembledOperation& operation, const std::string& folder,
               const About& about);
  /// Null: none.
  [[nodiscard]] engine::OperationLog* log() const { return log_.get(); }
  /// Closes it; an Error when not all was saved.
  Status finish(bool done, const std::string& reason);

 private:
  engine::PosixEnv env_;
  std::unique_ptr<engine::OperationLog> log_;
};

}  // namespace orthonav::tools
