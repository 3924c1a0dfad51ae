#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "hal/api/display.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

// A displayed frame on the stand-in's side channel (hal/hl2ss/standin_message.h).

void append_frame(std::vector<std::uint8_t>& bytes, const ShownFrame& frame);
/// An Error for invalid values; the reader reports missing bytes.
Status take_frame(ByteReader& reader, ShownFrame& frame);

}  // namespace orthonav::hl2ss
