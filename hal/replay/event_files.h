#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "hal/replay/head_history.h"

namespace orthonav::replay {

/// An event and when the recorded device delivered it: at its own time, unless it was late (a
/// phrase is recognized some time after it was spoken).
template <class Event>
struct Delivered {
  Event event;
  Timestamp available{};
};

struct RecordedEvents {
  std::vector<Delivered<ClickerEvent>> clicker;
  std::vector<Delivered<Phrase>> voice;
};

/// events.csv: clicker and voice, each in the order of delivery.
Result<RecordedEvents> read_events(const std::filesystem::path& path);
void append_event(std::string& line, const Delivered<ClickerEvent>& event);
void append_event(std::string& line, const Delivered<Phrase>& event);

/// head.csv: the head tracker's answers.
Result<HeadAnswers> read_head_answers(const std::filesystem::path& path);
void append_head_answer(std::string& line, std::int64_t sequence,
                        const Tracked<Transform<World, Rig>>& answer);

}  // namespace orthonav::replay
