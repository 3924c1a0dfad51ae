#pragma once

#include <string>
#include <vector>

namespace orthonav::engine {

/// The numbers of a DICOM field, separated by backslashes; an invalid one becomes 0.
[[nodiscard]] std::vector<double> dicom_numbers(const std::string& text);

/// A DICOM text without the padding that makes its length even, and without control characters.
[[nodiscard]] std::string dicom_text(std::string text);

}  // namespace orthonav::engine
