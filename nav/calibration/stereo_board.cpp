#include "nav/calibration/stereo_board.h"

#include <algorithm>
#include <cmath>

#include "base/findings.h"
#include "base/how_many.h"
#include "base/joined.h"
#include "base/printed.h"
#include "nav/calibration/coverage.h"
#include "nav/calibration/epipolar.h"
#include "nav/calibration/stereo_jackknife.h"
#include "nav/statistics/median.h"

namespace orthonav::nav {
namespace {

constexpr std::size_t kBoardMinViews = 3;
/// A view whose residual is this many times the median one contains a mistake and is left out.
constexpr double kBoardOutlierFactor = 3.0;
constexpr double kBoardMaxRms_px = 1.0;
constexpr double kBoardMaxFocalSigmaFraction = 0.02;
/// Limits beyond which a result gets a note.
constexpr std::size_t kBoardNoteViews = 10;
constexpr double kBoardNoteRms_px = 0.45;
constexpr double kBoardNoteFocalSigmaFraction = 0.005;
constexpr double kBoardNoteBaselineSigmaFraction = 0.005;
constexpr double kBoardNoteCoveredFraction = 0.5;
constexpr double kSignificant = 3.0;
// A view with a smaller residual than this contains no mistake.
constexpr double kNoMistakePx = 0.3;

Status check_views(const Chessboard& board, ImageSize size, std::span<const BoardView> views) {
  std::vector<std::string> problems = board.check();
  if (size.width_px <= 0 || size.height_px <= 0) {
    problems.emplace_back("images without pixels");
  }
  for (const BoardView& view : views) {
    if (view.left_px.size() != board.corners() || view.right_px.size() != board.corners()) {
      problems.emplace_back("a view has not as many corners as the board");
      break;
    }
  }
  if (views.size() < kBoardMinViews) {
    problems.push_back("the board is seen in " + how_many(views.size(), "pair") + ", at least " +
                       std::to_string(kBoardMinViews) + " are needed");
  }
  if (problems.empty()) {
    return {};
  }
  return Error{"stereo calibration: " + joined(problems)};
}

/// If half a turn of the board goes unnoticed, both cameras are assumed to be the same way up.
BoardViews aligned(const Chessboard& board, std::span<const BoardView> views) {
  BoardViews split;
  for (const BoardView& view : views) {
    split.left.push_back(view.left_px);
    split.right.push_back(view.right_px);
    if (!board.looks_the_same_rotated()) {
      continue;
    }
    BoardCorners& right = split.right.back();
    const Vec2 along_left = view.left_px.back() - view.left_px.front();
    if (along_left.dot(right.back() - right.front()) < 0) {
      std::reverse(right.begin(), right.end());
    }
  }
  return split;
}

bool is_invertible(const BrownConrady& camera) {
  return CameraModel::from_brown_conrady(camera).ok();
}

struct Start {
  CameraFit left;
  CameraFit right;
  LensTerms terms = LensTerms::kTwo;
};

Result<Start> start_with(const Chessboard& board, ImageSize size, const BoardViews& views,
                         LensTerms terms) {
  const auto left = fit_camera(board, size, views.left, terms);
  if (!left) {
    return left.error();
  }
  const auto right = fit_camera(board, size, views.right, terms);
  if (!right) {
    return right.error();
  }
  return Start{*left, *right, terms};
}

Result<Start> each_by_itself(const Chessboard& board, ImageSize size, const BoardViews& views,
                             bool rational) {
  if (rational) {
    return start_with(board, size, views, LensTerms::kRational);
  }
  const auto is_significant = [](const CameraFit& fit) {
    return std::abs(fit.camera.k3) > kSignificant * fit.k3_sigma;
  };
  const auto full = start_with(board, size, views, LensTerms::kThree);
  if (full && (is_significant(full->left) || is_significant(full->right)) &&
      is_invertible(full->left.camera) && is_invertible(full->right.camera)) {
    return full;
  }
  return start_with(board, size, views, LensTerms::kTwo);
}

double view_rms_px(const StereoFit& fit, std::size_t view) {
  const auto& [left, right] = fit.view_rms_px[view];
  return std::sqrt(0.5 * (left * left + right * right));
}

/// The worst view, if it contains a mistake.
std::optional<std::size_t> mistaken_view(const StereoFit& fit, double factor) {
  std::vector<double> all;
  for (std::size_t i = 0; i < fit.view_rms_px.size(); ++i) {
    all.push_back(view_rms_px(fit, i));
  }
  const auto worst = std::max_element(all.begin(), all.end());
  if (*worst <= std::max(kNoMistakePx, factor * median(all))) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(worst - all.begin());
}

struct Fitted {
  StereoFit fit;
  Start start;
  BoardViews used;
  std::vector<std::size_t> numbers;  ///< of the views used
  std::optional<double> plain_rms_px = {};
};

Result<Fitted> without_mistakes(const Chessboard& board, ImageSize size, BoardViews views,
                                const StereoBoardOptions& options, bool rational,
                                std::vector<BoardViewResidual>& residuals) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < views.left.size(); ++i) {
    numbers.push_back(i);
  }
  const auto most_left_out =
      static_cast<std::size_t>(options.max_outlier_fraction * static_cast<double>(numbers.size()));
  for (std::size_t left_out = 0;; ++left_out) {
    const auto start = each_by_itself(board, size, views, rational);
    if (!start) {
      return start.error();
    }
    const auto fit = fit_stereo(board, size, views.left, views.right, start->left.camera,
                                start->right.camera, start->terms);
    if (!fit) {
      return fit.error();
    }
    const auto mistake = mistaken_view(*fit, kBoardOutlierFactor);
    if (!mistake || left_out == most_left_out || numbers.size() == kBoardMinViews) {
      return Fitted{*fit, *start, views, numbers};
    }
    residuals[numbers[*mistake]] = {false, fit->view_rms_px[*mistake][0],
                                    fit->view_rms_px[*mistake][1], 0.0};
    views.leave_out(*mistake);
    numbers.erase(numbers.begin() + static_cast<long>(*mistake));
  }
}

/// By the plain lens model, or, where that leaves too much, by the rational one, if that leaves
/// less and can be inverted.
Result<Fitted> fitted_to(const Chessboard& board, ImageSize size, const BoardViews& views,
                         const StereoBoardOptions& options,
                         std::vector<BoardViewResidual>& residuals) {
  auto plain = without_mistakes(board, size, views, options, false, residuals);
  if (plain && plain->fit.rms_px <= kBoardMaxRms_px) {
    return plain;
  }
  std::vector<BoardViewResidual> of_rational(residuals.size());
  auto rational = without_mistakes(board, size, views, options, true, of_rational);
  if (!rational || (plain && rational->fit.rms_px >= plain->fit.rms_px) ||
      !is_invertible(rational->fit.left) || !is_invertible(rational->fit.right)) {
    return plain;
  }
  residuals = of_rational;
  if (plain) {
    rational->plain_rms_px = plain->fit.rms_px;
  }
  return rational;
}

/// RMS distance of the right corners from the epipolar lines.
double epipolar_rms_px(const CameraModel& left, const CameraModel& right,
                       const Transform<RightCamera, LeftCamera>& right_from_left,
                       const BoardCorners& left_px, const BoardCorners& right_px) {
  double squared = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < left_px.size(); ++i) {
    if (const auto off =
            across_epipolar_px(left, right, right_from_left, left_px[i], right_px[i])) {
      squared += *off * *off;
      count += 1.0;
    }
  }
  return count > 0 ? std::sqrt(squared / count) : 0.0;
}

double covered_fraction(ImageSize size, std::span<const BoardCorners> views) {
  Coverage coverage(size.width_px, size.height_px);
  for (const BoardCorners& view : views) {
    for (const Vec2 p : view) {
      coverage.add(p);
    }
  }
  return coverage.fraction();
}

Status fill_epipolar(const BoardViews& all, StereoBoardCalibration& result) {
  const auto left = CameraModel::from_brown_conrady(result.left);
  const auto right = CameraModel::from_brown_conrady(result.right);
  if (!left || !right) {
    return Error{"stereo calibration: the lens model folds over (" +
                 (left ? right : left).error().message + "): more views, up to the image's edges"};
  }
  double squared = 0.0;
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    BoardViewResidual& view = result.views[i];
    view.epipolar_rms_px =
        epipolar_rms_px(*left, *right, result.right_from_left, all.left[i], all.right[i]);
    if (view.used) {
      squared += view.epipolar_rms_px * view.epipolar_rms_px;
    }
  }
  result.epipolar_rms_px = std::sqrt(squared / static_cast<double>(result.used));
  return {};
}

void judge_precision(StereoBoardCalibration& result) {
  Judgement& judgement = result.judgement;
  if (!result.sigma) {
    judgement.add(Verdict::kNote, "too few views to tell how exact it is");
    return;
  }
  const double focal = result.sigma->focal_fraction;
  const double baseline = result.sigma->baseline_m / result.baseline_m();
  if (focal > kBoardNoteFocalSigmaFraction) {
    judgement.add(
        focal > kBoardMaxFocalSigmaFraction ? Verdict::kFail : Verdict::kNote,
        with_numbers("the focal length is known to %.2f %% only, better %.2f %% (tilt the board)",
                     100 * focal, 100 * kBoardNoteFocalSigmaFraction));
  }
  if (baseline > kBoardNoteBaselineSigmaFraction) {
    judgement.add(Verdict::kNote,
                  with_numbers("the baseline is known to %.2f %% only, better %.2f %%",
                               100 * baseline, 100 * kBoardNoteBaselineSigmaFraction));
  }
}

void judge(StereoBoardCalibration& result) {
  Judgement& judgement = result.judgement;
  if (!(result.stereo_rms_px <= kBoardNoteRms_px)) {
    judgement.add(
        result.stereo_rms_px <= kBoardMaxRms_px ? Verdict::kNote : Verdict::kFail,
        with_numbers("stereo RMS %.2f px, limit %.2f px", result.stereo_rms_px,
                     result.stereo_rms_px <= kBoardMaxRms_px ? kBoardNoteRms_px : kBoardMaxRms_px));
  }
  if (result.left.is_rational()) {
    judgement.add(Verdict::kNote,
                  "the rational lens model is used (8 coefficients), since the plain one " +
                      (result.plain_rms_px ? printed("leaves %.2f px", *result.plain_rms_px)
                                           : std::string("fits no lens")));
  }
  if (result.used < result.views.size()) {
    judgement.add(Verdict::kNote, std::to_string(result.views.size() - result.used) +
                                      " views left out for their residuals");
  }
  if (result.used < kBoardNoteViews) {
    judgement.add(Verdict::kNote,
                  with_numbers("%.0f views, better %.0f", static_cast<double>(result.used),
                               static_cast<double>(kBoardNoteViews)));
  }
  if (result.covered_fraction < kBoardNoteCoveredFraction) {
    judgement.add(Verdict::kNote,
                  with_numbers("the board reached %.0f %% of the image only, better %.0f %%",
                               100 * result.covered_fraction, 100 * kBoardNoteCoveredFraction));
  }
  judge_precision(result);
  judgement.conclude();
}

}  // namespace

Result<StereoBoardCalibration> calibrate_stereo(const Chessboard& board, ImageSize size,
                                                std::span<const BoardView> views,
                                                const StereoBoardOptions& options) {
  if (Status status = check_views(board, size, views); !status) {
    return status.error();
  }
  const BoardViews all = aligned(board, views);
  StereoBoardCalibration result;
  result.views.resize(views.size());
  const auto fitted = fitted_to(board, size, all, options, result.views);
  if (!fitted) {
    return fitted.error();
  }
  const StereoFit& fit = fitted->fit;
  result.left = fit.left;
  result.right = fit.right;
  result.right_from_left = fit.right_from_left;
  result.left_rms_px = fitted->start.left.rms_px;
  result.right_rms_px = fitted->start.right.rms_px;
  result.stereo_rms_px = fit.rms_px;
  result.plain_rms_px = fitted->plain_rms_px;
  result.used = fitted->numbers.size();
  for (std::size_t i = 0; i < fitted->numbers.size(); ++i) {
    BoardViewResidual& view = result.views[fitted->numbers[i]];
    view.left_rms_px = fit.view_rms_px[i][0];
    view.right_rms_px = fit.view_rms_px[i][1];
  }
  result.covered_fraction = std::min(covered_fraction(size, fitted->used.left),
                                     covered_fraction(size, fitted->used.right));
  if (Status status = fill_epipolar(all, result); !status) {
    return status.error();
  }
  result.sigma = stereo_sigma(board, size, fitted->used, fit, fitted->start.terms);
  judge(result);
  return result;
}

}  // namespace orthonav::nav
