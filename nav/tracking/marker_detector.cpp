#include "nav/tracking/marker_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "nav/tracking/tool.h"

namespace orthonav::nav {
namespace {

struct Family {
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
  int codes;
};

constexpr std::array<std::string_view, 9> kNames = {
    "tag36h11",      "tag25h9",        "tag16h5",        "tagStandard41h12", "tagStandard52h13",
    "tagCircle21h7", "tagCircle49h12", "tagCustom48h12", "tag36h10"};
constexpr std::array<Family, kNames.size()> kFamilies = {{
    {tag36h11_create, tag36h11_destroy, 587},
    {tag25h9_create, tag25h9_destroy, 35},
    {tag16h5_create, tag16h5_destroy, 30},
    {tagStandard41h12_create, tagStandard41h12_destroy, 2115},
    {tagStandard52h13_create, tagStandard52h13_destroy, 48714},
    {tagCircle21h7_create, tagCircle21h7_destroy, 38},
    {tagCircle49h12_create, tagCircle49h12_destroy, 65535},
    {tagCustom48h12_create, tagCustom48h12_destroy, 42211},
    {tag36h10_create, tag36h10_destroy, 2320},
}};

// The library thresholds in tiles of so many (decimated) pixels.
constexpr int kTilePx = 4;
// Below, the library reads before the start of its tiles; no tag is that small.
constexpr int kSmallestPx = 4 * kTilePx;
// The library asserts on more.
constexpr int kLargestPx = 32767;
// The look-up table of corrected codes grows with the square of the bits: gigabytes beyond.
constexpr std::uint32_t kMostCodesWithTwoBits = 10000;

std::size_t family_index(std::string_view name) {
  return static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

Status check(const DetectorOptions& options) {
  if (options.families.empty()) return Error{"marker detector: no tag family given"};
  for (std::size_t i = 0; i < options.families.size(); ++i) {
    const std::string& name = options.families[i];
    if (!is_known_family(name))
      return Error{"unknown tag family '" + name + "', known are " + known_families_text()};
    if (std::find(options.families.begin(), options.families.begin() + static_cast<long>(i),
                  name) != options.families.begin() + static_cast<long>(i))
      return Error{"tag family '" + name + "' is given twice"};
  }
  const double d = options.decimate;
  if (d != 1.0 && d != 1.5 && d != 2.0 && d != 3.0 && d != 4.0)
    return Error{"marker detector: decimate " + std::to_string(d) + ", must be 1, 1.5, 2, 3 or 4"};
  if (options.max_hamming < 0 || options.max_hamming > 2)
    return Error{"marker detector: max_hamming " + std::to_string(options.max_hamming) +
                 ", must be 0, 1 or 2"};
  if (!std::isfinite(options.min_decision_margin))
    return Error{"marker detector: min_decision_margin is not finite"};
  if (options.threads < 1 || options.threads > 64)
    return Error{"marker detector: " + std::to_string(options.threads) + " threads, must be 1-64"};
  return {};
}

Status check(const GreyImage& image) {
  if (image.width_px <= 0 || image.height_px <= 0)
    return Error{"image is empty (" + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px)"};
  if (image.width_px > kLargestPx || image.height_px > kLargestPx)
    return Error{"image is " + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px, limit " + std::to_string(kLargestPx)};
  const auto expected =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.pixels.size() != expected)
    return Error{"image of " + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px holds " +
                 std::to_string(image.pixels.size()) + " bytes, " + std::to_string(expected) +
                 " expected"};
  return {};
}

// Clips to the image and widens to whole tiles plus one.
PixelBox aligned(const PixelBox& box, const GreyImage& image, int step_px) {
  const auto low = [step_px](long long v) {
    return static_cast<int>(std::max<long long>(0, (v >= 0 ? v / step_px : -1) - 1) * step_px);
  };
  const auto high = [step_px](long long v, int size) {
    if (v <= 0) return 0;
    return static_cast<int>(std::min<long long>(size, ((v + step_px - 1) / step_px + 1) * step_px));
  };
  const long long right = static_cast<long long>(box.x_px) + box.width_px;
  const long long bottom = static_cast<long long>(box.y_px) + box.height_px;
  const int x0 = low(box.x_px);
  const int y0 = low(box.y_px);
  return {x0, y0, high(right, image.width_px) - x0, high(bottom, image.height_px) - y0};
}

bool comes_before(const MarkerCorners& a, const MarkerCorners& b) {
  const auto key = [](const MarkerCorners& m) {
    return std::make_tuple(m.family, m.id, m.corners_px[0].x, m.corners_px[0].y);
  };
  return key(a) < key(b);
}

}  // namespace

std::span<const std::string_view> known_families() { return kNames; }

std::string known_families_text() {
  std::string text;
  for (const std::string_view name : kNames) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

int family_size(std::string_view family) {
  const std::size_t index = family_index(family);
  return index < kFamilies.size() ? kFamilies[index].codes : 0;
}

bool is_known_family(const std::string& family) { return family_index(family) < kNames.size(); }

struct MarkerDetector::Library {
  apriltag_detector_t* detector = nullptr;
  std::vector<std::pair<std::size_t, apriltag_family_t*>> families;
  int max_hamming = 0;
  double min_decision_margin = 0.0;
  int step_px = kTilePx;

  Library() = default;
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() {
    if (detector) apriltag_detector_destroy(detector);
    for (const auto& [index, family] : families) kFamilies[index].destroy(family);
  }

  Status add(const std::string& name) {
    const std::size_t index = family_index(name);
    apriltag_family_t* family = kFamilies[index].create();
    if (!family) return Error{"tag family '" + name + "' could not be made"};
    families.emplace_back(index, family);
    if (max_hamming > 1 && family->ncodes > kMostCodesWithTwoBits)
      return Error{"tag family '" + name + "' has " + std::to_string(family->ncodes) +
                   " codes; with so many max_hamming must be at most 1"};
    apriltag_detector_add_family_bits(detector, family, max_hamming);
    if (!family->impl) return Error{"tag family '" + name + "': not enough memory for its codes"};
    return {};
  }

  void append(const apriltag_detection_t& seen, Vec2 offset_px,
              std::vector<MarkerCorners>& found) const {
    if (seen.hamming > max_hamming || seen.decision_margin < min_decision_margin) return;
    MarkerCorners marker;
    for (const auto& [index, family] : families)
      if (family == seen.family) marker.family = kNames[index];
    marker.id = seen.id;
    marker.decision_margin = static_cast<double>(seen.decision_margin);
    marker.hamming = seen.hamming;
    // The library's order is that of the header: (-1, 1), (1, 1), (1, -1), (-1, -1) with y down.
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 corner = Vec2{seen.p[i][0], seen.p[i][1]} + offset_px;
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) return;
      marker.corners_px[i] = corner;
    }
    found.push_back(marker);
  }
};

MarkerDetector::MarkerDetector(std::unique_ptr<Library> library) : library_(std::move(library)) {}
MarkerDetector::MarkerDetector(MarkerDetector&&) noexcept = default;
MarkerDetector& MarkerDetector::operator=(MarkerDetector&&) noexcept = default;
MarkerDetector::~MarkerDetector() = default;

Result<MarkerDetector> MarkerDetector::create(const DetectorOptions& options) {
  if (Status status = check(options); !status) return status.error();
  auto library = std::make_unique<Library>();
  library->detector = apriltag_detector_create();
  if (!library->detector) return Error{"marker detector: the AprilTag library gave none"};
  library->detector->nthreads = options.threads;
  library->detector->quad_decimate = static_cast<float>(options.decimate);
  library->max_hamming = options.max_hamming;
  library->min_decision_margin = options.min_decision_margin;
  // 1.5 maps 3 pixels to 2: 12 pixels are the fewest that make whole tiles.
  library->step_px = options.decimate == 1.5 ? 12 : kTilePx * static_cast<int>(options.decimate);
  for (const std::string& name : options.families)
    if (Status status = library->add(name); !status) return status.error();
  return MarkerDetector(std::move(library));
}

Status MarkerDetector::detect(const GreyImage& image, std::vector<MarkerCorners>& found) {
  return detect(image, {0, 0, image.width_px, image.height_px}, found);
}

Status MarkerDetector::detect(const GreyImage& image, const PixelBox& box,
                              std::vector<MarkerCorners>& found) {
  found.clear();
  if (Status status = check(image); !status) return status;
  if (box.width_px <= 0 || box.height_px <= 0) return {};
  const PixelBox crop = aligned(box, image, library_->step_px);
  const int smallest_px = kSmallestPx * library_->step_px / kTilePx;
  if (crop.width_px < smallest_px || crop.height_px < smallest_px) return {};

  const auto start =
      static_cast<std::size_t>(crop.y_px) * static_cast<std::size_t>(image.width_px) +
      static_cast<std::size_t>(crop.x_px);
  // The library takes no const image but writes only to its own copies.
  image_u8_t view = {crop.width_px, crop.height_px, image.width_px,
                     const_cast<std::uint8_t*>(image.pixels.data() + start)};
  zarray_t* seen = apriltag_detector_detect(library_->detector, &view);
  if (!seen) return Error{"the AprilTag library returned nothing (out of memory)"};
  const Vec2 offset_px{static_cast<double>(crop.x_px), static_cast<double>(crop.y_px)};
  for (int i = 0; i < zarray_size(seen); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(seen, i, &detection);
    library_->append(*detection, offset_px, found);
  }
  apriltag_detections_destroy(seen);
  std::sort(found.begin(), found.end(), comes_before);
  return {};
}

}  // namespace orthonav::nav
