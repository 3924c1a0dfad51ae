#pragma once

#include <string>

#include "base/result.h"
#include "hal/voice/adapted_mixtures.h"

namespace orthonav::bench {

/// A model's mixture weights in sphinxtrain's format: fractions instead of 8 bits of their
/// logarithms, senones first.
[[nodiscard]] std::string sphinx_mixture_weights(const voice::MixtureWeights& own);

/// The change from a model's own weights by this fraction of the way to sphinxtrain's results at
/// `path`: the weights, or their counts, in the same order. Refuses results of another model.
[[nodiscard]] Result<std::string> sphinx_mixture_change(const voice::MixtureWeights& own,
                                                        const std::string& path, double fraction);

}  // namespace orthonav::bench
