#pragma once

#include <string>
#include <vector>

namespace orthonav::tools {

enum class Finding {
  kFound,
  kMissing,   ///< needed by the demo
  kOptional,  ///< absent, but not needed by the demo
};

/// Something that a machine may provide.
struct Offer {
  std::string name;  ///< "Vulkan device"
  Finding finding = Finding::kMissing;
  std::string what;  ///< "llvmpipe (LLVM 15.0.6, 256 bits), CPU", or why it is missing
  std::string how;   ///< how to get it; empty when it is present
};

/// Looks at the machine, under `root` ("/"; another folder in tests) where it looks at files.
/// Starts nothing and changes nothing but a scratch file for the video encoder.
[[nodiscard]] std::vector<Offer> offers_of_machine(const std::string& root = "/");

}  // namespace orthonav::tools
