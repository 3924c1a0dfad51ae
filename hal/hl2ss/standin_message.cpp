#include "hal/hl2ss/standin_message.h"

#include <array>
#include <string>

#include "hal/hl2ss/standin_values.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::uint32_t kMagic = 0x344e534f;  // "OSN4"
constexpr std::size_t kHeadBytes = 5;

void write(std::vector<std::uint8_t>& bytes, const StandinHello& hello) {
  append(bytes, kMagic);
  append(bytes, static_cast<std::uint8_t>(hello.paced));
  append(bytes, std::int64_t{hello.display_latency.count()});
  append_time(bytes, hello.clock);
  append(bytes, static_cast<std::uint8_t>(hello.may_repeat.pictures));
  append(bytes, static_cast<std::uint8_t>(hello.may_repeat.head_pose));
}
void write(std::vector<std::uint8_t>& bytes, const StandinClicks& clicks) {
  append(bytes, static_cast<std::uint32_t>(clicks.events.size()));
  for (const ClickerEvent& event : clicks.events) {
    append(bytes, static_cast<std::uint8_t>(event.action));
    append_time(bytes, event.time);
  }
}
void write(std::vector<std::uint8_t>& bytes, const StandinUpTo& up_to) {
  append_time(bytes, up_to.pair_time);
  append_time(bytes, up_to.clock);
}
void write(std::vector<std::uint8_t>& /*bytes*/, const StandinEnd& /*end*/) {}
void write(std::vector<std::uint8_t>& bytes, const StandinShown& shown) {
  append_time(bytes, shown.frame.display_time);
  for (const double number : shown.frame.wearer_from_drawn.row_major()) {
    append(bytes, number);
  }
  bytes.insert(bytes.end(), shown.frame.content.begin(), shown.frame.content.end());
}
void write(std::vector<std::uint8_t>& bytes, const StandinTook& took) {
  append_time(bytes, took.pair_time);
}

Status read(ByteReader& reader, StandinHello& hello) {
  if (reader.take<std::uint32_t>() != kMagic) {
    return Error{"stand-in: no greeting of a stand-in (another server?)"};
  }
  hello.paced = reader.take<std::uint8_t>() != 0;
  hello.display_latency = Duration(reader.take<std::int64_t>());
  hello.clock = take_time(reader);
  hello.may_repeat.pictures = reader.take<std::uint8_t>() != 0;
  hello.may_repeat.head_pose = reader.take<std::uint8_t>() != 0;
  if (hello.display_latency < Duration::zero() || hello.display_latency > std::chrono::seconds(1)) {
    return Error{"stand-in: display latency must lie within 0 to 1 s"};
  }
  return {};
}

Status read(ByteReader& reader, StandinClicks& clicks) {
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    const auto action = reader.take<std::uint8_t>();
    if (action > static_cast<std::uint8_t>(ClickerAction::kHold)) {
      return Error{"stand-in: unknown action of the clicker, " + std::to_string(action)};
    }
    clicks.events.push_back({static_cast<ClickerAction>(action), take_time(reader)});
  }
  return {};
}

Status read(ByteReader& reader, StandinUpTo& up_to) {
  up_to.pair_time = take_time(reader);
  up_to.clock = take_time(reader);
  return {};
}

Status read(ByteReader& /*reader*/, StandinEnd& /*end*/) { return {}; }

Status read(ByteReader& reader, StandinShown& shown) {
  shown.frame.display_time = take_time(reader);
  std::array<double, 16> numbers;
  for (double& number : numbers) {
    number = reader.take<double>();
  }
  if (!reader.ok()) {
    return {};
  }
  const auto wearer_from_drawn = Transform<World, World>::from_row_major(numbers);
  if (!wearer_from_drawn) {
    return Error{"stand-in: shown frame: " + wearer_from_drawn.error().message};
  }
  shown.frame.wearer_from_drawn = *wearer_from_drawn;
  const Bytes content = reader.take_bytes(reader.left());
  shown.frame.content.assign(content.begin(), content.end());
  return {};
}

Status read(ByteReader& reader, StandinTook& took) {
  took.pair_time = take_time(reader);
  return {};
}

/// Sets `message` to one of that kind.
template <std::size_t kind = 0>
Status become(StandinMessage& message, std::uint8_t wanted) {
  if constexpr (kind == std::variant_size_v<StandinMessage>) {
    return Error{"stand-in: unknown message " + std::to_string(wanted)};
  } else {
    if (wanted != kind) {
      return become<kind + 1>(message, wanted);
    }
    message.emplace<kind>();
    return {};
  }
}

}  // namespace

void append(std::vector<std::uint8_t>& bytes, const StandinMessage& message) {
  const std::size_t head = bytes.size();
  append(bytes, std::uint32_t{0});
  append(bytes, static_cast<std::uint8_t>(message.index()));
  std::visit([&bytes](const auto& each) { write(bytes, each); }, message);
  const auto size = static_cast<std::uint32_t>(bytes.size() - head - kHeadBytes);
  std::memcpy(bytes.data() + head, &size, sizeof(size));
}

Result<std::optional<ReadStandinMessage>> read_standin_message(Bytes bytes) {
  using Answer = std::optional<ReadStandinMessage>;
  if (bytes.size() < kHeadBytes) {
    return Answer{};
  }
  const auto size = number_at<std::uint32_t>(bytes, 0);
  if (size > kMaxStandinBytes) {
    return Error{"stand-in: message of " + std::to_string(size) + " bytes, limit " +
                 std::to_string(kMaxStandinBytes)};
  }
  if (bytes.size() < kHeadBytes + size) {
    return Answer{};
  }
  ByteReader reader(bytes.subspan(kHeadBytes, size));
  ReadStandinMessage answer;
  answer.bytes = kHeadBytes + size;
  if (const Status known = become(answer.message, bytes[4]); !known) {
    return known.error();
  }
  const Status taken =
      std::visit([&reader](auto& each) { return read(reader, each); }, answer.message);
  if (!taken) {
    return taken.error();
  }
  if (!reader.ok() || reader.left() > 0) {
    return Error{"stand-in: message " + std::to_string(bytes[4]) + " of " + std::to_string(size) +
                 " bytes does not fit its contents"};
  }
  return Answer{std::move(answer)};
}

}  // namespace orthonav::hl2ss
