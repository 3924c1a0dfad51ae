#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// The position of a slice from its header, metres, LPS.
struct SliceHeader {
  std::string file;
  std::string series;       ///< SeriesInstanceUID
  std::string description;  ///< SeriesDescription
  Vec3 position_m;          ///< ImagePositionPatient
  Vec3 row;                 ///< unit, ImageOrientationPatient: along a row
  Vec3 column;
  std::array<double, 2> spacing_m{};  ///< between columns, between rows
  std::array<int, 2> size{};          ///< columns, rows
};

/// The slices of one series; `wanted` picks it if there are several. Refuses several series if none
/// is picked, with a list of them, and a missing series.
Result<std::vector<SliceHeader>> one_series(std::span<const SliceHeader> slices,
                                            const std::string& wanted);

/// A stack of slices ordered by position along the normal, never by number or name.
struct SliceStack {
  std::vector<SliceHeader> slices;
  VolumeGrid grid;
};

/// Refuses, naming the slices: fewer than two, slices of different size, spacing or direction,
/// directions that are not at right angles, two at one place, unequal distances (slices are
/// missing; tolerance 2 % and 0.02 mm) and a stack that leans by more than 0.2° (gantry tilt).
Result<SliceStack> stacked(std::vector<SliceHeader> slices);

}  // namespace orthonav::engine
