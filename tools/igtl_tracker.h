#pragma once

namespace orthonav::tools {

/// From now on `igtl://HOST[:PORT]?TOOL=TRANSFORM&...` is a headset: tools that another program
/// tracks (hal/igtl/tracker_headset.h).
void register_igtl_tracker();

}  // namespace orthonav::tools
