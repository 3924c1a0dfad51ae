#pragma once

#include "nav/evaluation/tip_accuracy.h"
#include "tests/support/accuracy_track.h"

namespace orthonav::nav::tip_accuracy_test {

/// The report on such a track of the pointer over the whole board.
inline Result<AccuracyReport> tested(const test::AccuracyTrackOptions& track,
                                     const AccuracyOptions& options = {}) {
  return test_tip_accuracy(test::accuracy_track(track, test::accuracy_board()),
                           test::accuracy_pointer(), test::accuracy_board(), options);
}

}  // namespace orthonav::nav::tip_accuracy_test
