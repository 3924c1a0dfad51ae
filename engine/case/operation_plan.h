#pragma once

#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/case/model_cache.h"
#include "engine/case/operation.h"

namespace orthonav::engine {

/// Refuses a label that the case does not have, with those it has.
Status check_level(const Case& source, const std::string& label);

/// The labels that would be operated, in the order of the case; refuses as `plan_operation` does,
/// without preparing anything.
Result<std::vector<std::string>> levels_to_operate(const Case& source,
                                                   const std::vector<std::string>& labels = {});

/// Prepares levels of a case for an operation, in the order of the case. `labels` empty: the two
/// lowest of the spine that have screws. Refuses a label that the case does not have, that has no
/// screws or that is named twice, and a screw that breaks through its cortex without a reason
/// (engine/case/screw_breach.h). `cache` may have them from an earlier time; what it hadn't, it can
/// `keep` afterwards.
Result<Operation> plan_operation(const Case& source, const std::vector<std::string>& labels,
                                 ModelCache& cache);
Result<Operation> plan_operation(const Case& source, const std::vector<std::string>& labels = {});

}  // namespace orthonav::engine
