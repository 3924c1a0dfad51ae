#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/hl2ss/scene_client.h"

// How SceneClient makes a display list from the differences.

namespace orthonav::hl2ss {
namespace {

constexpr int kMaxFuseFrames = 3;
/// In addition to the frames of the fuse: the frame that processes the list may have begun just
/// before, and the frame that hides takes time to reach the eyes.
constexpr int kFramesBesideFuse = 2;
/// A list may take this much longer than half a round trip.
constexpr Duration kNetwork = std::chrono::milliseconds(5);
/// Hidden guidance is kept for this many lists: it often comes back, and keeping it costs nothing.
constexpr std::uint64_t kKeptHiddenLists = 300;
/// Limits per list: new objects must not displace moving ones, nor vice versa.
constexpr std::size_t kMaxCreates = 40;
constexpr double kSmallestScale = 5e-5;
constexpr std::size_t kBytesToHide = 16;
/// The beginning and the end of the list, the fuse, and the beginning of the next list.
constexpr std::size_t kBytesAround = 16 + kMaxFuseFrames * 12;

/// Whether the difference is visible: 0.05 mm, or a turn that moves a point 5 cm away by as much.
bool is_moved(const DisplayObject& told, const DisplayObject& wanted) {
  constexpr double kSmallestMove_m = 5e-5;
  // Of a quaternion's components, half an angle: 1 mrad moves what is 5 cm away by 0.05 mm.
  constexpr double kSmallestRotation_rad = 5e-4;
  const Quaternion& a = told.rotation;
  const Quaternion& b = wanted.rotation;
  const double rotation_rad =
      std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) + std::abs(a.w - b.w);
  return told.place != wanted.place ||
         (told.position_m - wanted.position_m).norm() > kSmallestMove_m ||
         rotation_rad > kSmallestRotation_rad ||
         (told.scale - wanted.scale).norm() > kSmallestScale;
}

bool looks_different(const DisplayObject& told, const DisplayObject& wanted) {
  return told.colour != wanted.colour || told.text != wanted.text ||
         std::abs(told.cap_height_m - wanted.cap_height_m) > kSmallestScale;
}

void put(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::size_t SceneClient::Draft::bytes() const {
  std::size_t sum = kBytesAround + kBytesToHide * tool_ids.size();
  for (const Part* part : parts()) {
    sum += part->bytes.size();
  }
  return sum;
}

std::size_t SceneClient::Draft::commands() const {
  std::size_t sum = 0;
  for (const Part* part : parts()) {
    sum += part->expected.size();
  }
  return sum;
}

/// For how many frames after the next list objects that follow a tool may stay visible; 0: they are
/// too old already.
int SceneClient::fuse_frames(const SceneMoment& now) const {
  if (!wanted_.tool_time) {
    return 0;
  }
  const auto is_idle = [](const Expected& each) { return each.kind == Expected::Kind::kIdle; };
  const auto waiting = std::count_if(expected_.begin(), expected_.end(), is_idle);
  // The list is shown when it has arrived and, judged by the answers, the previous fuse has ended.
  const Duration one_way = round_trip_ / 2;
  const Duration until_shown = std::max(one_way, waiting * frame_ - one_way) + kNetwork;
  const Duration left =
      ObjectDisplay::kLongestToolAge - (now.headset - *wanted_.tool_time) - until_shown;
  const auto frames = left / frame_ - kFramesBesideFuse;
  return static_cast<int>(std::clamp<std::int64_t>(frames, 0, kMaxFuseFrames));
}

SceneClient::Draft SceneClient::draft_list(bool shows_tools, HostTime now) {
  // If there is not room for everything, guidance goes first, and moving objects do not starve new
  // ones.
  enum class Turn { kTool, kNew, kOther };
  Draft draft;
  has_more_ = false;
  statistics_.left_out = 0;
  for (const DisplayObject& wanted : wanted_.objects) {
    draft_presence(wanted, now, draft);
  }
  for (const Turn turn : {Turn::kTool, Turn::kNew, Turn::kOther}) {
    for (const DisplayObject& wanted : wanted_.objects) {
      const auto found = remotes_.find(wanted.key);
      if (found == remotes_.end() || found->second.id == 0) {
        continue;
      }
      const bool moving = found->second.placed && found->second.active;
      const Turn own = wanted.follows_tool ? Turn::kTool : moving ? Turn::kOther : Turn::kNew;
      if (own != turn) {
        continue;
      }
      if (draft_changes(wanted, found->second, draft)) {
        draft_show(wanted, found->second, shows_tools, draft);
      }
    }
  }
  draft_removals(draft);
  return draft;
}

bool SceneClient::has_room(const Draft& draft) {
  if (draft.commands() < budget_.commands_a_list &&
      static_cast<double>(draft.bytes()) < allowance_bytes_) {
    return true;
  }
  has_more_ = true;
  return false;
}

/// Ensures that the object exists with its shape.
void SceneClient::draft_presence(const DisplayObject& wanted, HostTime now, Draft& draft) {
  const auto found = remotes_.find(wanted.key);
  if (found == remotes_.end() && remotes_.size() >= budget_.objects) {
    ++statistics_.left_out;
    return;
  }
  Remote& remote = remotes_[wanted.key];
  remote.wanted_in = list_number_;
  if (remote.id != 0 && remote.told.shape != wanted.shape) {
    draft_removal(remote, draft);
    remote.forget();
  }
  if (remote.id == 0) {
    draft_create(wanted, remote, now, draft);
  }
}

void SceneClient::draft_removal(const Remote& remote, Draft& draft) {
  append_remove(draft.removals.bytes, remote.id);
  draft.removals.expected.push_back({});
}

/// Objects start hidden, so this alone shows nothing; the rest follows once the id is known.
void SceneClient::draft_create(const DisplayObject& wanted, Remote& remote, HostTime now,
                               Draft& draft) {
  if (remote.creating) {
    return;
  }
  if (now < remote.ask_again || draft.creates.expected.size() >= kMaxCreates) {
    has_more_ = true;
    return;
  }
  if (!has_room(draft)) {
    return;
  }
  append_create(draft.creates.bytes, wanted.shape);
  draft.creates.expected.push_back({Expected::Kind::kCreate, wanted.key});
  remote.creating = true;
  remote.told.shape = wanted.shape;
}

/// False where the list had no room for all of it.
bool SceneClient::draft_changes(const DisplayObject& wanted, Remote& remote, Draft& draft) {
  std::vector<std::uint8_t>& bytes = draft.changes.bytes;
  const Expected expected{Expected::Kind::kObject, wanted.key};
  const bool moves = !remote.placed || is_moved(remote.told, wanted);
  const bool changes = !remote.looks || looks_different(remote.told, wanted);
  if ((moves || changes) && !has_room(draft)) {
    return false;
  }
  const DisplayObject told = std::exchange(remote.told, wanted);
  if (moves) {
    append_transform(bytes, remote.id, wanted);
    draft.changes.expected.push_back(expected);
  } else {
    // Compared with the value last sent, not with later ones that differed too little.
    remote.told.place = told.place;
    remote.told.position_m = told.position_m;
    remote.told.rotation = told.rotation;
    remote.told.scale = told.scale;
  }
  if (changes) {
    append_look(bytes, remote.id, wanted);
    draft.changes.expected.push_back(expected);
  }
  remote.placed = remote.looks = true;
  return true;
}

void SceneClient::draft_show(const DisplayObject& wanted, Remote& remote, bool shows_tools,
                             Draft& draft) {
  if (wanted.follows_tool && !shows_tools) {
    if (std::exchange(remote.active, false)) {
      append_active(draft.removals.bytes, remote.id, false);
      draft.removals.expected.push_back({Expected::Kind::kObject, wanted.key});
    }
    return;
  }
  if (!wanted.follows_tool && remote.active) {
    return;
  }
  if (!has_room(draft)) {
    return;
  }
  Part& part = wanted.follows_tool ? draft.tool_shows : draft.shows;
  append_active(part.bytes, remote.id, true);
  part.expected.push_back({Expected::Kind::kObject, wanted.key});
  remote.active = !wanted.follows_tool;
  if (wanted.follows_tool) {  // hidden again by the fuse
    draft.tool_ids.push_back(remote.id);
  }
}

void SceneClient::draft_removals(Draft& draft) {
  for (auto each = remotes_.begin(); each != remotes_.end();) {
    Remote& remote = each->second;
    const bool is_wanted = remote.wanted_in == list_number_;
    const bool is_kept = remote.told.follows_tool && !remote.active && remote.placed &&
                         list_number_ - remote.wanted_in < kKeptHiddenLists;
    if (is_wanted || is_kept || remote.creating) {
      ++each;
      continue;
    }
    if (remote.id != 0) {
      draft_removal(remote, draft);
    }
    each = remotes_.erase(each);
  }
}

std::vector<std::uint8_t> SceneClient::assemble(const Draft& draft, int fuse, HostTime now) {
  std::vector<std::uint8_t> bytes;
  const std::size_t before = expected_.size();
  if (!std::exchange(list_is_open_, false)) {
    append_plain(bytes, SceneCommand::kBeginList);
    expected_.push_back({});
  }
  for (const Part* part : draft.parts()) {
    put(bytes, part->bytes);
    expected_.insert(expected_.end(), part->expected.begin(), part->expected.end());
  }
  append_plain(bytes, SceneCommand::kEndList);
  expected_.push_back({Expected::Kind::kListEnd, 0});
  awaited_ = expected_.size();
  if (!draft.tool_ids.empty()) {
    append_fuse(draft, fuse, bytes);
  }
  ++statistics_.lists;
  statistics_.commands += static_cast<std::int64_t>(expected_.size() - before);
  return sent(std::move(bytes), now);
}

/// The next list may be sent when one frame of the fuse is left (two of a fuse of three), earlier
/// by the frames of a round trip, so that it arrives just before the fuse ends.
void SceneClient::append_fuse(const Draft& draft, int fuse, std::vector<std::uint8_t>& bytes) {
  for (int i = 0; i < fuse; ++i) {
    append_idle(bytes);
    expected_.push_back({Expected::Kind::kIdle, 0});
  }
  const auto on_the_way = static_cast<int>(round_trip_ / frame_);
  const int early = (fuse < kMaxFuseFrames ? 1 : 2) + on_the_way;
  awaited_ += static_cast<std::size_t>(std::max(0, fuse - early));
  append_plain(bytes, SceneCommand::kBeginList);
  expected_.push_back({});
  for (const std::uint32_t id : draft.tool_ids) {
    append_active(bytes, id, false);
    expected_.push_back({});
  }
  list_is_open_ = true;
  tool_answers_due_ = expected_.size();
}

}  // namespace orthonav::hl2ss
