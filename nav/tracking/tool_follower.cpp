#include "nav/tracking/tool_follower.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "nav/geometry/matrix_as.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
namespace {

constexpr int kLargestRadiusPx = 40;
/// Wide searches look at every second pixel first.
constexpr int kFineRadiusPx = 6;
constexpr double kFewestCells = 8.0;

/// Correlation of single pixels' grey with a template of zeros and ones.
struct Correlation {
  double n = 0.0;
  double grey = 0.0;
  double grey2 = 0.0;
  double white = 0.0;
  double both = 0.0;

  void add(const GreyImage& image, int x, int y, float template_white) {
    if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px) {
      return;
    }
    const double g = image.at(x, y);
    const auto w = static_cast<double>(template_white);
    n += 1.0;
    grey += g;
    grey2 += g * g;
    white += w;
    both += w * g;
  }
  [[nodiscard]] double value() const {
    // The template's squares equal its values.
    const double spread = (n * grey2 - grey * grey) * (n * white - white * white);
    return n < kFewestCells || !(spread > 0.0) ? 0.0
                                               : (n * both - grey * white) / std::sqrt(spread);
  }
};

}  // namespace

CellMatch TagSearch::at(const GreyImage& image, int dx, int dy) const {
  Correlation all;
  for (const Cell& cell : cells_) {
    all.add(image, cell.x_px + dx, cell.y_px + dy, cell.white);
  }
  CellMatch match;
  match.offset_px = {static_cast<double>(dx), static_cast<double>(dy)};
  match.fraction = all.n / static_cast<double>(all_cells_);
  match.correlation = all.value();
  return match;
}

double TagSearch::code_at(const GreyImage& image, Vec2 offset_px) const {
  Correlation code;
  for (const Cell& cell : cells_) {
    if (cell.code) {
      code.add(image, cell.x_px + static_cast<int>(offset_px.x),
               cell.y_px + static_cast<int>(offset_px.y), cell.white);
    }
  }
  return code.value();
}

CellMatch TagSearch::match(const GreyImage& image, const CameraModel& camera, const BlurredTag& tag,
                           const CameraFromTag& pose) {
  const int n = tag.cells().cells;
  cells_.clear();
  all_cells_ = static_cast<std::size_t>(n * n);
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const Vec3 in_tag{(column + 0.5 - 0.5 * n) * tag.cell_m(),
                        (0.5 * n - row - 0.5) * tag.cell_m(), 0.0};
      const auto pixel = camera.project(pose.rotation * in_tag + pose.translation_m);
      if (!pixel) {
        continue;
      }
      cells_.push_back({static_cast<int>(std::floor(pixel->x)),
                        static_cast<int>(std::floor(pixel->y)), tag.cells().at(row, column),
                        tag.cells().code[static_cast<std::size_t>(row * n + column)]});
    }
  }
  CellMatch here = at(image, 0, 0);
  here.code = code_at(image, {});
  return here;
}

CellMatch TagSearch::best_offset(const GreyImage& image, int radius_px) const {
  const int radius = std::clamp(radius_px, 1, kLargestRadiusPx);
  const int step = radius > kFineRadiusPx ? 2 : 1;
  CellMatch best = at(image, 0, 0);
  const auto look = [&](int x, int y) {
    const CellMatch here = at(image, x, y);
    if (here.correlation > best.correlation) {
      best = here;
    }
  };
  for (int y = -radius; y <= radius; y += step) {
    for (int x = -radius; x <= radius; x += step) {
      look(x, y);
    }
  }
  const int x0 = static_cast<int>(best.offset_px.x);
  const int y0 = static_cast<int>(best.offset_px.y);
  for (int y = y0 - 1; step > 1 && y <= y0 + 1; ++y) {
    for (int x = x0 - 1; x <= x0 + 1; ++x) {
      look(x, y);
    }
  }
  best.code = code_at(image, best.offset_px);
  return best;
}

namespace {

constexpr double kUsual_s = 0.005;
constexpr double kLongest_s = 0.030;
/// Forgetting factor: pairs of the last few seconds count.
constexpr double kForgetting = 0.99;
/// The weight of the prior for the usual exposure: that of one fast sighting (v² / 12 in px⁴/s⁴).
constexpr double kBelief = 2e6;
/// Pairs farther apart than this say nothing about speed.
constexpr Duration kLongestGap = std::chrono::milliseconds(120);

}  // namespace

void ExposureEstimator::add(const BlurSighting& sighting) {
  if (before_ && middle_ && before_->view == sighting.view && middle_->view == sighting.view &&
      sighting.time > before_->time && sighting.time - before_->time <= kLongestGap) {
    // The speed at the middle sighting, without the delay of a one-sided difference.
    const double dt = seconds(sighting.time - before_->time);
    const Vec2 speed = (1.0 / dt) * (sighting.centre_px - before_->centre_px);
    const Vec2 c = middle_->column_px;
    const Vec2 r = middle_->row_px;
    const double area = c.cross(r);
    const double across = speed.cross(r) / area;
    const double down = c.cross(speed) / area;
    if (std::isfinite(across) && std::isfinite(down)) {
      add(middle_->blur_cells.x * middle_->blur_cells.x * c.dot(c), across * across * c.dot(c));
      add(middle_->blur_cells.y * middle_->blur_cells.y * r.dot(r), down * down * r.dot(r));
    }
  }
  before_ = middle_;
  middle_ = sighting;
}

void ExposureEstimator::add(double blur_px2, double speed_px2) {
  const double x = speed_px2 / 12.0;
  n_ = kForgetting * n_ + 1.0;
  x_ = kForgetting * x_ + x;
  y_ = kForgetting * y_ + blur_px2;
  xx_ = kForgetting * xx_ + x * x;
  xy_ = kForgetting * xy_ + x * blur_px2;
}

double ExposureEstimator::exposure_s() const {
  if (!(n_ > 0.0)) {
    return kUsual_s;
  }
  const double spread = xx_ - x_ * x_ / n_;
  const double both = xy_ - x_ * y_ / n_;
  const double squared = (both + kBelief * kUsual_s * kUsual_s) / (spread + kBelief);
  return std::clamp(std::sqrt(std::max(0.0, squared)), 0.0, kLongest_s);
}

namespace {

/// Required correlations of a tag's cells with its template: where it is expected, somewhere near,
/// and after the measurement. Texture reaches 0.4; a half-hidden tag 0.6.
constexpr double kFoundHere = 0.75;
constexpr double kFoundNear = 0.6;
constexpr double kBelieved = 0.55;
/// Correlation over the cells that distinguish ids. Another id reaches 0.39 at most (11 of 36
/// differ).
constexpr double kSameId = 0.5;
/// The fraction of a tag that a single camera must see: with less, a wrong pose may explain the
/// rest.
constexpr double kKeptByOne = 0.7;
/// Where the fit to both pictures keeps less of a tag in one, something hides it there, or the two
/// pictures contradict each other and the robust fit leaves out what does.
constexpr double kKeptByBoth = 0.88;
/// An image with less of a tag than this is not used.
constexpr double kLeastFraction = 0.5;
/// A tag tilted by more than 80° is practically a line.
constexpr double kLeastCosine = 0.17;
constexpr double kFarthestDoubtPx = 24.0;
/// Where the search found nothing to shift, the pose is off by less than this fraction of a cell.
constexpr double kUndisplacedCells = 0.3;

const GreyImage& image_of(const StereoFrame& frame, const TagView& view) {
  return view.right ? frame.right : frame.left;
}

const CameraModel& camera_of(const PhotometricSolver& solver, const TagView& view) {
  return view.right ? solver.calibration().right : solver.calibration().left;
}

bool faces(const CameraFromTag& pose) {
  const double distance = pose.translation_m.norm();
  return pose.translation_m.z > 0.05 &&
         -pose.rotation.column(2).dot(pose.translation_m) > kLeastCosine * distance;
}

/// Where a view's tag is found, at the pose or near it; nothing if it is not there.
std::optional<CellMatch> match_near(const StereoFrame& frame, const TagView& view,
                                    const CameraFromTag& seen, double doubt_m,
                                    const PhotometricSolver& solver, TagSearch& search) {
  const GreyImage& image = image_of(frame, view);
  CellMatch match = search.match(image, camera_of(solver, view), *view.tag, seen);
  if (match.fraction < kLeastFraction) {
    return std::nullopt;
  }
  if (match.correlation < kFoundHere) {
    const double px = solver.focal_px(view.right) * doubt_m / seen.translation_m.z;
    match = search.best_offset(image, static_cast<int>(std::ceil(std::min(px, kFarthestDoubtPx))));
    if (match.correlation < kFoundNear) {
      return std::nullopt;
    }
  }
  return match.code < kSameId ? std::nullopt : std::optional(match);
}

/// Whether the image shows a view's tag where the tool's pose puts it.
bool is_shown(const StereoFrame& frame, const TagView& view, const Transform<Rig, Marker>& pose,
              const PhotometricSolver& solver, TagSearch& search) {
  const CellMatch match = search.match(image_of(frame, view), camera_of(solver, view), *view.tag,
                                       solver.camera_from_tag(view, pose));
  return match.correlation >= kBelieved && match.code >= kSameId;
}

/// Converts shifts in the images to a translation in space, by least squares.
struct TranslationInSpace {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();

  void add(const CameraModel& camera, const Mat3& camera_from_rig, Vec3 in_camera_m,
           Vec2 offset_px) {
    const Vec2 u{in_camera_m.x / in_camera_m.z, in_camera_m.y / in_camera_m.z};
    const auto from = camera.project(u);
    const auto to = from ? camera.unproject(*from + offset_px) : std::nullopt;
    if (!to) {
      return;
    }
    for (int k = 0; k < 2; ++k) {
      const double slope = k == 0 ? u.x : u.y;
      const Vec3 row = (camera_from_rig.row(k) - slope * camera_from_rig.row(2)) / in_camera_m.z;
      const auto j = vector_as<Eigen::Vector3d>(row);
      normal += j * j.transpose();
      right += j * (k == 0 ? to->x - u.x : to->y - u.y);
    }
  }
  /// With one camera only, depth stays as it was.
  [[nodiscard]] Vec3 solved() const {
    const double weak = 1e-4 * std::max(normal.trace(), 1e-12);
    const Eigen::Vector3d v = (normal + weak * Eigen::Matrix3d::Identity()).ldlt().solve(right);
    return vec_of(v);
  }
};

}  // namespace

Status ToolFollower::add(const MarkerDefinition& marker,
                         const Transform<Marker, Tag>& marker_from_tag) {
  auto tag = tag_template(marker.family, marker.id);
  if (!tag) {
    return Error{"tag family '" + marker.family + "' has no id " + std::to_string(marker.id)};
  }
  tags_.emplace_back(std::move(*tag), marker.size_m);
  stated_sizes_m_.push_back(marker.size_m);
  for (const bool right : {false, true}) {
    TagView view;
    view.marker_from_tag = marker_from_tag;
    view.right = right;
    views_.push_back(view);
  }
  return {};
}

Result<ToolFollower> ToolFollower::create(const ToolGeometry& tool) {
  ToolFollower follower;
  Status added = follower.add(tool.marker, {});
  for (std::size_t i = 0; i < tool.more_markers.size() && added; ++i) {
    added = follower.add(tool.more_markers[i].definition, tool.more_markers[i].marker_from_tag);
  }
  if (!added) {
    return Error{"tool '" + tool.name + "': " + added.error().message};
  }
  follower.light_.resize(follower.views_.size());
  follower.found_.resize(follower.views_.size());
  return follower;
}

void ToolFollower::set_size_factor(double factor) {
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    tags_[i].set_size(factor * stated_sizes_m_[i]);
  }
}

void ToolFollower::forget() { light_.assign(views_.size(), {}); }

bool ToolFollower::choose_views(const StereoFrame& frame, Transform<Rig, Marker>& pose,
                                double doubt_m, const PhotometricSolver& solver,
                                TagSearch& search) {
  TranslationInSpace translation;
  bool displaced = false;
  bool any = false;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    TagView& view = views_[i];
    view.tag = &tags_[i / 2];
    view.light = light_[i];
    view.used = false;
    found_[i].reset();
    const CameraFromTag seen = solver.camera_from_tag(view, pose);
    if (!faces(seen)) {
      continue;
    }
    const auto match = match_near(frame, view, seen, doubt_m, solver, search);
    if (!match) {
      continue;
    }
    displaced = displaced || match->offset_px.norm() > 0.0;
    const Mat3& camera_from_rig = view.right ? solver.calibration().right_from_rig.rotation()
                                             : solver.calibration().left_from_rig.rotation();
    translation.add(camera_of(solver, view), camera_from_rig, seen.translation_m, match->offset_px);
    TranslationInSpace alone;
    alone.add(camera_of(solver, view), camera_from_rig, seen.translation_m, match->offset_px);
    found_[i] = Transform<Rig, Marker>{pose.rotation(), pose.translation() + alone.solved()};
    view.used = any = true;
  }
  if (!any) {
    return false;
  }
  if (displaced) {
    pose = {pose.rotation(), pose.translation() + translation.solved()};
  }
  return true;
}

std::optional<ToolFit> ToolFollower::follow(const StereoFrame& frame,
                                            const Transform<Rig, Marker>& expected, double doubt_m,
                                            PhotometricSolver& solver, TagSearch& search) {
  Transform<Rig, Marker> start = expected;
  if (!choose_views(frame, start, doubt_m, solver, search)) {
    return std::nullopt;
  }
  const double cell_m = tags_.front().cell_m();
  const auto fit =
      solver.solve(frame, start, std::min(doubt_m, kUndisplacedCells * cell_m), views_);
  if (!fit) {
    return std::nullopt;
  }
  for (const TagView& view : views_) {
    if (view.used && (!is_shown(frame, view, fit->rig_from_marker, solver, search) ||
                      (fit->left != fit->right && view.kept_fraction < kKeptByOne))) {
      return std::nullopt;
    }
  }
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (views_[i].used) {
      light_[i] = views_[i].light;
    }
  }
  learn_exposure(frame, fit->rig_from_marker, solver);
  ToolFit out{fit->rig_from_marker, rotated(fit->covariance, fit->rig_from_marker.rotation()),
              fit->left, fit->right, solver.calibration_equations(*fit, views_)};
  const bool doubtful = std::any_of(views_.begin(), views_.end(), [](const TagView& view) {
    return view.used && view.kept_fraction < kKeptByBoth;
  });
  if (doubtful || fit->left != fit->right) {
    if (const auto alone = equations_alone(frame, *fit, solver, search)) {
      out.calibration = alone;
    }
  }
  return out;
}

std::optional<CalibrationEquations> ToolFollower::equations_alone(const StereoFrame& frame,
                                                                  const PhotometricFit& fit,
                                                                  PhotometricSolver& solver,
                                                                  TagSearch& search) {
  // What one view says of the tool's pose, as equations at the pose of the fit.
  const auto says = [&](std::size_t i) -> std::optional<ReducedView> {
    if (!views_[i].used && !found_[i]) {
      return std::nullopt;
    }
    alone_ = views_[i];
    alone_.light = light_[i];
    alone_.used = true;
    const auto best = solver.solve(frame, views_[i].used ? fit.rig_from_marker : *found_[i],
                                   kUndisplacedCells * alone_.tag->cell_m(), {&alone_, 1});
    // It may be hidden there.
    if (!best || alone_.kept_fraction < kKeptByOne ||
        !is_shown(frame, alone_, best->rig_from_marker, solver, search)) {
      return std::nullopt;
    }
    return PhotometricSolver::shifted(alone_, solver.view_equations(0, alone_),
                                      best->rig_from_marker, fit.rig_from_marker);
  };
  CalibrationEquations out;
  for (std::size_t left = 0; left < views_.size(); left += 2) {
    const auto of_left = says(left);
    const auto of_right = of_left ? says(left + 1) : std::nullopt;
    if (of_right) {
      solver.add_tag(fit.rig_from_marker, views_[left], *of_left, views_[left + 1], *of_right, out);
    }
  }
  return out.tags > 0 ? std::optional(out) : std::nullopt;
}

void ToolFollower::learn_exposure(const StereoFrame& frame, const Transform<Rig, Marker>& pose,
                                  const PhotometricSolver& solver) {
  std::size_t i = 0;
  while (!views_[i].used) {
    ++i;
  }
  const TagView& view = views_[i];
  const CameraFromTag seen = solver.camera_from_tag(view, pose);
  const CameraModel& camera = camera_of(solver, view);
  const auto pixel = [&](Vec3 in_tag) {
    return camera.project(seen.rotation * in_tag + seen.translation_m);
  };
  const double cell_m = view.tag->cell_m();
  const auto centre = pixel({});
  const auto across = pixel({cell_m, 0.0, 0.0});
  const auto down = pixel({0.0, -cell_m, 0.0});
  if (!centre || !across || !down) {
    return;
  }
  exposure_.add({i,
                 frame.time,
                 *centre,
                 *across - *centre,
                 *down - *centre,
                 {view.light.blur_cells[0], view.light.blur_cells[1]}});
}

}  // namespace orthonav::nav
