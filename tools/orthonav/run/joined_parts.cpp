#include "tools/orthonav/run/joined_parts.h"

#include <cstdio>
#include <utility>

#include "engine/session/workflow/commands.h"
#include "hal/open/open_parts.h"

namespace orthonav::tools {

Result<std::unique_ptr<JoinedHeadset>> join_parts(Headset& headset, const std::string& clicker,
                                                  const std::string& voice) {
  // A device that tracks tools itself is not worn on a head and has no clicker.
  if (clicker == "headset" && headset.tool_poses() != nullptr) {
    std::fprintf(stderr, "orthonav: warning: %s has no button: --clicker names one\n",
                 headset.name().c_str());
  }
  OtherParts parts;
  auto clicks = open_clicker(clicker, headset.clock());
  if (!clicks) {
    return clicks.error();
  }
  parts.clicker = std::move(*clicks);
  auto speech = open_voice(voice, engine::spotted_phrases(), headset.clock(), &headset);
  if (!speech) {
    return speech.error();
  }
  parts.voice = std::move(*speech);
  return std::make_unique<JoinedHeadset>(headset, std::move(parts));
}

}  // namespace orthonav::tools
