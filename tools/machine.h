#pragma once

#include <string>
#include <vector>

namespace orthonav::tools {

enum class Finding {
  kFound,
  kMissing,   ///< needed by the demo
  kOptional,  ///< not there, and only something else needs it
};

/// One thing that a machine may offer.
struct Offer {
  std::string name;  ///< "Vulkan device"
  Finding finding = Finding::kMissing;
  std::string what;  ///< "llvmpipe (LLVM 15.0.6, 256 bits), CPU", or why it is missing
  std::string how;   ///< how to get it; empty when it is there
};

/// Looks at the machine, under `root` ("/"; another folder in tests) where it looks at files.
/// Starts nothing and changes nothing but a scratch file for the video encoder.
[[nodiscard]] std::vector<Offer> offers_of_machine(const std::string& root = "/");

}  // namespace orthonav::tools
