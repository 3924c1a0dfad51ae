#pragma once

#include <memory>
#include <utility>

#include "hal/api/devices.h"

namespace orthonav {

/// Converts what was opened to any Headset.
template <class T>
Result<std::unique_ptr<Headset>> as_headset(Result<std::unique_ptr<T>> opened) {
  if (!opened) {
    return opened.error();
  }
  return std::unique_ptr<Headset>(std::move(opened).value());
}

}  // namespace orthonav
