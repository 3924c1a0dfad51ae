#include "nav/tracking/marker_detector.h"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "nav/tracking/corner_refinement.h"
#include "nav/tracking/tag_families.h"
#include "nav/tracking/tag_reading.h"
#include "nav/tracking/tool.h"

// Finds the outlines that `apriltag_detector_detect` decodes; exported by the library, but not in
// its header.
extern "C" zarray_t* apriltag_quad_thresh(apriltag_detector_t* detector, image_u8_t* image);

namespace orthonav::nav {
namespace {

// Side of the library's threshold tiles, in (decimated) pixels.
constexpr int kTilePx = 4;
// In a smaller image the library reads before the start of its tiles; no tag is that small.
constexpr int kSmallestPx = 4 * kTilePx;
// The wider window separates tags that are more blurred, the narrower one keeps smaller tags.
constexpr std::array<int, 2> kThinningWindowsPx = {3, 2};
// A thinned outline may be off by nearly the search range.
constexpr int kRefinementsOfThinned = 3;
// With two corrected bits the look-up table grows with the square of the code's length: with more
// codes than this it would take gigabytes.
constexpr std::uint32_t kMaxCodesWithTwoBits = 10000;

// The library asserts on more.
constexpr int kLargestPx = 32767;

/// Refuses options that the detector can't work with: the first problem.
Status check(const DetectorOptions& options) {
  if (options.families.empty()) {
    return Error{"marker detector: no tag family given"};
  }
  for (std::size_t i = 0; i < options.families.size(); ++i) {
    const std::string& name = options.families[i];
    if (!is_known_family(name)) {
      return Error{"unknown tag family '" + name + "', known are " + known_families_text()};
    }
    if (std::find(options.families.begin(), options.families.begin() + static_cast<long>(i),
                  name) != options.families.begin() + static_cast<long>(i)) {
      return Error{"tag family '" + name + "' is given twice"};
    }
  }
  const double d = options.decimate;
  if (d != 1.0 && d != 1.5 && d != 2.0 && d != 3.0 && d != 4.0) {
    return Error{"marker detector: decimate " + std::to_string(d) + ", must be 1, 1.5, 2, 3 or 4"};
  }
  if (options.max_hamming < 0 || options.max_hamming > 2) {
    return Error{"marker detector: max_hamming " + std::to_string(options.max_hamming) +
                 ", must be 0, 1 or 2"};
  }
  if (!std::isfinite(options.min_decision_margin)) {
    return Error{"marker detector: min_decision_margin is not finite"};
  }
  if (options.threads < 1 || options.threads > 64) {
    return Error{"marker detector: " + std::to_string(options.threads) + " threads, must be 1-64"};
  }
  return {};
}

/// Refuses an image that it can't process: no pixels, too many for the library, a buffer of the
/// wrong length.
Status check(const GreyImage& image) {
  if (image.width_px <= 0 || image.height_px <= 0) {
    return Error{"image is empty (" + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px)"};
  }
  if (image.width_px > kLargestPx || image.height_px > kLargestPx) {
    return Error{"image is " + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px, limit " + std::to_string(kLargestPx)};
  }
  const auto expected =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.pixels.size() != expected) {
    return Error{"image of " + std::to_string(image.width_px) + " x " +
                 std::to_string(image.height_px) + " px holds " +
                 std::to_string(image.pixels.size()) + " bytes, " + std::to_string(expected) +
                 " expected"};
  }
  return {};
}

/// The same id in the same place.
bool same_tag(const MarkerCorners& a, const MarkerCorners& b) {
  const auto centre = [](const MarkerCorners& m) {
    return 0.25 * (m.corners_px[0] + m.corners_px[1] + m.corners_px[2] + m.corners_px[3]);
  };
  const double edge_px = (a.corners_px[1] - a.corners_px[0]).norm();
  return a.family == b.family && a.id == b.id && (centre(a) - centre(b)).norm() < 0.5 * edge_px;
}

bool comes_before(const MarkerCorners& a, const MarkerCorners& b) {
  const auto key = [](const MarkerCorners& m) {
    return std::make_tuple(m.family, m.id, m.corners_px[0].x, m.corners_px[0].y);
  };
  return key(a) < key(b);
}

}  // namespace

PixelBox in_whole_steps(const PixelBox& box, const GreyImage& image, int step_px) {
  const auto low = [step_px](long long v) {
    return static_cast<int>(std::max<long long>(0, (v >= 0 ? v / step_px : -1) - 1) * step_px);
  };
  const auto high = [step_px](long long v, int size) {
    if (v <= 0) {
      return 0;
    }
    return static_cast<int>(std::min<long long>(size, ((v + step_px - 1) / step_px + 1) * step_px));
  };
  const long long right = static_cast<long long>(box.x_px) + box.width_px;
  const long long bottom = static_cast<long long>(box.y_px) + box.height_px;
  const int x0 = low(box.x_px);
  const int y0 = low(box.y_px);
  return {x0, y0, high(right, image.width_px) - x0, high(bottom, image.height_px) - y0};
}

struct MarkerDetector::Library {
  apriltag_detector_t* detector = nullptr;
  std::vector<TagFamily> families;  ///< the detector refers to them
  int max_hamming = 0;
  double min_decision_margin = 0.0;
  int step_px = kTilePx;
  Refinement refinement = Refinement::kLibrary;
  bool touched = false;
  GreyImage thinned;

  Library() = default;
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() {
    if (detector) {
      apriltag_detector_destroy(detector);
    }
  }

  Status set_up(const DetectorOptions& options) {
    detector = apriltag_detector_create();
    if (!detector) {
      return Error{"marker detector: the AprilTag library could not create one (out of memory)"};
    }
    detector->nthreads = options.threads;
    detector->quad_decimate = static_cast<float>(options.decimate);
    detector->refine_edges = options.refinement == Refinement::kLibrary;
    refinement = options.refinement;
    touched = options.touched;
    max_hamming = options.max_hamming;
    min_decision_margin = options.min_decision_margin;
    // 1.5 maps 3 pixels to 2: 12 pixels are the fewest that make whole tiles.
    step_px = options.decimate == 1.5 ? 12 : kTilePx * static_cast<int>(options.decimate);
    for (const std::string& name : options.families) {
      if (Status status = add(name); !status) {
        return status;
      }
    }
    return {};
  }

  Status add(const std::string& name) {
    families.push_back(create_family(name));
    apriltag_family_t* family = families.back().get();
    if (!family) {
      return Error{"tag family '" + name + "' could not be made"};
    }
    if (max_hamming > 1 && family->ncodes > kMaxCodesWithTwoBits) {
      return Error{"tag family '" + name + "' has " + std::to_string(family->ncodes) +
                   " codes; with so many max_hamming must be at most 1"};
    }
    apriltag_detector_add_family_bits(detector, family, max_hamming);
    if (!family->impl) {
      return Error{"tag family '" + name + "': not enough memory for its codes"};
    }
    return {};
  }

  static std::string_view name_of(const TagFamily& family) {
    return known_families()[family.get_deleter().index];
  }
  [[nodiscard]] bool may_be_touched(const TagFamily& family) const {
    return name_of(family) == kWideFamily || (touched && !family->reversed_border);
  }

  void append(const apriltag_detection_t& seen, Vec2 offset_px,
              std::vector<MarkerCorners>& found) const {
    if (seen.hamming > max_hamming || seen.decision_margin < min_decision_margin) {
      return;
    }
    MarkerCorners marker;
    for (const TagFamily& family : families) {
      if (family.get() == seen.family) {
        marker.family = name_of(family);
      }
    }
    marker.id = seen.id;
    marker.decision_margin = static_cast<double>(seen.decision_margin);
    marker.hamming = seen.hamming;
    // The library's order is that of the header: (-1, 1), (1, 1), (1, -1), (-1, -1) with y down.
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 corner = Vec2{seen.p[i][0], seen.p[i][1]} + offset_px;
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) {
        return;
      }
      marker.corners_px[i] = corner;
    }
    found.push_back(marker);
  }

  /// Appends the crop's tags; `offset_px` is added to their corners.
  Status detect(const GreyImage& image, const PixelBox& crop, Vec2 offset_px,
                std::vector<MarkerCorners>& found) {
    const auto start =
        static_cast<std::size_t>(crop.y_px) * static_cast<std::size_t>(image.width_px) +
        static_cast<std::size_t>(crop.x_px);
    // The library takes no const image but writes only to its own copies.
    image_u8_t view = {crop.width_px, crop.height_px, image.width_px,
                       const_cast<std::uint8_t*>(image.pixels.data() + start)};
    zarray_t* seen = apriltag_detector_detect(detector, &view);
    if (!seen) {
      return Error{"the AprilTag library returned nothing (out of memory)"};
    }
    for (int i = 0; i < zarray_size(seen); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(seen, i, &detection);
      append(*detection, offset_px, found);
    }
    apriltag_detections_destroy(seen);
    return {};
  }

  /// Appends the tags that `families` have in this outline.
  void read(const GreyImage& image, const std::array<Vec2, 4>& corners_px, bool only_touched,
            std::vector<MarkerCorners>& found) const {
    for (const TagFamily& family : families) {
      if (!may_be_touched(family)) {
        continue;
      }
      bool is_touched = false;
      std::optional<MarkerCorners> tag =
          read_tag(image, corners_px, *family, max_hamming, is_touched);
      if (tag && (is_touched || !only_touched) && tag->decision_margin >= min_decision_margin) {
        tag->family = name_of(family);
        found.push_back(*tag);
      }
    }
  }
};

MarkerDetector::MarkerDetector(std::unique_ptr<Library> library) : library_(std::move(library)) {}
MarkerDetector::MarkerDetector(MarkerDetector&&) noexcept = default;
MarkerDetector& MarkerDetector::operator=(MarkerDetector&&) noexcept = default;
MarkerDetector::~MarkerDetector() = default;

Result<MarkerDetector> MarkerDetector::create(const DetectorOptions& options) {
  if (Status status = check(options); !status) {
    return status.error();
  }
  auto library = std::make_unique<Library>();
  if (Status status = library->set_up(options); !status) {
    return status.error();
  }
  return MarkerDetector(std::move(library));
}

Status MarkerDetector::detect(const GreyImage& image, std::vector<MarkerCorners>& found) {
  return detect(image, {0, 0, image.width_px, image.height_px}, found);
}

Status MarkerDetector::detect(const GreyImage& image, const PixelBox& box,
                              std::vector<MarkerCorners>& found) {
  found.clear();
  if (Status status = check(image); !status) {
    return status;
  }
  if (box.width_px <= 0 || box.height_px <= 0) {
    return {};
  }
  const PixelBox crop = in_whole_steps(box, image, library_->step_px);
  const int smallest_px = kSmallestPx * library_->step_px / kTilePx;
  if (crop.width_px < smallest_px || crop.height_px < smallest_px) {
    return {};
  }
  const Vec2 offset_px{static_cast<double>(crop.x_px), static_cast<double>(crop.y_px)};
  if (Status status = library_->detect(image, crop, offset_px, found); !status) {
    return status;
  }
  if (library_->refinement == Refinement::kEdges) {
    for (MarkerCorners& marker : found) {
      marker.corners_px = refined_corners(image, marker.corners_px);
    }
  }
  const auto& families = library_->families;
  if (std::any_of(families.begin(), families.end(),
                  [this](const TagFamily& family) { return library_->may_be_touched(family); })) {
    look_for_touched(image, crop, found);
  }
  std::sort(found.begin(), found.end(), comes_before);
  return {};
}

void MarkerDetector::look_for_touched(const GreyImage& image, const PixelBox& crop,
                                      std::vector<MarkerCorners>& found) {
  Library& library = *library_;
  // A plain tag can decode as one with a wide border.
  std::erase_if(found, [&](const MarkerCorners& marker) {
    if (marker.family != kWideFamily) {
      return false;
    }
    std::vector<MarkerCorners> read;
    library.read(image, marker.corners_px, false, read);
    return std::none_of(read.begin(), read.end(),
                        [&](const MarkerCorners& other) { return same_tag(marker, other); });
  });
  std::vector<MarkerCorners> more;
  for (const int window_px : kThinningWindowsPx) {
    thin(image, crop, window_px, library.thinned);
    const Vec2 offset_px = thinned_offset(window_px) +
                           Vec2{static_cast<double>(crop.x_px), static_cast<double>(crop.y_px)};
    image_u8_t view = {crop.width_px, crop.height_px, crop.width_px, library.thinned.pixels.data()};
    zarray_t* quads = apriltag_quad_thresh(library.detector, &view);
    for (int i = 0; quads && i < zarray_size(quads); ++i) {
      quad outline{};
      zarray_get(quads, i, &outline);
      std::array<Vec2, 4> corners_px;
      for (std::size_t k = 0; k < 4; ++k) {
        corners_px[k] = Vec2{outline.p[k][0], outline.p[k][1]} + offset_px;
      }
      for (int round = 0; round < kRefinementsOfThinned; ++round) {
        corners_px = refined_corners(image, corners_px);
      }
      library.read(image, corners_px, true, more);
    }
    if (quads) {
      zarray_destroy(quads);
    }
  }
  for (const MarkerCorners& marker : more) {
    const auto other = std::find_if(found.begin(), found.end(), [&](const MarkerCorners& each) {
      return same_tag(marker, each);
    });
    if (other == found.end()) {
      found.push_back(marker);
    } else if (library.refinement == Refinement::kEdges) {
      // If squares touch the tag, the outline found in the image itself is worse.
      *other = marker;
    }
  }
}

}  // namespace orthonav::nav
