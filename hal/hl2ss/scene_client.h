#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "hal/hl2ss/scene_command.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// The same moment on both clocks.
struct SceneMoment {
  HostTime host{};
  Timestamp headset{};
};

/// Limits that always apply.
struct SceneBudget {
  std::size_t objects = 400;
  std::size_t commands_a_list = 160;  ///< the headset processes a list within one frame
  double bytes_a_second = 200e3;
  double burst_bytes = 32e3;
};

/// The protocol logic for the headset's scene: computes the differences between the wanted objects
/// and the headset's state, one display list at a time, and interprets the answers. No sockets, no
/// clock.
///
/// **The fuse.** Nothing that was sent can be withdrawn, so each list with objects that follow a
/// tool carries its own end: after it come a few commands without effect, of which the headset
/// processes one per frame, then the beginning of the next list, which hides those objects. If the
/// rest of that list has arrived by then, it is processed in the same frame and the hiding is not
/// visible; if not, the headset shows a frame with the objects hidden. See docs/hl2ss.md.
class SceneClient {
 public:
  explicit SceneClient(const SceneBudget& budget = {}) : budget_(budget) {}

  /// A new connection: existing objects are removed first, then everything is created again.
  void connected(HostTime now);
  void want(const ObjectList& list);
  /// The next list, if there is something to send and the headset is ready for it; otherwise empty.
  [[nodiscard]] std::vector<std::uint8_t> next(const SceneMoment& now);
  /// Takes the next answer. An Error if it is invalid: the rest can't be understood.
  Status answered(std::uint32_t answer, const SceneMoment& now);
  /// An Error if tool guidance was sent that would be shown too late if it arrived now, or if
  /// answers have stopped while it is shown.
  [[nodiscard]] Status overdue(HostTime now) const;
  [[nodiscard]] static std::vector<std::uint8_t> goodbye();
  [[nodiscard]] ObjectDisplayStatistics statistics() const;
  /// Counts that the caller closed the connection.
  void given_up() { ++statistics_.given_up; }

 private:
  /// The headset's state of one object after it has processed everything sent so far.
  struct Remote {
    std::uint32_t id = 0;  ///< 0: not created, or not answered yet
    bool creating = false;
    bool active = false;
    bool placed = false;  ///< `told` holds its place
    bool looks = false;   ///< `told` holds its colour and text
    DisplayObject told;
    int refusals = 0;             ///< in a row
    HostTime ask_again{};         ///< after a refusal, it is not created again before this
    std::uint64_t wanted_in = 0;  ///< number of the last list that wanted it

    /// The object was refused or removed: nothing of it is left.
    void forget() {
      id = 0;
      creating = active = placed = looks = false;
    }
  };
  struct Expected {
    enum class Kind { kCreate, kObject, kPlain, kListEnd, kIdle } kind = Kind::kPlain;
    std::uint64_t key = 0;
  };
  struct Part {
    std::vector<std::uint8_t> bytes;
    std::vector<Expected> expected;
  };
  /// A list under construction. Its parts are sent in this order, such that a list cut off anywhere
  /// is harmless.
  struct Draft {
    Part removals;
    Part changes;  ///< moves, colours, texts
    Part creates;
    Part shows;
    Part tool_shows;
    std::vector<std::uint32_t> tool_ids;
    [[nodiscard]] std::array<const Part*, 5> parts() const {
      return {&removals, &changes, &creates, &shows, &tool_shows};
    }
    /// Total size of all parts and of the fuse after them.
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::size_t commands() const;
  };

  [[nodiscard]] std::vector<std::uint8_t> start_over(HostTime now);
  [[nodiscard]] Draft draft_list(bool shows_tools, HostTime now);
  [[nodiscard]] int fuse_frames(const SceneMoment& now) const;
  void draft_presence(const DisplayObject& wanted, HostTime now, Draft& draft);
  static void draft_removal(const Remote& remote, Draft& draft);
  void draft_create(const DisplayObject& wanted, Remote& remote, HostTime now, Draft& draft);
  bool draft_changes(const DisplayObject& wanted, Remote& remote, Draft& draft);
  void draft_removals(Draft& draft);
  void draft_show(const DisplayObject& wanted, Remote& remote, bool shows_tools, Draft& draft);
  /// Whether there is room for one more command; otherwise the rest goes into the next list.
  bool has_room(const Draft& draft);
  [[nodiscard]] std::vector<std::uint8_t> assemble(const Draft& draft, int fuse, HostTime now);
  void append_fuse(const Draft& draft, int fuse, std::vector<std::uint8_t>& bytes);
  [[nodiscard]] std::vector<std::uint8_t> sent(std::vector<std::uint8_t> bytes, HostTime now);
  void refuse(std::uint64_t key, HostTime now);
  [[nodiscard]] Status take_id(std::uint64_t key, std::uint32_t answer, HostTime now);
  void list_shown(const SceneMoment& now);
  void note_round_trip(HostTime now);
  [[nodiscard]] Status take_done(const Expected& expected, std::uint32_t answer, HostTime now);
  void refill(HostTime now);
  [[nodiscard]] std::vector<std::uint8_t> keep_alive(HostTime now);

  SceneBudget budget_;
  ObjectList wanted_;
  std::uint64_t list_number_ = 0;
  bool is_fresh_ = false;      ///< `wanted_` was not processed yet
  bool is_clear_ = false;      ///< *remove all* was sent on this connection
  bool list_is_open_ = false;  ///< the fuse has begun the next list
  bool has_more_ = false;      ///< the last list had no room for everything
  std::optional<std::int64_t> epoch_;
  std::map<std::uint64_t, Remote> remotes_;
  std::deque<Expected> expected_;
  std::size_t awaited_ = 0;           ///< of `expected_`, before the next list may be sent
  std::size_t tool_answers_due_ = 0;  ///< of `expected_`, up to the end of the last fuse
  std::optional<Timestamp> sent_tool_time_;
  HostTime sent_at_{};
  HostTime heard_at_{};
  HostTime allowance_at_{};
  double allowance_bytes_ = 0;
  std::optional<HostTime> tool_due_;  ///< guidance sent must be acknowledged by then
  bool was_idle_ = true;              ///< nothing was unanswered when `next` was called
  /// The last bytes were sent while no answer was pending, so their first answer measures the round
  /// trip.
  bool asks_alone_ = false;
  /// From sending to the first answer when nothing else was pending; includes the headset's frame
  /// time.
  Duration round_trip_ = std::chrono::milliseconds(5);
  Duration frame_ = std::chrono::microseconds(16'667);  ///< of the headset, estimated from its
                                                        ///< answers
  ObjectDisplayStatistics statistics_;
};

}  // namespace orthonav::hl2ss
