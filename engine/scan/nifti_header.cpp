#include "engine/scan/nifti_header.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace orthonav::engine {
namespace {

// nifti1.h and nifti2.h of the NIfTI Data Format Working Group: the size of the header comes
// first, and tells the byte order; pixdim, then quatern_b to srow_z, are numbers.
constexpr std::int32_t kSizeOne = 348;
constexpr std::int32_t kSizeTwo = 540;
constexpr double kMost = 1e9;

template <class T>
T number_at(const char* place, bool swapped) {
  std::array<char, sizeof(T)> bytes{};
  std::copy_n(place, sizeof(T), bytes.begin());
  if (swapped) {
    std::reverse(bytes.begin(), bytes.end());
  }
  T number{};
  std::memcpy(&number, bytes.data(), sizeof(T));
  return number;
}

struct Range {
  std::size_t begin;
  std::size_t end;
};

template <class T>
bool plausible(const char* header, std::array<Range, 2> ranges, bool swapped) {
  for (const Range range : ranges) {
    for (std::size_t at = range.begin; at < range.end; at += sizeof(T)) {
      if (!(std::abs(number_at<T>(header + at, swapped)) <= static_cast<T>(kMost))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

Status check_nifti_numbers(const std::string& path) {
  std::array<char, kSizeTwo> header{};
  const gzFile file = ::gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return {};
  }
  const int count = ::gzread(file, header.data(), header.size());
  ::gzclose(file);
  bool good = true;
  for (const bool swapped : {false, true}) {
    const auto size = number_at<std::int32_t>(header.data(), swapped);
    if (size == kSizeOne && count >= kSizeOne) {
      good = good && plausible<float>(header.data(), {{{76, 108}, {256, 328}}}, swapped);
    } else if (size == kSizeTwo && count >= kSizeTwo) {
      good = good && plausible<double>(header.data(), {{{104, 168}, {352, 496}}}, swapped);
    }
  }
  if (!good) {
    return Error{"its header holds a spacing or an orientation that is not a number of mm"};
  }
  return {};
}

}  // namespace orthonav::engine
