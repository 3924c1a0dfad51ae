#pragma once

#include <memory>
#include <string>

#include "base/result.h"
#include "hal/open/joined_headset.h"

namespace orthonav::tools {

/// The headset with the requested clicker and voice. It must outlive the result.
Result<std::unique_ptr<JoinedHeadset>> join_parts(Headset& headset, const std::string& clicker,
                                                  const std::string& voice);

}  // namespace orthonav::tools
