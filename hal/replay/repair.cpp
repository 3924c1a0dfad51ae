#include "hal/replay/repair.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "base/file_code.h"
#include "hal/replay/durable.h"
#include "hal/replay/layout.h"
#include "hal/replay/recording.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

/// Two blocks of zeros end a tar.
constexpr std::uint64_t kEndMarkBytes = 1024;
constexpr std::uintmax_t kMaxLinesBytes = std::uintmax_t{1} << 31U;

Status resize(const std::filesystem::path& path, std::uint64_t bytes) {
  std::error_code code;
  std::filesystem::resize_file(path, bytes, code);
  return code
             ? Status(file_error(path, "cannot be cut to size: " + code.message(), file_code(code)))
             : Status();
}

/// Growing a file adds zeros, which the end mark is made of.
Status end_archive(const std::filesystem::path& path, std::uint64_t whole_bytes) {
  if (Status s = resize(path, whole_bytes); !s) {
    return s;
  }
  return resize(path, whole_bytes + kEndMarkBytes);
}

/// Keeps whole lines, at most `most`.
Status keep_lines(const std::filesystem::path& path, std::size_t most) {
  if (!is_there(path)) {
    return {};
  }
  const auto text = read_text(path, kMaxLinesBytes);
  if (!text) {
    return text.error();
  }
  std::size_t end = 0;
  for (std::size_t line = 0; line < most; ++line) {
    const std::size_t at = text->find('\n', end);
    if (at == std::string::npos) {
      break;
    }
    end = at + 1;
  }
  return end == text->size() ? Status() : resize(path, end);
}

constexpr std::size_t kAllLines = static_cast<std::size_t>(-1);

/// Keeps the header and the first `whole` rows of a stream's list of frames.
Status keep_frames(const std::filesystem::path& list, std::size_t whole) {
  return keep_lines(list, whole + 1);
}

Status close_pairs(const std::filesystem::path& folder, const Recording& recording) {
  // Our recorder writes in the order of time, and lists the complete frames.
  const bool is_listed = is_there(folder / kFramesFile);
  const RecordedPair& last = recording.pairs.back();
  if (is_listed) {
    if (Status s = keep_frames(folder / kFramesFile, recording.pairs.size()); !s) {
      return s;
    }
  }
  for (const auto& [archive, member] :
       {std::pair(&recording.left, &last.left), std::pair(&recording.right, &last.right)}) {
    const std::uint64_t end = is_listed ? archive->end_of(*member) : archive->whole_bytes();
    if (Status s = end_archive(archive->path(), end); !s) {
      return s;
    }
  }
  return {};
}

Status close_depth(const std::filesystem::path& folder, const RecordedDepth& depth) {
  if (depth.summary.cut.empty()) {
    return {};
  }
  const auto& path = depth.images.path();
  const auto list = frames_of(folder, path.stem().string());
  const bool is_listed = is_there(list);
  if (is_listed) {
    if (Status s = keep_frames(list, depth.frames.size()); !s) {
      return s;
    }
  }
  return end_archive(path, is_listed ? depth.images.end_of(depth.frames.back().range)
                                     : depth.images.whole_bytes());
}

Status close_lines(const std::filesystem::path& folder) {
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    const bool grows = name == kEventsFile || name == kHeadFile || name.ends_with("_map.csv") ||
                       name == kMapFile || name.ends_with("_rig2world.txt");
    if (!grows) {
      continue;
    }
    if (Status s = keep_lines(entry.path(), kAllLines); !s) {
      return s;
    }
  }
  return {};
}

Status close_all(const std::filesystem::path& folder, const Recording& recording) {
  if (Status s = close_pairs(folder, recording); !s) {
    return s;
  }
  for (const RecordedDepth& depth : recording.depth) {
    if (Status s = close_depth(folder, depth); !s) {
      return s;
    }
  }
  return close_lines(folder);
}

/// The name without ".part", which must be free.
Result<std::filesystem::path> own_name(const std::filesystem::path& folder) {
  const std::string name = folder.string();
  if (!name.ends_with(kUnfinished)) {
    return folder;
  }
  const std::filesystem::path own = name.substr(0, name.size() - kUnfinished.size());
  if (is_there(own)) {
    return file_error(own, "exists already; move it away first");
  }
  return own;
}

}  // namespace

Result<RepairReport> repair_recording(const std::filesystem::path& folder) {
  const auto path = without_slash(folder);
  const auto own = own_name(path);
  if (!own) {
    return own.error();
  }
  RepairReport report{0, "", *own};
  {
    const auto recording = read_recording(path);
    if (!recording) {
      return recording.error();
    }
    report.pairs = recording->summary.pairs;
    report.cut = recording->summary.cut;
    if (Status s = report.cut.empty() ? Status() : close_all(path, *recording); !s) {
      return s.error();
    }
  }
  const auto closed = read_recording(path);
  if (!closed) {
    return closed.error();
  }
  if (!closed->summary.cut.empty() || closed->summary.pairs != report.pairs) {
    return file_error(path, "is not whole after its repair: " + std::to_string(report.pairs) +
                                " pairs were, " + std::to_string(closed->summary.pairs) + " are; " +
                                closed->summary.cut);
  }
  if (const Status named = *own != path ? rename_durably(path, *own) : sync_all(path); !named) {
    return named.error();
  }
  return report;
}

}  // namespace orthonav::replay
