#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "engine/study/study.h"

namespace orthonav::engine {

/// What a study and its definition carry as its method: the method's name, with the patient
/// reference where one is used, or "stated" where a published system's stated error stands in its
/// place.
[[nodiscard]] std::string method_label(const OperationOptions& operation);

/// Everything that decides the results of a study, as one line of JSON: the version of the program,
/// the method, the room's magnitudes, the cases with the checksums of their meshes, the seeds.
/// Shards of one study have the same.
[[nodiscard]] std::string definition_of(std::span<const Case> cases, const StudyOptions& options);

/// Joins shards in SQLite files as if they had been one study. Refuses shards of different studies,
/// and files that are none. Operations that are in none of them count as not made.
Result<std::string> merge_stores(std::span<const std::string> paths);

/// The same, written as it goes: it keeps a few numbers of each operation in memory and one report
/// a file, so that a million fit.
Status merge_stores(std::span<const std::string> paths, std::ostream& out);

/// Which operations of the study are in none of these files; all of them where there is no file.
Result<std::vector<int>> missing_operations(const std::string& definition,
                                            std::span<const std::string> paths);

}  // namespace orthonav::engine
