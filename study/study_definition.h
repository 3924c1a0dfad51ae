#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "study/study.h"

namespace orthonav::engine {

/// The method in a study and its definition: the method's name, with the patient reference if one
/// is used, or "stated" for a published system's stated error.
[[nodiscard]] std::string method_label(const OperationOptions& operation);

/// Everything that decides the results of a study, as one line of JSON: the version of the program,
/// the method, the room's magnitudes, the cases with the checksums of their meshes, the seeds.
/// Shards of one study have the same.
[[nodiscard]] std::string definition_of(std::span<const Case> cases, const StudyOptions& options);

/// Joins shards in SQLite files as if they had been one study. Refuses shards of different studies,
/// and other files. Missing operations count as not made.
Result<std::string> merge_stores(std::span<const std::string> paths);

/// The same, written incrementally: it keeps a few numbers per operation and one report per file in
/// memory, so that a million operations fit.
Status merge_stores(std::span<const std::string> paths, std::ostream& out);

/// The operations of the study that are in none of these files; all of them without files.
Result<std::vector<int>> missing_operations(const std::string& definition,
                                            std::span<const std::string> paths);

}  // namespace orthonav::engine
