#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// What a header says of a slice: a file, or a frame of a multi-frame one. Metres, LPS.
struct SliceHeader {
  std::string file;
  int frame = 0;            ///< of the file, from 0
  int frames = 1;           ///< of the file
  std::string series;       ///< SeriesInstanceUID
  std::string description;  ///< SeriesDescription
  std::string modality;     ///< "CT"
  bool ct = true;           ///< an original CT by its kind and modality
  std::string problem;      ///< why it cannot be read as a slice of a CT; empty: it can
  Vec3 position_m;          ///< ImagePositionPatient
  Vec3 row;                 ///< unit, ImageOrientationPatient: along a row
  Vec3 column;
  std::array<double, 2> spacing_m{};  ///< between columns, between rows
  std::array<int, 2> size{};          ///< columns, rows
};

/// The slices of one series; `wanted` picks it if there are several. Where none is picked, series
/// that are no CT do not count beside one that is. Refuses several series if none is picked, with a
/// list of them, and a missing series.
Result<std::vector<SliceHeader>> one_series(std::span<const SliceHeader> slices,
                                            const std::string& wanted);

/// A stack of slices ordered by position along the normal, never by number or name.
struct SliceStack {
  std::vector<SliceHeader> slices;
  VolumeGrid grid;
};

/// Refuses, naming the slices: one with a `problem`, fewer than two, slices of different size,
/// spacing or direction, directions that are not at right angles, two at one place, one that is
/// more than 0.1 mm off an evenly spaced stack of the others (writers round to that; a gap of one
/// and a half or more: slices are missing) and a stack that leans by more than 0.2° (gantry tilt).
Result<SliceStack> stacked(std::vector<SliceHeader> slices);

/// A series in a folder, for a list of them.
struct SeriesSummary {
  std::string uid;
  std::string description;
  std::string modality;
  int slices = 0;
  std::array<int, 2> size{};          ///< columns, rows
  std::array<double, 3> spacing_m{};  ///< between columns, rows, slices; 0: none that is stated
  double tilt_deg = 0.0;              ///< by which the stack leans
  std::string problem;                ///< why it cannot be read; empty: it can
};

/// Each series, in the order of their UIDs.
[[nodiscard]] std::vector<SeriesSummary> summaries_of(std::span<const SliceHeader> slices);

}  // namespace orthonav::engine
