#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "hal/hl2ss/remote_object.h"

namespace orthonav::hl2ss {

/// The same moment on both clocks.
struct SceneMoment {
  HostTime host{};
  Timestamp headset{};
};

/// Limits that are kept whatever is asked for.
struct SceneBudget {
  std::size_t objects = 400;
  std::size_t commands_a_list = 160;  ///< the headset works a list off within one frame
  double bytes_a_second = 200e3;
  double burst_bytes = 32e3;
};

/// What to say to the headset's scene, and what its answers mean: works out the differences between
/// what is wanted and what the headset knows, one display list at a time. No sockets, no clock.
///
/// **The fuse.** Nothing that was sent can be withdrawn, so each list that shows what follows a
/// tool carries its own end: behind it a few commands that do nothing, of which the headset works
/// off one a frame, then the beginning of the next list, which hides all of it. If that list's rest
/// is there by then, it is worked off in the same frame and nothing is seen of it; if not, the
/// headset shows the frame with everything hidden. See docs/hl2ss.md.
class SceneClient {
 public:
  explicit SceneClient(const SceneBudget& budget = {}) : budget_(budget) {}

  /// A new connection: whatever is there is removed first, then everything is made anew.
  void connected(HostTime now);
  void want(const ObjectList& list);
  /// The next list, if there is something to say and the headset is ready for it; else empty.
  [[nodiscard]] std::vector<std::uint8_t> next(const SceneMoment& now);
  /// The next answer. An Error when it can't be one: what follows can't be understood.
  Status answered(std::uint32_t answer, const SceneMoment& now);
  /// An Error once tool guidance was sent that would be shown too late if it arrived now, or
  /// answers have stopped while it is shown.
  [[nodiscard]] Status overdue(HostTime now) const;
  [[nodiscard]] static std::vector<std::uint8_t> goodbye();
  [[nodiscard]] ObjectDisplayStatistics statistics() const;
  /// The caller gave the connection up; counted.
  void given_up() { ++statistics_.given_up; }

 private:
  struct Expected {
    enum class Kind { kCreate, kObject, kPlain, kListEnd, kIdle } kind = Kind::kPlain;
    std::uint64_t key = 0;
  };
  struct Part {
    std::vector<std::uint8_t> bytes;
    std::vector<Expected> expected;
  };
  /// A list in the making. Its parts are sent in this order: wherever the list is cut off, what has
  /// arrived is harmless.
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
    /// Of all its parts and of the fuse behind it.
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::size_t commands() const;
  };

  [[nodiscard]] std::vector<std::uint8_t> start_over(HostTime now);
  [[nodiscard]] Draft draft_list(bool shows_tools, HostTime now);
  [[nodiscard]] int fuse_frames(const SceneMoment& now) const;
  void draft_presence(const DisplayObject& wanted, HostTime now, Draft& draft);
  static void draft_removal(const RemoteObject& remote, Draft& draft);
  void draft_create(const DisplayObject& wanted, RemoteObject& remote, HostTime now, Draft& draft);
  bool draft_changes(const DisplayObject& wanted, RemoteObject& remote, Draft& draft);
  void draft_removals(Draft& draft);
  void draft_show(const DisplayObject& wanted, RemoteObject& remote, bool shows_tools,
                  Draft& draft);
  /// Whether there is room for one more command; else there is more to come in the next list.
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
  bool is_fresh_ = false;      ///< `wanted_` was not looked at yet
  bool is_clear_ = false;      ///< *remove all* was sent on this connection
  bool list_is_open_ = false;  ///< the fuse began the next list
  bool has_more_ = false;      ///< the last list had no room for everything
  std::optional<std::int64_t> epoch_;
  std::map<std::uint64_t, RemoteObject> remotes_;
  std::deque<Expected> expected_;
  std::size_t awaited_ = 0;           ///< of `expected_`, before the next list may be sent
  std::size_t tool_answers_due_ = 0;  ///< of `expected_`, up to the end of the last fuse
  std::optional<Timestamp> sent_tool_time_;
  HostTime sent_at_{};
  HostTime heard_at_{};
  HostTime allowance_at_{};
  double allowance_bytes_ = 0;
  std::optional<HostTime> tool_due_;  ///< guidance that was sent is acknowledged by then, or late
  bool was_idle_ = true;              ///< nothing was unanswered when `next` was called
  /// The bytes sent last went out while nothing was unanswered, so their first answer measures the
  /// round trip.
  bool asks_alone_ = false;
  /// From sending to the first answer where nothing else waited; frames of the headset included.
  Duration round_trip_ = std::chrono::milliseconds(5);
  Duration frame_ = std::chrono::microseconds(16'667);  ///< of the headset, as its answers tell
  ObjectDisplayStatistics statistics_;
};

}  // namespace orthonav::hl2ss
