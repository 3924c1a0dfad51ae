#pragma once

#include "hal/desktop/command_evidence.h"

namespace orthonav::desktop {

// Made by bench/voice_weights.cpp, in the order of features_of().
inline constexpr FeatureVector kWeightsAfterWakeWord = {
    1.546, -0.490, -0.667, 0.853, -1.088, 1.446, 0.108,  -1.308, -0.399, -0.402, 1.634,
    1.455, 1.176,  1.418,  2.110, -0.723, 0.052, -0.042, -3.575, 3.517,  -2.586, -1.739};
inline constexpr FeatureVector kWeightsAlone = {
    2.151, 0.470, -0.971, 0.293, -1.321, 0.588, 0.509, -1.664, -0.055, -3.763, 2.585,
    0.000, 0.000, 1.104,  1.496, -0.392, 0.000, 1.983, -6.989, 0.000,  0.000,  0.000};

}  // namespace orthonav::desktop
