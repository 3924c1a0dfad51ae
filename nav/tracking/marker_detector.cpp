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
#include <bit>
#include <cmath>
#include <cstddef>
#include <Eigen/Dense>
#include <tuple>

#include "nav/statistics/median.h"
#include "nav/tracking/bilinear.h"

// Finds the outlines that `apriltag_detector_detect` decodes; exported by the library, but not in
// its header.
extern "C" zarray_t* apriltag_quad_thresh(apriltag_detector_t* detector, image_u8_t* image);

// From families of tags to tags found in pairs: what the AprilTag library knows of a family,
// corners moved to where edges meet, a tag read within given corners, the detector of one image,
// and of two.
namespace orthonav::nav {

/// tag36h11 with a black border two cells wide.
inline constexpr std::string_view kWideFamily = "tag36h11b2";

/// A family as the AprilTag library holds it; knows which of `known_families()` it is.
struct FreeFamily {
  std::size_t index = 0;
  void operator()(apriltag_family* family) const;
};
using TagFamily = std::unique_ptr<apriltag_family, FreeFamily>;

namespace {

struct Family {
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
  int codes;
};

/// The library finds quads at the outer edge of the border, and samples bits and grey levels in
/// cells counted from there: two cells of border push the bits in by one.
apriltag_family_t* tag36h11b2_create() {
  apriltag_family_t* family = tag36h11_create();
  if (!family) {
    return nullptr;
  }
  family->width_at_border += 2;
  family->total_width += 2;
  for (std::uint32_t i = 0; i < family->nbits; ++i) {
    ++family->bit_x[i];
    ++family->bit_y[i];
  }
  return family;
}

constexpr std::array<std::string_view, 10> kNames = {
    "tag36h11",      "tag25h9",        "tag16h5",        "tagStandard41h12", "tagStandard52h13",
    "tagCircle21h7", "tagCircle49h12", "tagCustom48h12", "tag36h10",         kWideFamily};
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
    {tag36h11b2_create, tag36h11_destroy, 587},
}};

std::size_t family_index(std::string_view name) {
  return static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

/// Null for an unknown family, or if memory runs out.
TagFamily create_family(std::string_view name) {
  const std::size_t index = family_index(name);
  if (index >= kFamilies.size()) {
    return {};
  }
  return {kFamilies[index].create(), FreeFamily{index}};
}

}  // namespace

void FreeFamily::operator()(apriltag_family* family) const { kFamilies[index].destroy(family); }

std::span<const std::string_view> known_families() { return kNames; }

std::string known_families_text() {
  std::string text;
  for (const std::string_view name : kNames) {
    if (!text.empty()) {
      text += ", ";
    }
    text += name;
  }
  return text;
}

int family_size(std::string_view family) {
  const std::size_t index = family_index(family);
  return index < kFamilies.size() ? kFamilies[index].codes : 0;
}

bool is_known_family(const std::string& family) { return family_index(family) < kNames.size(); }

// Everything is black except a white ring one cell wide outside the border (or, where the border is
// white, the border itself) and the bits that are set.
std::optional<TagTemplate> tag_template(std::string_view family, int id) {
  if (id < 0 || id >= family_size(family)) {
    return std::nullopt;
  }
  const TagFamily table = create_family(family);
  if (!table) {
    return std::nullopt;
  }
  TagTemplate tag;
  tag.cells = table->total_width;
  tag.border_cells = table->width_at_border;
  tag.white.assign(static_cast<std::size_t>(tag.cells * tag.cells), 0.0F);
  tag.code.assign(tag.white.size(), false);
  const auto index = [&](int row, int column) {
    return static_cast<std::size_t>(row * tag.cells + column);
  };
  const int ring = tag.border_cells + (table->reversed_border ? 0 : 2);
  const int first = (tag.cells - ring) / 2;
  const int last = first + ring - 1;
  for (int i = first; i <= last; ++i) {
    tag.white[index(first, i)] = tag.white[index(last, i)] = tag.white[index(i, first)] =
        tag.white[index(i, last)] = 1.0F;
  }
  // Places of bits are counted from the outer edge of the border.
  const int border = (tag.cells - tag.border_cells) / 2;
  for (std::uint32_t bit = 0; bit < table->nbits; ++bit) {
    const std::size_t i = index(static_cast<int>(table->bit_y[bit]) + border,
                                static_cast<int>(table->bit_x[bit]) + border);
    tag.code[i] = true;
    if (((table->codes[id] >> (table->nbits - bit - 1)) & 1U) != 0) {
      tag.white[i] = 1.0F;
    }
  }
  return tag;
}

namespace {

/// How far across an edge its true position is searched for. Farther out lies the next cell: the
/// cells of a small tag are three pixels wide.
constexpr double kReach_px = 1.25;

// About one ray per pixel of an edge, within these limits.
constexpr int kFewestRays = 8;
constexpr int kMaxRays = 200;
// A shorter edge has no middle part that its corners leave undisturbed.
constexpr double kShortestEdgePx = 6.0;
constexpr double kStepPx = 0.25;
constexpr double kHalfBasePx = 0.5;
// How much of each end of an edge is left out: the neighbouring edge's blur reaches there.
constexpr double kEndPx = 1.0;
constexpr double kEndFraction = 0.08;
// A sum of squared slopes below this is noise, in squared grey levels.
constexpr double kFaintest = 1.0;
// Tukey's constant: 95 % efficient for normal errors.
constexpr double kTukey = 4.685;
constexpr double kMadToSd = 1.4826;
constexpr double kLeastScalePx = 0.05;
constexpr int kReweightings = 5;
// The intersection of nearly parallel edges is meaningless.
constexpr double kLeastSine = 0.05;

struct Line {
  Vec2 point;
  Vec2 direction;  ///< of length 1
};

/// Where a ray crosses an edge, and how clearly.
struct Crossing {
  Vec2 place;
  double steepness = 0.0;
};

/// +1 when the image gets brighter along the normal, else -1.
double sense_of(const GreyImage& image, Vec2 a, Vec2 b, Vec2 normal) {
  constexpr int kProbes = 9;
  double brighter = 0.0;
  for (int i = 1; i <= kProbes; ++i) {
    const Vec2 p = a + (i / (kProbes + 1.0)) * (b - a);
    brighter += grey_at(image, p + 1.5 * normal) - grey_at(image, p - 1.5 * normal);
  }
  return brighter < 0 ? -1.0 : 1.0;
}

std::optional<Crossing> crossing(const GreyImage& image, Vec2 base, Vec2 rising, double reach_px) {
  double sum = 0.0;
  double total = 0.0;
  const int steps = static_cast<int>(std::lround(reach_px / kStepPx));
  for (int i = -steps; i <= steps; ++i) {
    const double n = i * kStepPx;
    const double slope = grey_at(image, base + (n + kHalfBasePx) * rising) -
                         grey_at(image, base + (n - kHalfBasePx) * rising);
    if (slope <= 0) {
      continue;
    }
    sum += slope * slope * n;
    total += slope * slope;
  }
  if (total < kFaintest) {
    return std::nullopt;
  }
  return Crossing{base + (sum / total) * rising, std::sqrt(total)};
}

/// Total least squares with these weights; nothing when all of them are zero.
std::optional<Line> line_through(const std::vector<Crossing>& seen,
                                 const std::vector<double>& weights) {
  double total = 0.0;
  Vec2 mean;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    total += weights[i];
    mean = mean + weights[i] * seen[i].place;
  }
  if (!(total > 0)) {
    return std::nullopt;
  }
  mean = (1 / total) * mean;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec2 d = seen[i].place - mean;
    xx += weights[i] * d.x * d.x;
    xy += weights[i] * d.x * d.y;
    yy += weights[i] * d.y * d.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  return Line{mean, {std::cos(angle), std::sin(angle)}};
}

std::optional<Line> robust_line(const std::vector<Crossing>& seen) {
  std::vector<double> weights;
  for (const Crossing& each : seen) {
    weights.push_back(each.steepness);
  }
  std::vector<double> off_px(seen.size());
  std::optional<Line> line = line_through(seen, weights);
  for (int round = 0; round < kReweightings && line; ++round) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      off_px[i] = std::abs((seen[i].place - line->point).cross(line->direction));
    }
    const double limit_px = kTukey * std::max(kLeastScalePx, kMadToSd * median(off_px));
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double u = std::min(off_px[i] / limit_px, 1.0);
      weights[i] = seen[i].steepness * (1 - u * u) * (1 - u * u);
    }
    line = line_through(seen, weights);
  }
  return line;
}

/// The edge from a to b as found in the image, or as given.
Line edge(const GreyImage& image, Vec2 a, Vec2 b, double reach_px) {
  const double length_px = (b - a).norm();
  const Vec2 along = (1 / length_px) * (b - a);
  const Vec2 normal{-along.y, along.x};
  const Vec2 rising = sense_of(image, a, b, normal) * normal;
  const double end_px = std::max(kEndPx, kEndFraction * length_px);
  const int rays = std::clamp(static_cast<int>(length_px), kFewestRays, kMaxRays);
  std::vector<Crossing> seen;
  for (int i = 0; i < rays; ++i) {
    const double at_px = end_px + (length_px - 2 * end_px) * (i + 0.5) / rays;
    if (const auto found = crossing(image, a + at_px * along, rising, reach_px)) {
      seen.push_back(*found);
    }
  }
  const Line as_it_was{a, along};
  if (seen.size() < static_cast<std::size_t>(rays) / 2) {
    return as_it_was;
  }
  return robust_line(seen).value_or(as_it_was);
}

/// The corners of a dark or bright square, moved to where its four edges meet. Each edge is the
/// line through the places of steepest grey on rays across it, weighted by the steepness; rays that
/// disagree with the others lose their weight (Tukey's biweight). Grey is interpolated, which on
/// rendered tags makes these lines twice as exact as with the library's own refinement. An edge
/// without enough agreeing rays stays as it was. Corners in continuous pixels, in either sense of
/// rotation.
std::array<Vec2, 4> refined_corners(const GreyImage& image, const std::array<Vec2, 4>& corners_px) {
  if (image.width_px < 2 || image.height_px < 2) {
    return corners_px;
  }
  std::array<Line, 4> edges;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corners_px[i];
    const Vec2 b = corners_px[(i + 1) % 4];
    if (!((b - a).norm() >= kShortestEdgePx)) {
      return corners_px;
    }
    edges[i] = edge(image, a, b, kReach_px);
  }
  std::array<Vec2, 4> refined = corners_px;
  for (std::size_t i = 0; i < 4; ++i) {
    const Line& before = edges[(i + 3) % 4];
    const Line& after = edges[i];
    const double sine = before.direction.cross(after.direction);
    if (std::abs(sine) < kLeastSine) {
      continue;
    }
    const double along = (after.point - before.point).cross(after.direction) / sine;
    const Vec2 meeting = before.point + along * before.direction;
    // A corner farther off than edges were searched for has slid along a misjudged edge.
    if ((meeting - corners_px[i]).norm() <= 2 * kReach_px) {
      refined[i] = meeting;
    }
  }
  return refined;
}

// A highlight or a speck may hide a cell of a ring.
constexpr int kBrightCellsAllowed = 1;
// The library's: how much a cell is set off from its neighbours before it is compared.
constexpr double kSharpening = 0.25;
// A highlight or a marker may hide two of the four squares; a tag beside something dark has one.
constexpr int kFewestDarkCorners = 2;

/// The projective map of the unit square to a quadrangle: (0, 0), (1, 0), (1, 1), (0, 1) to the
/// corners (Heckbert 1989, section 2.2.3).
class SquareToQuad {
 public:
  explicit SquareToQuad(const std::array<Vec2, 4>& q) : origin_(q[0]) {
    const Vec2 d1 = q[1] - q[2];
    const Vec2 d2 = q[3] - q[2];
    const Vec2 sum = q[0] - q[1] + q[2] - q[3];
    g_ = sum.cross(d2) / d1.cross(d2);
    h_ = d1.cross(sum) / d1.cross(d2);
    along_ = q[1] - q[0] + g_ * q[1];
    up_ = q[3] - q[0] + h_ * q[3];
  }
  [[nodiscard]] Vec2 operator()(double u, double v) const {
    return (1.0 / (g_ * u + h_ * v + 1.0)) * (u * along_ + v * up_ + origin_);
  }

 private:
  Vec2 origin_;
  Vec2 along_;
  Vec2 up_;
  double g_ = 0.0;
  double h_ = 0.0;
};

/// +1 for a convex quadrangle whose corners turn to the right as seen (y down), -1 to the left, as
/// those of `MarkerCorners` do; else 0.
int turning_sense(const std::array<Vec2, 4>& corners) {
  int right = 0;
  int left = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corners[(i + 1) % 4] - corners[i];
    const Vec2 b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    const double turn = a.cross(b);
    right += turn > 0;
    left += turn < 0;
  }
  return right == 4 ? 1 : left == 4 ? -1 : 0;
}

/// Calls `visit` with row and column of every cell on the ring `ring` cells inside the outer edge.
template <class Visit>
void along_ring(int cells, int ring, Visit visit) {
  const int last = cells - 1 - ring;
  for (int i = ring; i < last; ++i) {
    visit(i, ring);
    visit(last, i);
    visit(cells - 1 - i, last);
    visit(ring, cells - 1 - i);
  }
}

/// A grey level that changes linearly over the tag.
class GreyPlane {
 public:
  void add(double u, double v, double grey) {
    const Eigen::Vector3d at(u, v, 1);
    normal_ += at * at.transpose();
    right_ += grey * at;
  }
  void solve() { plane_ = normal_.ldlt().solve(right_); }
  [[nodiscard]] double at(double u, double v) const {
    return plane_.x() * u + plane_.y() * v + plane_.z();
  }

 private:
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();
};

/// The cells of a quad, above zero where they are nearer to its surroundings' grey than to its
/// border's.
class Cells {
 public:
  Cells(const GreyImage& image, const std::array<Vec2, 4>& corners_px, int cells)
      : cells_(cells), above_(static_cast<std::size_t>(cells * cells)) {
    const SquareToQuad place(corners_px);
    const auto grey = [&](int row, int column) {
      const Vec2 at = place((column + 0.5) / cells_, 1 - (row + 0.5) / cells_);
      return std::isfinite(at.x + at.y) ? grey_at(image, at) : 0.0;
    };
    GreyPlane black;
    GreyPlane white;
    along_ring(cells_, 0, [&](int row, int column) { black.add(column, row, grey(row, column)); });
    along_ring(cells_, -1, [&](int row, int column) {
      const bool corner = (row < 0 || row == cells_) && (column < 0 || column == cells_);
      if (!corner) {
        white.add(column, row, grey(row, column));
      }
    });
    black.solve();
    white.solve();
    for (const int row : {-1, cells_}) {
      for (const int column : {-1, cells_}) {
        const double middle = 0.5 * (black.at(column, row) + white.at(column, row));
        dark_corners_ += grey(row, column) < middle;
      }
    }
    const double middle = 0.5 * (cells_ - 1);
    contrast_ = white.at(middle, middle) - black.at(middle, middle);
    std::vector<double> raw(above_.size());
    for (int row = 0; row < cells_; ++row) {
      for (int column = 0; column < cells_; ++column) {
        raw[index(row, column)] =
            grey(row, column) - 0.5 * (black.at(column, row) + white.at(column, row));
      }
    }
    for (int row = 0; row < cells_; ++row) {
      for (int column = 0; column < cells_; ++column) {
        const double here = raw[index(row, column)];
        double against = 4 * here;
        against -= row > 0 ? raw[index(row - 1, column)] : 0;
        against -= row + 1 < cells_ ? raw[index(row + 1, column)] : 0;
        against -= column > 0 ? raw[index(row, column - 1)] : 0;
        against -= column + 1 < cells_ ? raw[index(row, column + 1)] : 0;
        above_[index(row, column)] = here + kSharpening * against;
      }
    }
  }

  [[nodiscard]] double contrast() const { return contrast_; }
  /// Of the cells just outside the four corners.
  [[nodiscard]] int dark_corners() const { return dark_corners_; }
  [[nodiscard]] int bright_on_ring(int ring) const {
    int bright = 0;
    along_ring(cells_, ring, [&](int row, int column) { bright += above(row, column) > 0; });
    return bright;
  }
  [[nodiscard]] double above(int row, int column) const { return above_[index(row, column)]; }
  /// Of the tag that is upright after `turns` quarter turns.
  [[nodiscard]] double above(int row, int column, int turns) const {
    for (int i = 0; i < turns; ++i) {
      const int before = row;
      row = cells_ - 1 - column;
      column = before;
    }
    return above(row, column);
  }

 private:
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row * cells_ + column);
  }
  int cells_;
  double contrast_ = 0.0;
  int dark_corners_ = 0;
  std::vector<double> above_;
};

/// How many rings of the border hold no bit of the code.
int border_rings(const apriltag_family& family) {
  int rings = family.width_at_border;
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    rings =
        std::min({rings, static_cast<int>(family.bit_x[bit]), static_cast<int>(family.bit_y[bit])});
  }
  return rings;
}

/// Mean distance of the bits from the middle grey, of the worse of black and white.
double margin(const Cells& cells, const apriltag_family& family, int turns) {
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    const double above = cells.above(static_cast<int>(family.bit_y[bit]),
                                     static_cast<int>(family.bit_x[bit]), turns);
    const std::size_t white = above > 0 ? 1 : 0;
    sum[white] += std::abs(above);
    ++count[white];
  }
  return std::min(sum[0] / std::max(1, count[0]), sum[1] / std::max(1, count[1]));
}

/// Shrinks dark areas in a part of an image: every pixel becomes the brightest of a window of
/// `window_px` pixels per side that begins with it and extends to the right and down. Black squares
/// that touch a tag's corners are one dark area with it; this separates them, so that the tag's
/// outline appears. A position in `thinned` corresponds in `image` to the same position plus the
/// box's corner and `thinned_offset(window_px)`.
void thin(const GreyImage& image, const PixelBox& box, int window_px, GreyImage& thinned) {
  thinned.width_px = box.width_px;
  thinned.height_px = box.height_px;
  thinned.pixels.resize(static_cast<std::size_t>(box.width_px) *
                        static_cast<std::size_t>(box.height_px));
  for (int y = 0; y < box.height_px; ++y) {
    for (int x = 0; x < box.width_px; ++x) {
      const int right = std::min(box.x_px + x + window_px, image.width_px);
      const int bottom = std::min(box.y_px + y + window_px, image.height_px);
      std::uint8_t brightest = 0;
      for (int row = box.y_px + y; row < bottom; ++row) {
        for (int column = box.x_px + x; column < right; ++column) {
          brightest = std::max(brightest, image.at(column, row));
        }
      }
      thinned.at(x, y) = brightest;
    }
  }
}

Vec2 thinned_offset(int window_px) { return {0.5 * (window_px - 1), 0.5 * (window_px - 1)}; }

/// The tag of a family with a black border that these corners outline, in any cyclic order or
/// sense: with corners as `MarkerCorners` has them, and margin and corrected bits as the library
/// counts them. Nothing where bits differ from every code by more than `max_hamming`, where a cell
/// or two of the border are bright, or where the surroundings are not brighter than the border
/// (the corners of the surroundings do not count). `touched`: there is something dark at two of its
/// corners or more.
std::optional<MarkerCorners> read_tag(const GreyImage& image, const std::array<Vec2, 4>& corners_px,
                                      const apriltag_family& family, int max_hamming,
                                      bool& touched) {
  std::array<Vec2, 4> corners = corners_px;
  const int sense = turning_sense(corners);
  if (sense == 0) {
    return std::nullopt;
  }
  if (sense > 0) {
    std::swap(corners[1], corners[3]);
  }
  const Cells cells(image, corners, family.width_at_border);
  if (!(cells.contrast() > 0)) {
    return std::nullopt;
  }
  for (int ring = 0; ring < border_rings(family); ++ring) {
    if (cells.bright_on_ring(ring) > kBrightCellsAllowed) {
      return std::nullopt;
    }
  }
  MarkerCorners best;
  best.hamming = max_hamming + 1;
  int best_turns = 0;
  for (int turns = 0; turns < 4; ++turns) {
    std::uint64_t code = 0;
    for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
      const bool white = cells.above(static_cast<int>(family.bit_y[bit]),
                                     static_cast<int>(family.bit_x[bit]), turns) > 0;
      code = code << 1U | (white ? 1U : 0U);
    }
    for (std::uint32_t id = 0; id < family.ncodes; ++id) {
      const int hamming = std::popcount(code ^ family.codes[id]);
      if (hamming < best.hamming) {
        best.hamming = hamming;
        best.id = static_cast<int>(id);
        best_turns = turns;
      }
    }
  }
  if (best.hamming > max_hamming) {
    return std::nullopt;
  }
  best.decision_margin = margin(cells, family, best_turns);
  touched = cells.dark_corners() >= kFewestDarkCorners;
  for (std::size_t i = 0; i < 4; ++i) {
    best.corners_px[i] = corners[(i + static_cast<std::size_t>(best_turns)) % 4];
  }
  return best;
}

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

/// The part of the box inside the image, widened to whole steps from the image's first pixel and by
/// one more step on every side as far as the image goes. Empty boxes may be returned with negative
/// sides.
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

}  // namespace

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

void SearchPlan::add(const TagCorners& corners_px, const BoxRoom& room, std::string_view family,
                     int id) {
  Vec2 low = corners_px[0];
  Vec2 high = low;
  for (const Vec2 corner : corners_px) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  const double extent_px = std::max(high.x - low.x, high.y - low.y);
  const double room_px = room.px + room.of_extent * extent_px;
  constexpr double kFarPx = 1e5;
  // Negated, so that non-finite corners stay out as well.
  if (!(std::abs(low.x) + std::abs(low.y) + extent_px + room_px < kFarPx)) {
    return;
  }
  const auto whole = [](double v) { return static_cast<int>(std::floor(v)); };
  boxes.push_back(
      {{whole(low.x - room_px), whole(low.y - room_px), whole(high.x - low.x + 2.0 * room_px) + 1,
        whole(high.y - low.y + 2.0 * room_px) + 1},
       family,
       id});
}

PairDetector::PairDetector(MarkerDetector left, MarkerDetector right, bool parallel)
    : left_{std::move(left), {}, nullptr, {}, {}}, right_{std::move(right), {}, nullptr, {}, {}} {
  if (parallel) {
    worker_.emplace();
  }
}

Result<std::unique_ptr<PairDetector>> PairDetector::create(const DetectorOptions& options,
                                                           bool parallel) {
  Result<MarkerDetector> left = MarkerDetector::create(options);
  if (!left) {
    return left.error();
  }
  Result<MarkerDetector> right = MarkerDetector::create(options);
  if (!right) {
    return right.error();
  }
  return std::make_unique<PairDetector>(std::move(left).value(), std::move(right).value(),
                                        parallel);
}

void PairDetector::detect_side(void* argument) {
  Side& side = *static_cast<Side*>(argument);
  side.found.clear();
  if (side.plan.everywhere) {
    if (!side.detector.detect(*side.image, side.found)) {
      side.found.clear();
    }
    return;
  }
  for (const SearchPlan::Box& box : side.plan.boxes) {
    if (!side.detector.detect(*side.image, box.box, side.in_box)) {
      continue;
    }
    // Boxes may overlap: only the tag that a box was made for counts, or a tag would be found
    // twice.
    for (const MarkerCorners& marker : side.in_box) {
      if (marker.family == box.family && marker.id == box.id) {
        side.found.push_back(marker);
      }
    }
  }
}

void PairDetector::detect(const StereoFrame& frame) {
  left_.image = &frame.left;
  right_.image = &frame.right;
  if (worker_) {
    worker_->start(&detect_side, &right_);
  }
  detect_side(&left_);
  if (worker_) {
    worker_->wait();
  } else {
    detect_side(&right_);
  }
}

namespace {

std::string name_of_tag(std::string_view family, int id) {
  return std::string(family) + " id " + std::to_string(id);
}

bool is_of(const ToolGeometry& tool, std::string_view family, int id) {
  const auto is = [&](const MarkerDefinition& tag) { return tag.id == id && tag.family == family; };
  return is(tool.marker) || std::any_of(tool.more_markers.begin(), tool.more_markers.end(),
                                        [&](const AttachedMarker& m) { return is(m.definition); });
}

}  // namespace

void SeenTags::add(std::span<const MarkerCorners> found) {
  for (const MarkerCorners& marker : found) {
    const auto known = std::find_if(tags_.begin(), tags_.end(), [&](const Tag& tag) {
      return tag.id == marker.id && tag.family == marker.family;
    });
    if (known != tags_.end()) {
      ++known->times;
    } else if (tags_.size() < kMax) {
      tags_.push_back({marker.family, marker.id, 1});
    }
  }
}

bool SeenTags::has_other_than(std::span<const ToolGeometry> tools) const {
  return std::any_of(tags_.begin(), tags_.end(), [&](const Tag& tag) {
    return std::none_of(tools.begin(), tools.end(),
                        [&](const ToolGeometry& tool) { return is_of(tool, tag.family, tag.id); });
  });
}

std::string SeenTags::text() const {
  constexpr std::size_t kListed = 8;
  std::vector<Tag> sorted = tags_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Tag& a, const Tag& b) { return a.times > b.times; });
  std::string text;
  for (std::size_t i = 0; i < std::min(kListed, sorted.size()); ++i) {
    text += (i == 0 ? "" : ", ") + name_of_tag(sorted[i].family, sorted[i].id);
  }
  return text + (sorted.size() > kListed ? ", ..." : "");
}

std::string SeenTags::never_seen(const MarkerDefinition& tag) const {
  ToolGeometry alone;
  alone.marker = tag;
  return never_seen(alone);
}

std::string SeenTags::never_seen(const ToolGeometry& tool) const {
  const bool seen = std::any_of(tags_.begin(), tags_.end(),
                                [&](const Tag& tag) { return is_of(tool, tag.family, tag.id); });
  if (tags_.empty() || !tool.has_tag() || seen) {
    return {};
  }
  return "tag " + name_of_tag(tool.marker.family, tool.marker.id) +
         (tool.name.empty() ? "" : " of '" + tool.name + "'") + " was never seen, only " + text();
}

}  // namespace orthonav::nav
