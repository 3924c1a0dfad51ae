// Runs the contract tests of all devices on one from outside. The suite is in the package and calls
// this function.
#include <orthonav/tests/contract/device_cases.h>

#include "skeleton_device.h"

std::vector<orthonav::test::DeviceCase> orthonav::test::device_cases() {
  // It has no clicks and no speech, and its pairs are black.
  return {{"skeleton", [] { return mine::open_skeleton("30", {}).value().headset; }, false, false}};
}
