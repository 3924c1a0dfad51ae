#pragma once

#include <string>

#include "base/result.h"

namespace orthonav {

inline Error bad_uri(const std::string& uri, const std::string& why) {
  return Error{"headset URI \"" + uri + "\": " + why};
}

}  // namespace orthonav
