#pragma once

#include "base/translation.h"

namespace orthonav {

// Before a number that its decimals don't tell from its limit (base/printed.h); for `translated`.
inline constexpr const char* kJustOver = translatable("just over");
inline constexpr const char* kJustUnder = translatable("just under");

}  // namespace orthonav
