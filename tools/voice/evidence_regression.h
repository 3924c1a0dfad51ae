#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hal/voice/command_evidence.h"

namespace orthonav::bench {

/// One weight for each command of the workflow, and after them one for each shared feature.
using Weights = std::vector<double>;

/// An example for the regression.
struct Row {
  std::vector<double> inputs;  ///< as many as there are weights
  bool command = false;
  double weight = 1.0;
};

[[nodiscard]] std::vector<double> inputs_of(const voice::CommandEvidence& evidence,
                                            const std::vector<std::string>& commands);

/// Logistic regression by Newton's method, with a normal prior of variance 2 on each weight but the
/// constant, whose index is `constant`.
[[nodiscard]] Weights fit(const std::vector<Row>& rows, std::size_t constant);

/// Lowers the constant until at most `allowed` of the other sayings pass, and prints which pass
/// then.
void draw_line(const std::vector<Row>& rows, std::size_t allowed, std::size_t constant,
               Weights& weights);

}  // namespace orthonav::bench
