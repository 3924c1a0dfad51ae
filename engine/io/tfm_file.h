#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/result.h"
#include "engine/io/stored_transform.h"

namespace orthonav::engine {

/// A transform file may be this long; a rigid one has less than a kilobyte as text.
inline constexpr std::size_t kLongestTransformFile = std::size_t{1} << 20u;

/// The text of a `.tfm` file ("Insight Transform File V1.0"), numbers to the last digit.
[[nodiscard]] std::string tfm_text(const StoredTransform& transform);

/// Reads such a text; `name` stands for the file in messages. Refuses in one line a text that is
/// cut off anywhere, several transforms, lines that it doesn't know and numbers that are not
/// finite.
[[nodiscard]] Result<StoredTransform> transform_from_tfm(std::string_view text,
                                                         const std::string& name);

/// Reads a `.tfm` file of at most 1 MiB. Refuses an `.h5` file by its first bytes: what reads those
/// is not part of every program (engine/scan/transform_file.h).
[[nodiscard]] Result<StoredTransform> load_tfm(const std::string& path);

/// Whether the bytes begin as an HDF5 file does.
[[nodiscard]] bool is_hdf5(std::string_view bytes);

}  // namespace orthonav::engine
