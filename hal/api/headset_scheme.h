#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

struct OpenedDevice {
  std::unique_ptr<Headset> headset;
  /// In one line, a problem that did not prevent opening; empty: none.
  std::string warning;
};

/// How a device is opened by URIs of its own scheme.
struct HeadsetScheme {
  std::string name;   ///< "mine" of "mine:REST": lower-case letters and digits
  std::string usage;  ///< as named in error messages: "mine:SERIAL"
  /// Refuses the part after the colon if its text alone shows that it can't be opened. Null:
  /// nothing is refused.
  std::function<Status(const std::string& rest)> check;
  /// `phrases`: what the headset's own speech recognition is to listen for, lower case; none: it
  /// hears nothing.
  std::function<Result<OpenedDevice>(const std::string& rest,
                                     const std::vector<std::string>& phrases)>
      open;
};

}  // namespace orthonav
