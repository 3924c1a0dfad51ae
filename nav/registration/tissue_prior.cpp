#include "nav/registration/tissue_prior.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kLightHand_m = 0.0015;
constexpr double kTissue_m = 0.0025;
constexpr double kVariation = 0.5;  ///< SD of tissue's thickness, of its mean
constexpr double kEven_m = 0.00007;

}  // namespace

double log_prior_of_evenness(const FieldHypothesis& field, double standoff_m) {
  const double is_tissue =
      std::clamp((standoff_m - kLightHand_m) / (kTissue_m - kLightHand_m), 0.0, 1.0);
  if (is_tissue == 0.0) {
    return 0.0;
  }
  const double sd_m = std::max(kEven_m, std::hypot(field.sd_m, field.stroke_sd_m));
  const double short_of = std::max(0.0, std::log(kVariation * standoff_m / sd_m));
  return -0.5 * is_tissue * short_of * short_of;
}

}  // namespace orthonav::nav
