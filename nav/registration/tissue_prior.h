#pragma once

#include "nav/registration/residual_noise.h"

namespace orthonav::nav {

/// The logarithm of a factor on a hypothesis's prior probability, by how high above the bone the
/// tip lies on average. Higher than a light hand holds it (from 1.5 mm on, in full from 2.5 mm), it
/// lies on soft tissue, and tissue is never even: its thickness varies by half its mean, give or
/// take a factor of e (one SD). Less variation loses probability; bare bone counts as varying by
/// 0.07 mm.
[[nodiscard]] double log_prior_of_evenness(const FieldHypothesis& field, double standoff_m);

}  // namespace orthonav::nav
