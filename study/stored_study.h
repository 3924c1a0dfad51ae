#pragma once

#include <functional>
#include <span>
#include <string>

#include "study/study_store.h"

namespace orthonav::engine {

/// Goes through the operations of several files in the order of their numbers, each once, and keeps
/// one report per file in memory. Refuses files of different studies, and an operation with
/// different results in two files. Returns the definition of the study; `take` may refuse as well.
Result<std::string> for_each_operation(std::span<const std::string> paths,
                                       const std::function<Status(const StoredOperation&)>& take);

}  // namespace orthonav::engine
