#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/vec.h"
#include "hal/api/devices.h"
#include "nav/tracking/tool.h"
#include "nav/tracking/worker.h"

namespace orthonav::nav {

/// Whole pixels of an image.
struct PixelBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};

using TagCorners = std::array<Vec2, 4>;

/// One tag in one image. Corners in continuous pixels (first pixel's centre at (0.5, 0.5)) in the
/// order of the upright tag's: bottom left, bottom right, top right, top left, seen on its face;
/// that is Marker coordinates (-s, -s), (s, -s), (s, s), (-s, s) with s = size / 2.
struct MarkerCorners {
  std::string_view family;  ///< one of `known_families()`, valid forever
  int id = 0;
  TagCorners corners_px;
  double decision_margin = 0.0;
  int hamming = 0;
};

/// How the corners are refined beyond the quad's outline.
enum class Refinement {
  kNone,     ///< they are left as they are
  kLibrary,  ///< the library's own
  kEdges     ///< to where the lines of steepest grey along the four edges meet
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
/// The names in one line, for messages.
[[nodiscard]] std::string known_families_text();

/// A printed tag's pattern: a square of cells, seen upright, row 0 on top, from one edge of the
/// part that the family defines to the other (including its white ring, if it has one).
struct TagTemplate {
  int cells = 0;             ///< per side
  int border_cells = 0;      ///< per side of the square whose outer edge is the tag's size
  std::vector<float> white;  ///< row-major, 1: white, 0: black
  std::vector<bool> code;    ///< row-major, whether the cell distinguishes ids

  [[nodiscard]] float at(int row, int column) const {
    return white[static_cast<std::size_t>(row * cells + column)];
  }
  /// Length of a cell on a tag of the given size.
  [[nodiscard]] double cell_m(double size_m) const { return size_m / border_cells; }
};

/// The template of a tag from the AprilTag library's tables; nothing for a family or an id that
/// does not exist.
[[nodiscard]] std::optional<TagTemplate> tag_template(std::string_view family, int id);

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

/// Margin around a tag's expected corners on every side: a fraction of their extent, and pixels.
struct BoxRoom {
  double of_extent = 0.0;
  double px = 0.0;
};

/// Where to look in one image: everywhere, or in boxes that each concern one tag.
struct SearchPlan {
  struct Box {
    PixelBox box;
    std::string_view family;
    int id = 0;
  };
  bool everywhere = true;
  std::vector<Box> boxes;

  /// Plans a box around a tag; none if the corners are not finite or far outside any image.
  void add(const TagCorners& corners_px, const BoxRoom& room, std::string_view family, int id);
};

/// Finds tags in pairs of images. One thread at a time.
class TagFinder {
 public:
  virtual ~TagFinder() = default;
  [[nodiscard]] virtual SearchPlan& left_plan() = 0;
  [[nodiscard]] virtual SearchPlan& right_plan() = 0;
  /// Fills `left()` and `right()` as planned.
  virtual void detect(const StereoFrame& frame) = 0;
  [[nodiscard]] virtual std::span<const MarkerCorners> left() const = 0;
  [[nodiscard]] virtual std::span<const MarkerCorners> right() const = 0;
};

/// Detects tags in both images of a pair, concurrently when a second thread is given; the result is
/// the same.
class PairDetector final : public TagFinder {
 public:
  static Result<std::unique_ptr<PairDetector>> create(const DetectorOptions& options,
                                                      bool parallel);
  PairDetector(MarkerDetector left, MarkerDetector right, bool parallel);

  [[nodiscard]] SearchPlan& left_plan() override { return left_.plan; }
  [[nodiscard]] SearchPlan& right_plan() override { return right_.plan; }
  /// An image that the detector refuses shows no tags.
  void detect(const StereoFrame& frame) override;
  [[nodiscard]] std::span<const MarkerCorners> left() const override { return left_.found; }
  [[nodiscard]] std::span<const MarkerCorners> right() const override { return right_.found; }

 private:
  struct Side {
    MarkerDetector detector;
    SearchPlan plan;
    const GreyImage* image = nullptr;
    std::vector<MarkerCorners> found;
    std::vector<MarkerCorners> in_box;
  };
  static void detect_side(void* side);

  Side left_;
  Side right_;
  std::optional<Worker> worker_;
};

/// Which tags were found in images, whether or not anything has them, to say so where one that is
/// looked for was never seen.
class SeenTags {
 public:
  SeenTags() { tags_.reserve(kMax); }
  /// Allocates nothing; beyond `kMax` different tags new ones are left out.
  void add(std::span<const MarkerCorners> found);
  /// "tag tag36h11 id 7 of 'pointer' was never seen, only tag36h11 id 3, tag36h11 id 4" (the most
  /// frequent first); empty if one of its tags was, if it has none, and if no tag was seen at all.
  [[nodiscard]] std::string never_seen(const ToolGeometry& tool) const;
  /// The same for the tag alone.
  [[nodiscard]] std::string never_seen(const MarkerDefinition& tag) const;
  /// Whether one was seen that none of these tools has.
  [[nodiscard]] bool has_other_than(std::span<const ToolGeometry> tools) const;

 private:
  [[nodiscard]] std::string text() const;

  static constexpr std::size_t kMax = 64;
  struct Tag {
    std::string_view family;
    int id = 0;
    std::int64_t times = 0;
  };
  std::vector<Tag> tags_;
};

}  // namespace orthonav::nav
