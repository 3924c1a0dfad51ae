#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "engine/io/stored_transform.h"

namespace orthonav::engine {

/// The transform in the bytes of an HDF5 file as ITK writes it:
/// `/TransformGroup/0/{TransformType, TransformParameters, TransformFixedParameters}`, the last two
/// also as `TranformParameters` and `TranformFixedParameters`, as ITK long misspelled them. Opens
/// no other file: neither links nor data that lie elsewhere are followed. For a child process
/// (load_transform), since libhdf5 may crash on damaged bytes. The words of a refusal follow a
/// file's name.
[[nodiscard]] Result<StoredTransform> transform_from_hdf5(std::string_view bytes);

/// The bytes of such a file, in the misspelling, which every ITK reads.
[[nodiscard]] Result<std::string> hdf5_from_transform(const StoredTransform& transform);

}  // namespace orthonav::engine
