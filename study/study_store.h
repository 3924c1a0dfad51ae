#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

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
  /// file of another study, or one that is not a study, and leaves it unchanged.
  static Result<StudyStore> open(const std::string& path, const std::string& definition);
  /// A finished one or a part of one, to be read.
  static Result<StudyStore> read(const std::string& path);
  StudyStore(StudyStore&&) noexcept;
  StudyStore& operator=(StudyStore&&) noexcept;
  ~StudyStore();

  [[nodiscard]] const std::string& definition() const { return definition_; }
  [[nodiscard]] Result<std::vector<StoredOperation>> operations() const;
  /// The numbers of its operations, in order, without reading the operations.
  [[nodiscard]] Result<std::vector<int>> numbers() const;
  /// The one with the smallest number above `number`, if there is one.
  [[nodiscard]] Result<std::optional<StoredOperation>> next_after(int number) const;
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
