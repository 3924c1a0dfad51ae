#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A vertebra and the middle of its surface or voxels in the scan, metres, LPS.
struct LevelPlace {
  std::string label;
  Vec3 middle_m;
};

/// How many vertebrae are above this one, of C1 to C7, T1 to T13, L1 to L6 and S1; nothing for any
/// other name.
[[nodiscard]] std::optional<std::size_t> place_in_spine(const std::string& label);

/// How far the middles of two vertebrae lie apart in an adult, from the upper to the lower one:
/// body and disc of each level between (17 mm in the neck, 18 to 27 mm in the chest, 35 mm below).
[[nodiscard]] double usual_distance_m(const std::string& upper, const std::string& lower);

/// Signs that vertebrae have the names of others: from the head down they lie out of order, or
/// too near together or too far apart (0.72 and 1.35 times the usual distance). The Error ends
/// with `hint`. With `unusual`, distances are no reason to refuse (four or six lumbar vertebrae, a
/// child): what is unusual about them is written there.
Status check_places(const std::vector<LevelPlace>& from_the_head, const std::string& hint,
                    std::string* unusual = nullptr);

/// Samples of vertebrae in a scan, which tell whether they lie on its bone.
class BoneSamples {
 public:
  /// Refuses a scan with several values a voxel. It must outlive the samples.
  static Result<BoneSamples> in(const Volume& scan);
  /// Takes a place inside a vertebra, metres, LPS.
  void add(Vec3 place_m);
  /// Refuses what does not lie on bone: more than a tenth outside of the scan, or less than 50 HU
  /// on average inside. `what` was sampled, as in "labels"; for the Error.
  [[nodiscard]] Status check(const std::string& what) const;

 private:
  explicit BoneSamples(const Volume& scan) : scan_(&scan) {}

  const Volume* scan_;
  std::size_t all_ = 0;
  std::size_t inside_ = 0;
  double sum_hu_ = 0.0;
};

}  // namespace orthonav::engine
