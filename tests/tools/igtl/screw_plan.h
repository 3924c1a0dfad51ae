#pragma once

namespace orthonav::tools::igtl_test {

/// A plan of one screw, as another program sends it.
inline constexpr const char* kScrew =
    R"({"units": "mm", "frame": "RAS", "level": "L4", "screws": [{"side": "left",
        "entry": [-15, -20, 4], "target": [-15, 15, 4], "radius": 3}]})";

}  // namespace orthonav::tools::igtl_test
