#pragma once

#include "hal/voice/command_evidence.h"

namespace orthonav::voice {

// Made by tools/voice/voice_weights.cpp, in the order of features_of().
inline constexpr FeatureVector kWeightsAfterWakeWord = {
    0.948, -0.708, 0.039, 0.137, -0.684, 1.425,  0.520, -1.188, -0.489, -2.530, 1.915,
    2.427, 1.071,  1.440, 2.672, -1.027, -0.179, 1.222, -1.604, 3.040,  -3.158, -1.134};
inline constexpr FeatureVector kWeightsAlone = {
    1.940, 0.005, -1.245, -0.109, -1.512, 0.237, 2.081, -1.566, 0.168,  -5.749, 2.729,
    0.000, 0.000, 0.825,  1.519,  -0.621, 0.000, 2.593, -6.538, -0.000, 0.000,  0.000};

}  // namespace orthonav::voice
