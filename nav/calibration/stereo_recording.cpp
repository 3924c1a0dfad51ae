#include "nav/calibration/stereo_recording.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/findings.h"
#include "base/how_many.h"
#include "base/printed.h"
#include "nav/calibration/body_jackknife.h"
#include "nav/calibration/body_start.h"
#include "nav/calibration/coverage.h"
#include "nav/calibration/epipolar.h"
#include "nav/statistics/blocked_jackknife.h"
#include "nav/statistics/median.h"

namespace orthonav::nav {
namespace {

constexpr std::size_t kRecordingMinPairs = 20;
/// Pairs are thinned evenly to this many.
constexpr std::size_t kRecordingMaxPairs = 400;
constexpr double kRecordingMaxRms_px = 1.0;
constexpr double kRecordingMaxSizeDeviation = 0.05;
/// The calibration counts as off if it differs by at least this many SDs, and by at least this
/// many pixels.
constexpr double kRecordingSignificance = 3.0;
constexpr double kRecordingMinOff_px = 0.1;
/// Limits beyond which a result gets a note.
constexpr double kRecordingNoteSigma_px = 0.05;
constexpr double kRecordingNoteCoveredFraction = 0.3;

Error stereo_refused(const std::string& why) { return Error{"stereo calibration: " + why}; }

/// The tags that both cameras saw.
std::vector<PairSightings> seen_by_both(std::span<const PairSightings> pairs) {
  std::vector<PairSightings> both(pairs.begin(), pairs.end());
  for (PairSightings& pair : both) {
    std::erase_if(pair, [](const TagSighting& seen) { return !seen.pose; });
  }
  return both;
}

double median_size_ratio(std::span<const PairSightings> pairs) {
  std::vector<double> ratios;
  for (const PairSightings& pair : pairs) {
    for (const TagSighting& seen : pair) {
      if (seen.pose) {
        ratios.push_back(seen.pose->size_ratio);
      }
    }
  }
  return ratios.empty() ? 1.0 : median(std::move(ratios));
}

/// Signed distance of every right corner from its epipolar line; NaN where a pixel has no
/// direction, so that the lists of two calibrations correspond.
std::vector<double> across_px(const BodyProblem& problem,
                              const Transform<RightCamera, Rig>& right_from_rig) {
  const StereoCalibration& cameras = problem.calibration;
  const auto right_from_left = right_from_rig * cameras.left_from_rig.inverse();
  std::vector<double> all;
  for (const PairSightings& pair : problem.pairs) {
    for (const TagSighting& seen : pair) {
      for (std::size_t i = 0; i < 4; ++i) {
        all.push_back(across_epipolar_px(cameras.left, cameras.right, right_from_left,
                                         (*seen.left_px)[i], (*seen.right_px)[i])
                          .value_or(std::nan("")));
      }
    }
  }
  return all;
}

double rms(const std::vector<double>& values) {
  double squared = 0.0;
  double count = 0.0;
  for (const double v : values) {
    if (std::isfinite(v)) {
      squared += v * v;
      count += 1.0;
    }
  }
  return std::sqrt(squared / std::max(count, 1.0));
}

/// RMS of the differences across the lines between two calibrations.
double rms_between(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] -= b[i];
  }
  return rms(a);
}

struct CameraSigma {
  double rotation_rad = 0.0;
  double translation_m = 0.0;
  double off_px = 0.0;
};

/// By leaving out each tenth of the pairs in turn.
CameraSigma camera_sigma(const BodyProblem& problem, const BodyState& whole) {
  const std::vector<double> all_px = across_px(problem, whole.right_from_rig);
  double rotation_squares = 0.0;
  double translation_squares = 0.0;
  double off = 0.0;
  double blocks = 0.0;
  for (const BodyState& state : adjusted_without_blocks(problem, whole)) {
    const auto& a = whole.right_from_rig;
    const auto& b = state.right_from_rig;
    rotation_squares += std::pow(rotation_angle_rad(a.rotation(), b.rotation()), 2);
    translation_squares += (b.translation() - a.translation()).squared_norm();
    off += std::pow(rms_between(across_px(problem, b), all_px), 2);
    blocks += 1.0;
  }
  if (blocks < 2.0) {
    return {};
  }
  const double factor = (blocks - 1.0) / blocks;
  return {std::sqrt(factor * rotation_squares), std::sqrt(factor * translation_squares),
          std::sqrt(factor * off)};
}

double covered_fraction(const BodyProblem& problem) {
  const CameraModel& left = problem.calibration.left;
  const CameraModel& right = problem.calibration.right;
  Coverage on_left(left.width_px(), left.height_px());
  Coverage on_right(right.width_px(), right.height_px());
  for (const PairSightings& pair : problem.pairs) {
    for (const TagSighting& seen : pair) {
      for (std::size_t i = 0; i < 4; ++i) {
        on_left.add((*seen.left_px)[i]);
        on_right.add((*seen.right_px)[i]);
      }
    }
  }
  return std::min(on_left.fraction(), on_right.fraction());
}

StereoRecording result_of(const BodyProblem& problem, const BodyState& state, const BodyFit& fit) {
  const StereoCalibration& device = problem.calibration;
  StereoRecording result;
  result.right_from_rig = state.right_from_rig;
  result.right_from_left = state.right_from_rig * device.left_from_rig.inverse();
  const auto measured_from_device = state.right_from_rig * device.right_from_rig.inverse();
  result.rotation_rad = vector_from_rotation(measured_from_device.rotation());
  result.translation_m = measured_from_device.translation();
  const std::vector<double> before_px = across_px(problem, device.right_from_rig);
  const std::vector<double> after_px = across_px(problem, state.right_from_rig);
  result.epipolar_before_px = rms(before_px);
  result.epipolar_after_px = rms(after_px);
  result.off_px = rms_between(before_px, after_px);
  result.rms_px = fit.rms_px;
  result.covered_fraction = covered_fraction(problem);
  result.size_ratio = median_size_ratio(problem.pairs);
  result.pairs = problem.pairs.size();
  const CameraSigma sigma = camera_sigma(problem, state);
  const PoseCovariance& c = fit.covariances.front();
  result.rotation_sigma_rad = std::max(rotation_sigma_rad(c), sigma.rotation_rad);
  result.translation_sigma_m = std::max(translation_sigma_m(c), sigma.translation_m);
  result.off_sigma_px = sigma.off_px;
  return result;
}

void judge(StereoRecording& result) {
  Judgement& judgement = result.judgement;
  result.is_off = result.off_px > kRecordingMinOff_px &&
                  result.off_px > kRecordingSignificance * result.off_sigma_px;
  const std::string off =
      printed("%.3f ± %.3f px across the epipolar lines", result.off_px, result.off_sigma_px);
  if (result.is_off) {
    judgement.add(Verdict::kNote, "the device's calibration is off by " + off);
  }
  if (!(result.rms_px <= kRecordingMaxRms_px)) {
    judgement.add(Verdict::kFail, with_numbers("residual %.2f px RMS, limit %.2f px (is the board "
                                               "flat, are the lenses as the device says?)",
                                               result.rms_px, kRecordingMaxRms_px));
  }
  if (result.off_sigma_px > kRecordingNoteSigma_px) {
    judgement.add(Verdict::kNote, with_numbers("known to %.2f px only, better %.2f px",
                                               result.off_sigma_px, kRecordingNoteSigma_px));
  }
  if (result.covered_fraction < kRecordingNoteCoveredFraction) {
    judgement.add(Verdict::kNote,
                  with_numbers("the board reached %.0f %% of the image only, better %.0f %%",
                               100 * result.covered_fraction, 100 * kRecordingNoteCoveredFraction));
  }
  if (!result.is_off) {
    judgement.add(Verdict::kPass, "the device's calibration holds: " + off);
  }
}

Status check_pairs(const BodyProblem& problem) {
  if (problem.pairs.size() < kRecordingMinPairs) {
    return stereo_refused("both cameras see two tags of the board or more in " +
                          how_many(problem.pairs.size(), "pair") + ", at least " +
                          std::to_string(kRecordingMinPairs) + " are needed");
  }
  const double ratio = median_size_ratio(problem.pairs);
  if (!(std::abs(ratio - 1.0) <= kRecordingMaxSizeDeviation)) {
    return stereo_refused(
        printed("the tags' edges measure %.3f of the size given, must be within "
                "%.2f of it (was the board printed at 100 %%?)",
                ratio, kRecordingMaxSizeDeviation));
  }
  return {};
}

}  // namespace

Result<StereoRecording> calibrate_stereo(const StereoCalibration& calibration,
                                         std::span<const BoardTag> board,
                                         std::span<const PairSightings> pairs) {
  BodyProblem problem;
  BodyState state;
  problem.calibration = calibration;
  problem.find_right_camera = true;
  state.right_from_rig = calibration.right_from_rig;
  for (const BoardTag& tag : board) {
    problem.size_m.push_back(tag.definition.size_m);
    problem.find_tag.push_back(false);
    state.marker_from_tag.push_back(tag.board_from_tag);
  }
  take_pairs(seen_by_both(pairs), kRecordingMaxPairs, problem, state);
  if (Status status = check_pairs(problem); !status) {
    return status.error();
  }
  const auto fit = adjust(problem, state);
  if (!fit) {
    return stereo_refused(fit.error().message);
  }
  StereoRecording result = result_of(problem, state, *fit);
  judge(result);
  return result;
}

}  // namespace orthonav::nav
