#include "tools/igtl_tracker.h"

#include <string>

#include "base/check.h"
#include "hal/igtl/tracker_headset.h"
#include "hal/open/open.h"

namespace orthonav::tools {

void register_igtl_tracker() {
  HeadsetScheme scheme;
  scheme.name = "igtl";
  scheme.usage = "igtl://HOST";
  scheme.check = [](const std::string& rest) {
    const auto options = igtl::tracker_options_of(rest);
    return options ? Status{} : Status(options.error());
  };
  scheme.open = [](const std::string& rest) -> Result<std::unique_ptr<Headset>> {
    const auto options = igtl::tracker_options_of(rest);
    if (!options) {
      return options.error();
    }
    return igtl::open_tracker(*options);
  };
  ORTHONAV_CHECK(register_scheme(std::move(scheme)).ok());
}

}  // namespace orthonav::tools
