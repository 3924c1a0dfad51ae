#pragma once

#include "hal/desktop/command_evidence.h"

namespace orthonav::desktop {

// Made by bench/voice_weights.cpp, in the order of features_of().
inline constexpr FeatureVector kWeightsAfterWakeWord = {
    1.613, -0.887, 0.057, 0.167, -0.871, 1.443,  0.585,  -1.310, -0.797, 0.904,  1.327,
    2.503, 0.788,  1.441, 1.912, -0.376, -0.348, -0.031, -2.945, 2.625,  -3.199, -2.250};
inline constexpr FeatureVector kWeightsAlone = {
    2.331, -0.227, -1.195, 0.687, -1.470, 0.222, 1.598, -1.669, -0.277, -2.364, 2.115,
    0.000, 0.000,  1.311,  1.153, -0.221, 0.000, 1.159, -7.118, -0.000, 0.000,  0.000};

}  // namespace orthonav::desktop
