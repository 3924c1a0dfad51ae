#pragma once

#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/case/operation.h"

namespace orthonav::engine {

/// Refuses a label that the case does not have, and lists those it has.
Status check_level(const Case& source, const std::string& label);

/// The labels that would be operated, in the order of the case; refuses as `plan_operation` does,
/// without preparing anything.
Result<std::vector<std::string>> levels_to_operate(const Case& source,
                                                   const std::vector<std::string>& labels = {});

/// Prepares levels of a case for an operation, in the order of the case. `labels` empty: the two
/// lowest levels of the spine with screws. Refuses a label that the case does not have, that has no
/// screws or that is given twice, and a screw that breaks through its cortex without a stated
/// reason (engine/case/screw_breach.h).
Result<Operation> plan_operation(const Case& source, const std::vector<std::string>& labels = {});

/// The same without models: of levels that are shown, but not registered.
Result<Operation> plan_without_models(const Case& source,
                                      const std::vector<std::string>& labels = {});

/// Of rods alone: whatever levels the case has, none is prepared or registered.
[[nodiscard]] Operation plan_rods_alone(const Case& source);

}  // namespace orthonav::engine
