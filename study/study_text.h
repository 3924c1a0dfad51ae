#pragma once

#include <iosfwd>
#include <string>

#include "study/study_store.h"

namespace orthonav::engine {

/// The JSON of the study in a store (docs/file-formats.md), or of one shard of it, written
/// incrementally: it keeps a few numbers per operation and one report in memory, so that a million
/// operations fit. Missing operations count as not made.
Status write_study(const StudyStore& store, std::ostream& out, int shard = 1, int shards = 1);
Result<std::string> study_text(const StudyStore& store, int shard = 1, int shards = 1);

/// The figures of a study's JSON as a table for a terminal, beside the published ones.
[[nodiscard]] std::string study_table(const std::string& study_text);

}  // namespace orthonav::engine
