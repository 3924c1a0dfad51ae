#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "engine/study/simulated_operation.h"

namespace orthonav::engine {

/// Leaves one step of the method out of operations, so that a study can tell what it gains
/// (docs/decisions/0076-one-step-left-out.md): `check points`, `landmark`, `tips`, `axis`,
/// `tag sizes`, `wire`, `redo`, `numbers` or `reference`; a hyphen stands for a blank as well.
/// `numbers` takes the surgeon back from the closed loop to cross and triangle, so it comes after
/// the choice of guidance. Refuses any other name in one line that names what there is, and a name
/// twice.
Status leave_out(std::string_view step, OperationOptions& options);
/// What was left out, joined: "tips, redo"; empty: nothing.
[[nodiscard]] std::string left_out_of(const OperationOptions& options);

}  // namespace orthonav::engine
