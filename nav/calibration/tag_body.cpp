#include "nav/calibration/tag_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angle.h"
#include "base/findings.h"
#include "base/how_many.h"
#include "base/joined.h"
#include "nav/calibration/body_jackknife.h"
#include "nav/calibration/body_start.h"
#include "nav/statistics/blocked_jackknife.h"
#include "nav/statistics/median.h"

namespace orthonav::nav {
namespace {

/// Two tags count as connected when both cameras saw them together in at least this many pairs.
constexpr std::size_t kBodyMinPairsTogether = 10;
/// Pairs are thinned evenly to this many.
constexpr std::size_t kBodyMaxPairs = 600;
/// Tags that move relative to each other make more corners misfit (a quarter of them, from a
/// millimetre of motion), or leave a larger residual.
constexpr double kBodyMaxRms_px = 0.5;
constexpr double kBodyMaxOutlierFraction = 0.15;
constexpr double kBodyMaxSigma_m = 0.001;
/// Limits beyond which a result gets a note.
constexpr double kBodyNoteSigma_m = 0.0002;
constexpr double kBodyNoteSigma_rad = 0.005;
constexpr double kBodyNoteSizeDeviation = 0.02;
constexpr double kBodyNoteOutlierFraction = 0.08;
constexpr std::size_t kBodyNotePairs = 50;

std::string name_of(const MarkerDefinition& tag) {
  return "tag " + tag.family + " id " + std::to_string(tag.id);
}

Error body_refused(const std::string& why) { return Error{"tool calibration: " + why}; }

Status check_input(std::span<const MarkerDefinition> tags) {
  std::vector<std::string> problems;
  if (tags.size() < 2) {
    problems.push_back(how_many(tags.size(), "tag") + ", at least 2 are needed");
  }
  ToolGeometry tool;
  tool.name = "tool";
  if (!tags.empty()) {
    tool.marker = tags.front();
  }
  for (std::size_t i = 1; i < tags.size(); ++i) {
    tool.more_markers.push_back({tags[i], {}});
  }
  if (!tags.empty()) {
    for (std::string& problem : problems_of({tool})) {
      problems.push_back(std::move(problem));
    }
  }
  if (problems.empty()) {
    return {};
  }
  return body_refused(joined(problems));
}

/// 0 if both cameras never saw the tag together.
double median_size_ratio(std::span<const PairSightings> pairs, std::size_t tag) {
  std::vector<double> ratios;
  for (const PairSightings& pair : pairs) {
    for (const TagSighting& seen : pair) {
      if (seen.tag == tag && seen.pose) {
        ratios.push_back(seen.pose->size_ratio);
      }
    }
  }
  return ratios.empty() ? 0.0 : median(std::move(ratios));
}

std::size_t pairs_with(std::span<const PairSightings> pairs, std::size_t tag) {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](const PairSightings& pair) {
        return std::any_of(pair.begin(), pair.end(),
                           [&](const TagSighting& s) { return s.tag == tag; });
      }));
}

/// Refuses tags that are not connected with the first one by a chain of tags seen together.
Status check_connected(std::span<const MarkerDefinition> tags, std::span<const PairSightings> pairs,
                       const TagLayout& layout, std::size_t min_pairs) {
  std::string names;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (layout.reached[i]) {
      continue;
    }
    names += (names.empty() ? "" : ", ") + name_of(tags[i]) + " (seen in " +
             how_many(pairs_with(pairs, i), "pair") + ")";
  }
  if (names.empty()) {
    return {};
  }
  return body_refused(names + ": not seen in " + std::to_string(min_pairs) +
                      " pairs together with tags that connect it with " + name_of(tags.front()));
}

Status check_sizes(std::span<const MarkerDefinition> tags, std::span<const PairSightings> pairs,
                   double limit) {
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const double ratio = median_size_ratio(pairs, i);
    if (ratio > 0.0 && !(std::abs(ratio - 1.0) <= limit)) {
      return body_refused(name_of(tags[i]) +
                          with_numbers(": its edges measure %.2f mm, given are %.2f mm",
                                       ratio * tags[i].size_m * 1e3, tags[i].size_m * 1e3));
    }
  }
  return {};
}

BodyProblem problem_of(const StereoCalibration& calibration,
                       std::span<const MarkerDefinition> tags) {
  BodyProblem problem;
  problem.calibration = calibration;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    problem.size_m.push_back(tags[i].size_m);
    problem.find_tag.push_back(i > 0);
  }
  return problem;
}

struct TagSigma {
  double m = 0.0;
  double rad = 0.0;
};

/// The SDs of each tag, from leaving out each tenth of the pairs in turn.
std::vector<TagSigma> tag_sigmas(const BodyProblem& problem, const BodyState& whole) {
  const std::size_t tags = problem.size_m.size();
  std::vector<TagSigma> sigma(tags);
  if (problem.pairs.size() < 2 * kJackknifeBlocks) {
    return sigma;
  }
  std::vector<std::vector<Vec3>> translations(tags);
  std::vector<std::vector<Vec3>> rotations(tags);
  for (const BodyState& state : adjusted_without_blocks(problem, whole)) {
    for (std::size_t i = 0; i < tags; ++i) {
      const auto& a = whole.marker_from_tag[i];
      const auto& b = state.marker_from_tag[i];
      translations[i].push_back(b.translation() - a.translation());
      rotations[i].push_back(vector_from_rotation(b.rotation() * a.rotation().transposed()));
    }
  }
  const auto sd = [](const std::vector<Vec3>& values) {
    const auto count = static_cast<double>(values.size());
    Vec3 mean;
    for (const Vec3& v : values) {
      mean += v / count;
    }
    double squared = 0.0;
    for (const Vec3& v : values) {
      squared += (v - mean).squared_norm();
    }
    return values.size() < 2 ? 0.0 : std::sqrt((count - 1.0) / count * squared);
  };
  for (std::size_t i = 0; i < tags; ++i) {
    sigma[i] = {sd(translations[i]), sd(rotations[i])};
  }
  return sigma;
}

TagBody body_of(std::span<const MarkerDefinition> tags, std::span<const PairSightings> pairs,
                const BodyProblem& problem, const BodyState& state, const BodyFit& fit) {
  TagBody body;
  body.pairs = problem.pairs.size();
  body.rms_px = fit.rms_px;
  body.outlier_fraction = static_cast<double>(fit.outliers) / static_cast<double>(fit.corners);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    BodyTag tag{tags[i], state.marker_from_tag[i],   pairs_with(problem.pairs, i), 0,
                0,       median_size_ratio(pairs, i)};
    if (i > 0) {
      const PoseCovariance& c = fit.covariances[i - 1];
      tag.sigma_m = translation_sigma_m(c);
      tag.sigma_rad = rotation_sigma_rad(c);
    }
    body.tags.push_back(tag);
  }
  return body;
}

Status check_rigid(const TagBody& body) {
  if (!(body.rms_px <= kBodyMaxRms_px)) {
    return body_refused(
        with_numbers("residual %.2f px RMS, limit %.2f px (do the tags move against "
                     "each other?)",
                     body.rms_px, kBodyMaxRms_px));
  }
  if (!(body.outlier_fraction <= kBodyMaxOutlierFraction)) {
    return body_refused(
        with_numbers("%.0f %% of the corners do not fit, limit %.0f %% (do the tags "
                     "move against each other?)",
                     100 * body.outlier_fraction, 100 * kBodyMaxOutlierFraction));
  }
  return {};
}

Status check_sigma(const TagBody& body) {
  for (const BodyTag& tag : body.tags) {
    if (!(tag.sigma_m <= kBodyMaxSigma_m)) {
      return body_refused(name_of(tag.definition) +
                          with_numbers(": its place is known to %.2f mm, limit %.2f mm",
                                       tag.sigma_m * 1e3, kBodyMaxSigma_m * 1e3));
    }
  }
  return {};
}

Judgement judged(const TagBody& body) {
  Judgement judgement;
  if (body.outlier_fraction > kBodyNoteOutlierFraction) {
    judgement.add(Verdict::kNote,
                  with_numbers("%.0f %% of the corners do not fit, better %.0f %%",
                               100 * body.outlier_fraction, 100 * kBodyNoteOutlierFraction));
  }
  for (const BodyTag& tag : body.tags) {
    const std::string name = name_of(tag.definition);
    if (tag.sigma_m > kBodyNoteSigma_m) {
      judgement.add(Verdict::kNote,
                    name + with_numbers(": its place is known to %.2f mm only, better %.2f mm",
                                        tag.sigma_m * 1e3, kBodyNoteSigma_m * 1e3));
    }
    if (tag.sigma_rad > kBodyNoteSigma_rad) {
      judgement.add(Verdict::kNote,
                    name + with_numbers(": its turn is known to %.2f° only, better %.2f°",
                                        tag.sigma_rad * kDegreesPerRadian,
                                        kBodyNoteSigma_rad * kDegreesPerRadian));
    }
    if (std::abs(tag.size_ratio - 1.0) > kBodyNoteSizeDeviation) {
      judgement.add(Verdict::kNote,
                    name + with_numbers(": its edges measure %.2f mm, given are %.2f mm",
                                        tag.size_ratio * tag.definition.size_m * 1e3,
                                        tag.definition.size_m * 1e3));
    }
    if (tag.pairs < kBodyNotePairs) {
      judgement.add(Verdict::kNote, name + with_numbers(": seen in %.0f pairs only, better %.0f",
                                                        static_cast<double>(tag.pairs),
                                                        static_cast<double>(kBodyNotePairs)));
    }
  }
  judgement.conclude();
  return judgement;
}

}  // namespace

Result<TagBody> calibrate_tag_body(const StereoCalibration& calibration,
                                   std::span<const MarkerDefinition> tags,
                                   std::span<const PairSightings> pairs,
                                   const TagBodyOptions& options) {
  if (Status status = check_input(tags); !status) {
    return status.error();
  }
  if (Status status = check_sizes(tags, pairs, options.max_size_deviation); !status) {
    return status.error();
  }
  const TagLayout layout = first_layout(pairs, tags.size(), kBodyMinPairsTogether);
  if (Status status = check_connected(tags, pairs, layout, kBodyMinPairsTogether); !status) {
    return status.error();
  }
  BodyProblem problem = problem_of(calibration, tags);
  BodyState state{calibration.right_from_rig, layout.marker_from_tag, {}};
  take_pairs(pairs, kBodyMaxPairs, problem, state);
  const auto fit = adjust(problem, state);
  if (!fit) {
    return body_refused(fit.error().message);
  }
  TagBody body = body_of(tags, pairs, problem, state, *fit);
  if (Status status = check_rigid(body); !status) {
    return status.error();
  }
  const std::vector<TagSigma> left_out = tag_sigmas(problem, state);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    body.tags[i].sigma_m = std::max(body.tags[i].sigma_m, left_out[i].m);
    body.tags[i].sigma_rad = std::max(body.tags[i].sigma_rad, left_out[i].rad);
  }
  if (Status status = check_sigma(body); !status) {
    return status.error();
  }
  body.judgement = judged(body);
  return body;
}

}  // namespace orthonav::nav
