#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/vec.h"

namespace orthonav::nav {

/// Whole pixels of an image.
struct PixelBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};

/// The part of the box inside the image, widened to whole steps from the image's first pixel and by
/// one more step on every side as far as the image goes. Empty boxes may be returned with negative
/// sides.
[[nodiscard]] PixelBox in_whole_steps(const PixelBox& box, const GreyImage& image, int step_px);

/// One tag in one image. Corners in continuous pixels (first pixel's centre at (0.5, 0.5)) in the
/// order of the upright tag's: bottom left, bottom right, top right, top left, seen on its face;
/// that is Marker coordinates (-s, -s), (s, -s), (s, s), (-s, s) with s = size / 2.
struct MarkerCorners {
  std::string_view family;  ///< one of `known_families()`, valid forever
  int id = 0;
  std::array<Vec2, 4> corners_px;
  double decision_margin = 0.0;
  int hamming = 0;
};

/// How the corners are refined beyond the quad's outline.
enum class Refinement {
  kNone,     ///< they are left as they are
  kLibrary,  ///< the library's own
  kEdges     ///< `refined_corners`
};

struct DetectorOptions {
  std::vector<std::string> families = {"tag36h11"};
  double decimate = 1.0;  ///< 1: full resolution for quads; 1.5, 2, 3 or 4: less
  int max_hamming = 1;    ///< corrected bits, 0-2; at most 1 for families of over 10,000 codes
  double min_decision_margin = 25.0;
  int threads = 1;
  Refinement refinement = Refinement::kLibrary;
  /// Tags whose corners black squares touch, as on calibration boards, are looked for as well, in
  /// two thinned images of full resolution (three times the work). Of tag36h11b2 they always are;
  /// of families with a white border, which squares do not touch, never. Corners of a tag that only
  /// thinning shows are those of `kEdges` whatever the refinement.
  bool touched = false;
};

/// Names of the tag families that can be detected. tag36h11b2 has the codes of tag36h11 inside a
/// black border two cells wide, as Kalibr prints its AprilGrid; its size is measured at the outer
/// edge of that border, ten cells.
[[nodiscard]] std::span<const std::string_view> known_families();
/// How many ids a family has; 0 for an unknown one.
[[nodiscard]] int family_size(std::string_view family);
/// One tag's code as the AprilTag library stores it.
struct TagCode {
  struct Bit {
    int row = 0;  ///< of its cell, counted from the outer edge of the border, negative outside it
    int column = 0;
    bool white = false;
  };
  int cells = 0;              ///< per side of all that the family defines
  int border_cells = 0;       ///< per side of the outer edge of the border
  bool white_border = false;  ///< or black
  std::vector<Bit> bits;
};
/// Nothing for a family or an id that does not exist.
[[nodiscard]] std::optional<TagCode> tag_code(std::string_view family, int id);
/// The names in one line, for messages.
[[nodiscard]] std::string known_families_text();

/// AprilTag 3's detector (Krogius, Haggenmiller, Olson 2019). One thread at a time. The images are
/// read in place; the library allocates its own working memory for every call.
class MarkerDetector {
 public:
  static Result<MarkerDetector> create(const DetectorOptions& options);
  MarkerDetector(MarkerDetector&&) noexcept;
  MarkerDetector& operator=(MarkerDetector&&) noexcept;
  ~MarkerDetector();
  /// Every tag of the whole image, or of the box (clipped to the image), sorted by family, id and
  /// position. The box is widened to whole tiles of the library's threshold with one to spare, so
  /// that a tag inside it has the same corners as in the whole image (within 1e-3 px). Refuses an
  /// image without pixels, of the wrong length or too large for the library; `found` is then empty.
  Status detect(const GreyImage& image, std::vector<MarkerCorners>& found);
  Status detect(const GreyImage& image, const PixelBox& box, std::vector<MarkerCorners>& found);

 private:
  struct Library;
  explicit MarkerDetector(std::unique_ptr<Library> library);
  void look_for_touched(const GreyImage& image, const PixelBox& crop,
                        std::vector<MarkerCorners>& found);
  std::unique_ptr<Library> library_;
};

}  // namespace orthonav::nav
