#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/random.h"
#include "hal/api/forwarding_headset.h"
#include "hal/api/wearer.h"

namespace orthonav::soak {

/// The possible faults of a pair.
enum class Trouble { kDrop, kStall, kReconnect, kNoPose, kVoiceStall, kMapJump, kDeviceLoss };
inline constexpr std::array<std::string_view, 7> kTroubles = {
    "drops", "stalls", "reconnects", "unlocated", "voice_stalls", "map_jumps", "device_losses"};
using Troubles = std::array<std::int64_t, kTroubles.size()>;

inline std::int64_t device_losses(const Troubles& troubles) {
  return troubles[static_cast<std::size_t>(Trouble::kDeviceLoss)];
}

/// Probabilities of the faults at every pair.
struct Chances {
  double any = 1.0 / 500.0;  ///< of a drop, a stall, a lost connection, a lost head, a mute voice
  double map_jump = 0.0;
  double device_loss = 0.0;
};

/// The state that a headset's parts share: the current faults, and the map that jumped.
struct Weather {
  Random random;
  Chances chances;
  Troubles done{};
  int silent_pairs = 0;  ///< swallowed, as if none had arrived
  int failing_pairs = 0;
  int unlocated_pairs = 0;
  int mute_polls = 0;
  bool lost = false;
  std::int64_t map_epoch = 0;
  Transform<World, World> jumped_from_world{};
};

/// A simulated headset with injected faults. As with a real device, the room goes on while pairs
/// are lost. Borrows the headset, which has a wearer.
class FlakyHeadset : public ForwardingHeadset {
 public:
  FlakyHeadset(Headset& inner, Random random, const Chances& chances);
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Wearer* wearer() override { return &glasses_; }
  [[nodiscard]] const Troubles& done() const { return weather_.done; }
  /// Frames whose tool guidance was older than it may be when it lit up.
  [[nodiscard]] std::int64_t stale_frames() const { return glasses_.stale; }
  [[nodiscard]] std::int64_t frames() const { return glasses_.frames; }

 private:
  class Cameras : public ForwardingCamera {
   public:
    Cameras(StereoCamera& inner, Weather& weather) : ForwardingCamera(inner), weather_(weather) {}

   private:
    /// There is nothing to see before `next`, which makes the trouble.
    bool do_tap(PairTap* /*tap*/) override { return false; }
    Result<Next> do_next(StereoFrame& frame) override;
    void begin_trouble();
    Weather& weather_;
  };
  class Speech : public Voice {
   public:
    Speech(Voice& inner, Weather& weather) : inner_(inner), weather_(weather) {}

   private:
    Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override;
    Voice& inner_;
    Weather& weather_;
  };
  class Glasses : public Wearer {
   public:
    Glasses(Wearer& inner, Weather& weather) : inner_(inner), weather_(weather) {}
    void see(const WornFrame& frame) override;
    std::int64_t stale = 0;
    std::int64_t frames = 0;

   private:
    Wearer& inner_;
    Weather& weather_;
  };

  Weather weather_;
  Cameras cameras_;
  Speech voice_;
  Glasses glasses_;
};

}  // namespace orthonav::soak
