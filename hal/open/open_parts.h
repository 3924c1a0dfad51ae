#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// A clicker by URI; null for "headset", the headset's own.
///   none                 never pressed
///   evdev:               the first clicker in /dev/input
///   evdev:NAME           a clicker by a part of its name
///   evdev:PATH           a device (/dev/input/event5), or recorded events (a file or FIFO)
///   keyboard:            the first keyboard; keyboard:NAME
/// followed by ?keys=volumeup,enter&double_ms=300&hold_ms=500&debounce_ms=15&share
/// (share: other programs receive its events too). Borrows the clock.
Result<std::unique_ptr<Clicker>> open_clicker(const std::string& uri, const Clock& clock);

/// A voice by URI; null for "headset", the headset's own.
///   none                 hears nothing
///   mic:                 the default microphone; mic:NAME (a part of its name)
///   headset-mic:         the headset's own microphone, listened to here
///   wav:FILE             a sound file, played as the clock advances
/// `commands` are the phrases listened for, each after "ortho". Borrows the clock and the headset.
Result<std::unique_ptr<Voice>> open_voice(const std::string& uri,
                                          const std::vector<std::string>& commands,
                                          const Clock& clock, Headset* headset = nullptr);

}  // namespace orthonav
