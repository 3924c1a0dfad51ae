#pragma once

#include <cstdint>
#include <optional>

namespace orthonav::nav {

/// The fraction by which a tool's tag was measured to be larger than stated.
struct SizeEvidence {
  double fraction = 0.0;
  double sd = 0.0;
};

struct TagSizeOptions {
  /// The error that every measurement may share: from the lens, from the light.
  double least_sd = 0.005;
  /// This many consecutive measurements first, then one in a number of pairs.
  std::int64_t first = 12;
  std::int64_t then_every = 30;
  /// SDs that make a difference certain.
  double certain_sd = 5.0;
  /// A smaller difference may come from the cameras: 0.6 px across the epipolar lines, as in one
  /// real unit, looks like 0.8 % at arm's length. A page "fitted to paper" differs by 3 % or more.
  double min_fraction = 0.015;
};

/// The size of a tool's tags as the two cameras measure it.
struct TagSize {
  double fraction = 0.0;  ///< by which they are larger than stated
  double sd = 0.0;
  std::int64_t measurements = 0;
  bool notable = false;  ///< more than small errors of the cameras could cause
  /// Certainly a different size than stated: a wrong print or a wrong unit (or misaligned cameras).
  /// Poses are then wrong.
  bool disagrees = false;
  double applied = 0.0;  ///< the part of `fraction` that poses take into account
};

/// Accumulates measurements of one tool.
class TagSizeEstimator {
 public:
  TagSizeEstimator() = default;
  explicit TagSizeEstimator(const TagSizeOptions& options) : options_(options) {}

  /// Counts a pair in which the size could be measured; true if it should be measured now.
  bool is_due();
  void add(const SizeEvidence& measured);
  /// Nothing before the first measurement.
  [[nodiscard]] std::optional<TagSize> estimate() const;
  void restart() { *this = TagSizeEstimator(options_); }

 private:
  TagSizeOptions options_;
  double information_ = 0.0;
  double sum_ = 0.0;  ///< of fractions, weighted by their information
  std::int64_t measurements_ = 0;
  std::int64_t pairs_ = 0;
};

}  // namespace orthonav::nav
