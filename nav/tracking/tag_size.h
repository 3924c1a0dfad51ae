#pragma once

#include <cstdint>
#include <optional>

namespace orthonav::nav {

/// The share by which a tool's tag was measured to be larger than stated.
struct SizeEvidence {
  double fraction = 0.0;
  double sd = 0.0;
};

struct TagSizeOptions {
  /// What every measurement may be off by: the lens, the light.
  double least_sd = 0.005;
  /// So many measurements one after the other at first, then one in so many pairs.
  std::int64_t first = 12;
  std::int64_t then_every = 30;
  /// SDs that make a difference certain.
  double certain_sd = 5.0;
  /// Less than this may be the cameras: 0.6 px across, as a real unit was off by, look like 0.8 %
  /// at arm's length. A page "fitted to paper" is 3 % and more.
  double min_fraction = 0.015;
};

/// A tool's tags as the two cameras measure them.
struct TagSize {
  double fraction = 0.0;  ///< by which they are larger than stated
  double sd = 0.0;
  std::int64_t measurements = 0;
  bool notable = false;  ///< more than small errors of the cameras look like
  /// Certainly another size than stated: a wrong print or a wrong unit (or cameras that look past
  /// each other). Poses are then wrong.
  bool disagrees = false;
};

/// Adds up measurements of one tool.
class TagSizeEstimator {
 public:
  TagSizeEstimator() = default;
  explicit TagSizeEstimator(const TagSizeOptions& options) : options_(options) {}

  /// Counts a pair in which it could be measured; true when it should be.
  bool is_due();
  void add(const SizeEvidence& measured);
  /// Nothing before the first measurement.
  [[nodiscard]] std::optional<TagSize> estimate() const;
  void restart() { *this = TagSizeEstimator(options_); }

 private:
  TagSizeOptions options_;
  double information_ = 0.0;
  double sum_ = 0.0;  ///< of shares by their information
  std::int64_t measurements_ = 0;
  std::int64_t pairs_ = 0;
};

}  // namespace orthonav::nav
