// What every device promises, asked of one from outside. The suite is in the package: it calls
// this.
#include <orthonav/tests/contract/device_cases.h>

#include "skeleton_device.h"

std::vector<orthonav::test::DeviceCase> orthonav::test::device_cases() {
  // Nobody clicks or speaks, and its pairs are black.
  return {{"skeleton", [] { return mine::open_skeleton("30").value(); }, false, false}};
}
