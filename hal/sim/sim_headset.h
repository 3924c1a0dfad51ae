#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "hal/api/devices.h"
#include "hal/sim/cameras/depth_model.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/room.h"
#include "hal/sim/surgeon/guidance_profile.h"
#include "hal/sim/truth.h"

namespace orthonav::sim {

enum class Pace {
  kFast,     ///< the clock advances by one frame at each call of cameras()->next(); as fast as
             ///< possible
  kRealtime  ///< the clock follows wall time; next() returns kNone until the next frame is due
};

class Surgeon;     // hal/sim/surgeon/surgeon.h
struct Workplace;  // hal/sim/surgeon/surgeon.h
using BringSurgeon = std::function<std::unique_ptr<Surgeon>(const Workplace&)>;

/// The clamped patient reference is knocked after a number of wires.
struct ReferenceBump {
  double translation_m = 0.0;  ///< in a random direction
  double rotation_rad = 0.0;   ///< about a random axis through the reference's tag
  int after_wires = 1;
};

/// The patient slips on the table after a number of wires and stays there: bones, hands on them and
/// a clamped reference move along.
struct PatientShift {
  double shift_m = 0.0;  ///< in a random direction
  int after_wires = 1;
};

struct SimOptions {
  std::uint64_t seed = 1;
  ErrorModel error_model;
  /// The SDs that a session in the room is told of its errors, relative to those from which the
  /// room draws them.
  double told_sd_factor = 1.0;
  Pace pace = Pace::kFast;
  double frame_rate_hz = 30.0;
  GuidanceProfile guidance = GuidanceProfile::kNumbers;
  /// The system relies on the reference in the room: its tag is then on the surgeon's side of the
  /// wound, and the surgeon sees to it that no tool hides it. Otherwise it lies beyond the wound.
  bool relies_on_reference = false;
  ReferenceBump reference_bump;
  PatientShift patient_shift;
  /// Who operates (study/surgeon/scripted_surgeon.h); null: nobody, and the tools hover over the
  /// table in slow motion.
  BringSurgeon surgeon;
  double limit_s = 3600.0;  ///< the stream ends at the latest then (simulated time)
  /// False leaves the images black and costs nothing: for callers that need no pixels.
  bool render = true;
  /// The depth cameras that it has, each once: kAhat, kLongThrow. Empty: none.
  std::vector<DepthStream> depth = {};
  DepthErrors depth_errors;

  /// Refuses invalid values; names every problem of the error model.
  [[nodiscard]] Status check() const;
};

/// The simulated operating room as a headset. The same seed gives the same bits, provided frames
/// are shown at the same moments. Parts may be used from different threads; `truth` may be read
/// only while no thread calls `cameras()->next`. Tools are described as a planning file would
/// describe them: slightly off by the error model. The stream ends half a second after the surgeon
/// has seen the last step (`done`).
class SimHeadset : public Headset {
 public:
  /// Refuses invalid error models, options and rooms, and a surgeon without pointer or guide.
  /// Without levels there is nothing to operate: the tools hover, as without a surgeon.
  static Result<std::unique_ptr<SimHeadset>> open(RoomDescription room, const SimOptions& options);
  /// The truth so far. Only for the thread that takes the pairs, since it grows with them.
  [[nodiscard]] virtual const Truth& truth() const = 0;
  [[nodiscard]] virtual RoomState state() const = 0;
  /// World, as the headset assumes it, from Room, now.
  [[nodiscard]] virtual Transform<World, Room> world_from_room() const = 0;
  /// From where the head's reported pose puts what is seen in the pair at that time to where it is
  /// in World; the identity for a pair of more than some seconds ago.
  [[nodiscard]] virtual Transform<World, World> actual_from_reported(Timestamp pair) const = 0;
  [[nodiscard]] virtual const RoomDescription& room() const = 0;
  /// Its true cameras; `cameras()->calibration()` is what the device reports.
  [[nodiscard]] virtual const StereoCalibration& actual_calibration() const = 0;
  /// What it was opened with.
  [[nodiscard]] virtual const SimOptions& options() const = 0;
};

}  // namespace orthonav::sim
