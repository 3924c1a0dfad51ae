#pragma once

#include <string_view>

namespace orthonav::bench {

/// Voices of espeak-ng: an accent and a variant. The sets share accents; a variant that is measured
/// is in no other set.
inline constexpr std::string_view kTestVoices[] = {
    "en-us",     "en-us+f2", "gmw/en+m3", "en-gb-x-rp+f1", "en-gb-scotland+m1",
    "en-029+f3", "en-us+m7"};
/// Chosen before listening to them; nothing was tuned on them.
inline constexpr std::string_view kFreshVoices[] = {
    "en-us+john",   "gmw/en+m8",        "en-gb-x-rp+iven",        "en-gb-scotland+gustave",
    "en-029+pedro", "en-us-nyc+miguel", "en-gb-x-gbclan+grandma", "en-gb-x-gbcwmd+announcer"};
/// The weights of the evidence and the line were chosen on these.
inline constexpr std::string_view kTuningVoices[] = {"en-us-nyc",
                                                     "en-us+f4",
                                                     "en-gb-x-gbclan+m2",
                                                     "en-gb-x-gbcwmd+f5",
                                                     "en-us+m6",
                                                     "gmw/en+f4",
                                                     "en-gb-scotland+f4",
                                                     "en-029+m6",
                                                     "en-gb-x-rp+f5",
                                                     "en-us+adam",
                                                     "gmw/en+belinda",
                                                     "en-gb-x-rp+Hugo",
                                                     "en-gb-scotland+victor",
                                                     "en-029+anika",
                                                     "en-us-nyc+travis",
                                                     "en-gb-x-gbclan+quincy",
                                                     "en-gb-x-gbcwmd+Lee"};

}  // namespace orthonav::bench
