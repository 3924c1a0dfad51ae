#pragma once

#include <string>

#include "base/result.h"
#include "engine/io/stored_transform.h"

namespace orthonav::engine {

/// Reads a transform file of 3D Slicer, `.tfm` (text) or `.h5` (HDF5), whatever its name says, of
/// at most 1 MiB. Millimetres, LPS, from parent: `parent_from_node` makes a pose of it. HDF5 is
/// read in a child process with bounds on time and memory. Refuses in one line what is damaged, and
/// a file that holds another number of transforms than one.
[[nodiscard]] Result<StoredTransform> load_transform(const std::string& path);

/// Writes one by its name, `.tfm` or `.h5`, for ITK and 3D Slicer. Refuses other names.
[[nodiscard]] Status save_transform(const std::string& path, const StoredTransform& transform);

/// Refuses a name that `save_transform` would refuse.
[[nodiscard]] Status check_transform_name(const std::string& path);

}  // namespace orthonav::engine
