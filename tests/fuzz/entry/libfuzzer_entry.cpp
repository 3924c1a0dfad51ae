#include <cstddef>
#include <cstdint>
#include <span>

namespace orthonav::fuzz {
void ORTHONAV_FUZZ_FUNCTION(std::span<const std::uint8_t> input);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orthonav::fuzz::ORTHONAV_FUZZ_FUNCTION({data, size});
  return 0;
}
