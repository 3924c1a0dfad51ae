#include <algorithm>
#include <cstdint>
#include <span>

#include "hal/igtl/incoming.h"
#include "hal/igtl/pose_frames.h"
#include "hal/igtl/pose_message.h"
#include "hal/igtl/text_message.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {
namespace {

/// Reads what may be read.
class Reader : public igtl::MessageReader {
 public:
  std::size_t poses = 0;
  std::size_t refused = 0;

 private:
  [[nodiscard]] bool wants(const igtl::Header& header) const override {
    return igtl::holds_poses(header.type) || header.type == "STRING";
  }
  Status read(const igtl::Header& header, igtl::Bytes body) override {
    if (header.type == "STRING") {
      const auto text = igtl::text_in(header, body);
      insist(!text || text->size() <= body.size());
      refused += text ? 0 : 1;
      return {};
    }
    const auto found = igtl::poses_in(header, body);
    refused += found ? 0 : 1;
    for (std::size_t i = 0; found && i < found->size(); ++i) {
      now_ += std::chrono::milliseconds(1);
      frames_.take((*found)[i], now_, now_);
      if (const auto frame = frames_.next(now_)) {
        insist(frame->tools.size() == 2);
        insist(!last_ || frame->time > *last_);
        last_ = frame->time;
      }
      ++poses;
    }
    return {};
  }
  igtl::PoseFrames frames_{{{{"pointer", "ProbeToTracker"}, {"reference", "ReferenceToTracker"}},
                            {},
                            std::chrono::seconds(1)}};
  Timestamp now_{};
  std::optional<Timestamp> last_;
};

}  // namespace

/// Bytes that a stranger sends to the OpenIGTLink port, or a tracker to us. However the network
/// splits them, the result is the same.
void fuzz_igtl(std::span<const std::uint8_t> input) {
  Reader all;
  igtl::Incoming whole(&all);
  const Status at_once = whole.take(input);
  Reader some;
  igtl::Incoming parts(&some);
  Status piecemeal;
  const std::size_t step = input.empty() ? 1 : 1 + input[0] % 97;
  for (std::size_t at = 0; at < input.size() && piecemeal; at += step) {
    piecemeal = parts.take(input.subspan(at, std::min(step, input.size() - at)));
  }
  insist(at_once.ok() == piecemeal.ok());
  insist(whole.messages() == parts.messages());
  insist(all.poses == some.poses && all.refused == some.refused);
}

}  // namespace orthonav::fuzz
