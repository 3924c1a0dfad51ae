#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "study/simulated_operation.h"

namespace orthonav::engine {

/// Leaves one step of the method out of operations, so that a study can tell what it gains
/// (docs/decisions/0076-one-step-left-out.md): `check points`, `landmark`, `tips`, `axis`,
/// `tag sizes`, `wire`, `redo`, `numbers` or `reference`; a hyphen may replace the blank. `numbers`
/// returns the surgeon from the closed loop to cross and triangle, so it must come after the choice
/// of guidance. Refuses any other name, listing the known ones in one line, and a repeated name.
Status leave_out(std::string_view step, OperationOptions& options);
/// The steps left out, joined: "tips, redo"; empty: none.
[[nodiscard]] std::string left_out_of(const OperationOptions& options);

}  // namespace orthonav::engine
