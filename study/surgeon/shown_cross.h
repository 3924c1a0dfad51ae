#pragma once

namespace orthonav::sim {

// How the target cross (H7) is drawn, as its wearer has learnt it (docs/holograms.md).

/// It magnifies by this: a millimetre is drawn as four.
inline constexpr double kCrossScale = 4.0;
/// The hollow dot is the tool's axis this far up from the tip.
inline constexpr double kCrossReach_m = 0.080;
/// A dot farther from the middle than this (before the scale) is held there, with an arrow.
inline constexpr double kCrossRim_m = 0.0056;

}  // namespace orthonav::sim
