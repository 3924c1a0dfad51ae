#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace orthonav::test {

/// The application for Unity once more, from the protocol's description alone: it shares no code
/// with the client or the server, and keeps everything as it came, in Unity's left-handed axes.
class ScenePeer {
 public:
  struct Thing {
    bool text = false;
    std::uint32_t kind = 0;
    bool visible = false;
    bool follows_head = false;
    float place[10] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1};  ///< position, xyzw, scale
    float rgba[4] = {1, 1, 1, 1};
    float font = 0;
    std::string words;
  };

  void hear(const std::vector<std::uint8_t>& bytes) {
    heard_.insert(heard_.end(), bytes.begin(), bytes.end());
  }
  /// One frame of the application; its answers.
  std::vector<std::uint32_t> frame() {
    std::vector<std::uint32_t> answers;
    while (heard_.size() >= 8) {
      const std::uint32_t size = word(4);
      if (heard_.size() < 8 + std::size_t{size}) {
        break;
      }
      answers.push_back(obey(word(0), size));
      heard_.erase(heard_.begin(), heard_.begin() + 8 + static_cast<std::ptrdiff_t>(size));
      ++commands;
      if (!looping_) {
        break;
      }
    }
    return answers;
  }
  /// The client left: complete commands are executed, and the modes are reset.
  void left() {
    while (!frame().empty()) {
    }
    heard_.clear();
    looping_ = newest_is_meant_ = false;
  }

  std::map<std::uint32_t, Thing> things;
  int commands = 0;
  int refuse = 0;  ///< this many commands from now on

 private:
  [[nodiscard]] std::uint32_t word(std::size_t at) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value |= std::uint32_t{heard_[at + i]} << (8 * i);
    }
    return value;
  }
  void floats(std::size_t at, float* to, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t bits = word(at + 4 * i);
      std::memcpy(to + i, &bits, 4);
    }
  }
  std::uint32_t make(bool text, std::uint32_t kind) {
    if (refuse > 0) {
      --refuse;
      return 0;
    }
    newest_ += 10;
    things[newest_].text = text;
    things[newest_].kind = kind > 5 ? 5 : kind;
    return newest_;
  }
  std::uint32_t obey(std::uint32_t command, std::uint32_t size) {
    switch (command) {
      case 0:
        return size < 4 ? 0 : make(false, word(8));
      case 6:
        return make(true, 0);
      case 8:
        return 1;
      case 17:
        things.clear();
        return 1;
      case 18:
        looping_ = true;
        return 1;
      case 19:
        looping_ = false;
        return 1;
      case 20:
        newest_is_meant_ = size >= 4 ? word(8) != 0 : newest_is_meant_;
        return size >= 4 ? 1 : 0;
      default:
        return size < 4 ? 0 : alter(command, size);
    }
  }
  std::uint32_t alter(std::uint32_t command, std::uint32_t size) {
    const std::uint32_t id = newest_is_meant_ ? newest_ : word(8);
    if (things.count(id) == 0) {
      return 0;
    }
    if (refuse > 0) {
      --refuse;
      return 0;
    }
    Thing& thing = things[id];
    if (command == 1 && size >= 8) {
      thing.visible = word(12) != 0;
    } else if ((command == 2 || command == 3) && size >= 44) {
      thing.follows_head = command == 3;
      floats(12, thing.place, 10);
    } else if (command == 4 && size >= 20) {
      if (!thing.text) {
        floats(12, thing.rgba, 4);
      }
    } else if (command == 7 && size >= 24 && thing.text) {
      floats(12, &thing.font, 1);
      floats(16, thing.rgba, 4);
      thing.words.assign(heard_.begin() + 32, heard_.begin() + 8 + size);
    } else if (command == 16) {
      things.erase(id);
    } else {
      return command == 5 ? 1 : 0;
    }
    return 1;
  }

  std::deque<std::uint8_t> heard_;
  bool looping_ = false;
  bool newest_is_meant_ = false;
  std::uint32_t newest_ = 1000;
};

}  // namespace orthonav::test
