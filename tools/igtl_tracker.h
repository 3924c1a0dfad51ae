#pragma once

namespace orthonav::tools {

/// Registers the scheme `igtl://HOST[:PORT]?TOOL=TRANSFORM&...` as a headset: tools that another
/// program tracks (hal/igtl/tracker_headset.h).
void register_igtl_tracker();

}  // namespace orthonav::tools
