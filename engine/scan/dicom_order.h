#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// What the header of a slice says about its place, metres, LPS.
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

/// The slices of one series; `wanted` picks it where there are several. Refuses several series
/// without one being wanted, with a list of them, and a series that is not there.
Result<std::vector<SliceHeader>> one_series(std::span<const SliceHeader> slices,
                                            const std::string& wanted);

/// A stack of slices in the order of their places along the normal; never by number or name.
struct SliceStack {
  std::vector<SliceHeader> slices;
  VolumeGrid grid;
};

/// Refuses, naming the slices: fewer than two, slices of different size, spacing or direction,
/// directions that are not at right angles, two at one place, unequal distances (slices are
/// missing; tolerance 2 % and 0.02 mm) and a stack that leans by more than 0.2° (gantry tilt).
Result<SliceStack> stacked(std::vector<SliceHeader> slices);

}  // namespace orthonav::engine
