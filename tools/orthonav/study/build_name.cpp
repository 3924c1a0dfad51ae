#include "tools/orthonav/study/build_name.h"

namespace orthonav::tools {

std::string build_name() { return ORTHONAV_BUILD; }

}  // namespace orthonav::tools
