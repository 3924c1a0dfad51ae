#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// One stored operation of a study.
struct StoredOperation {
  int index = 0;  ///< in the study, from 0
  std::string case_name;
  std::uint64_t seed = 0;
  std::string report;  ///< report.json; empty if the operation failed
  std::string why;     ///< why it failed
};

/// The operations of a study, or of a shard of it, in an SQLite file. Each is durable once `add`
/// returns. While it grows, the file is named `PATH.part`; `finish` gives it its name. An existing
/// file is resumed, so a killed worker loses only unfinished operations.
class StudyStore {
 public:
  /// `definition`: the text with everything that decides the results (docs/cohorts.md). Refuses a
  /// file of another study, or one that is not a study, and leaves it unchanged. Without a path the
  /// operations lie in a temporary file that SQLite makes when they need one.
  static Result<StudyStore> open(const std::string& path, const std::string& definition);
  /// What is in all these files, finished or growing, in a temporary one. Refuses files of
  /// different studies, and an operation with different results in two files.
  static Result<StudyStore> joined(std::span<const std::string> paths);
  StudyStore(StudyStore&&) noexcept;
  StudyStore& operator=(StudyStore&&) noexcept;
  ~StudyStore();

  [[nodiscard]] const std::string& definition() const { return definition_; }
  /// Goes through the operations in the order of their numbers; `take` may end it.
  Status for_each(const std::function<Status(const StoredOperation&)>& take) const;
  /// An existing operation is left unchanged, since a task that ran twice has the same result.
  Status add(const StoredOperation& operation);
  Status finish();

 private:
  struct Database;
  StudyStore(std::unique_ptr<Database> database, std::string path, std::string definition,
             bool growing);

  std::unique_ptr<Database> database_;
  std::string path_;
  std::string definition_;
  std::string hash_;  ///< of the definition
  bool growing_ = false;
};

/// 16 hexadecimal digits of a definition (FNV-1a, 64 bits).
[[nodiscard]] std::string study_hash(const std::string& definition);

}  // namespace orthonav::engine
