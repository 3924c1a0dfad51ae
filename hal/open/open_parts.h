#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// A clicker by URI; null for "headset", the headset's own.
///   none                 nobody presses anything
///   evdev:               the first clicker in /dev/input; evdev:/dev/input/event5, evdev:NAME (a
///   part
///                        of its name), evdev:FILE or FIFO (recorded events)
///   keyboard:            the first keyboard; keyboard:NAME
/// followed by ?keys=volumeup,enter&double_ms=300&hold_ms=500&debounce_ms=15&share
/// (share: other programs hear it too). Borrows the clock.
Result<std::unique_ptr<Clicker>> open_clicker(const std::string& uri, const Clock& clock);

/// A voice by URI; null for "headset", the headset's own.
///   none                 nobody says anything
///   mic:                 the default microphone; mic:NAME (a part of its name)
///   headset-mic:         the headset's own microphone, listened to here
///   wav:FILE             a sound file, heard as the clock goes on
/// followed by ?wake=always|noise|never: when a command needs "ortho" before it (default: always).
/// `commands` are the phrases listened for. Borrows the clock and the headset.
Result<std::unique_ptr<Voice>> open_voice(const std::string& uri,
                                          const std::vector<std::string>& commands,
                                          const Clock& clock, Headset* headset = nullptr);

}  // namespace orthonav
