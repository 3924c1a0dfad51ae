#pragma once

#include "hal/voice/command_evidence.h"

namespace orthonav::voice {

// Made by tools/voice/voice_weights.cpp, the shared weights in the order of features_of().
inline constexpr CommandWeight kCommandWeights[] = {
    {"start", 0.948, 1.940},   {"save", -0.708, 0.005},      {"delete", 0.039, -1.245},
    {"accept", 0.137, -0.109}, {"reject", -0.684, -1.512},   {"next", 1.425, 0.237},
    {"done", 0.520, 2.081},    {"move rod", -1.188, -1.566}, {"twin", -0.489, 0.168},
};
inline constexpr EvidenceWeights kTrainedWeights = {
    kCommandWeights,
    {-2.530, 1.915, 2.427, 1.071, 1.440, 2.672, -1.027, -0.179, 1.222, -1.604, 3.040, -3.158,
     -1.134},
    {-5.749, 2.729, 0.000, 0.000, 0.825, 1.519, -0.621, 0.000, 2.593, -6.538, -0.000, 0.000, 0.000},
};

}  // namespace orthonav::voice
