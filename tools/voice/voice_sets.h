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
/// Thresholds were chosen on these.
inline constexpr std::string_view kTuningVoices[] = {
    "en-us-nyc", "en-us+f4",          "en-gb-x-gbclan+m2", "en-gb-x-gbcwmd+f5", "en-us+m6",
    "gmw/en+f4", "en-gb-scotland+f4", "en-029+m6",         "en-gb-x-rp+f5"};

/// The acoustic model was adapted to these variants, each in half of the accents.
inline constexpr std::string_view kTrainingAccents[] = {
    "en-us",     "gmw/en",         "en-gb-scotland", "en-gb-x-rp",
    "en-us-nyc", "en-gb-x-gbclan", "en-029",         "en-gb-x-gbcwmd"};
inline constexpr std::string_view kTrainingVariants[] = {
    "Alex",    "Alicia",   "Andrea", "Andy",  "Annie",   "Denis",  "Gene",   "Hugo",
    "Jacky",   "Lee",      "Marco",  "Mario", "Michael", "Mike",   "anika",  "aunty",
    "belinda", "benjamin", "boris",  "david", "ed",      "edward", "linda",  "max",
    "michel",  "paul",     "quincy", "rob",   "robert",  "sandro", "shelby", "steph",
    "travis",  "victor",   "zac",    "m4",    "m5",      "caleb",  "adam",   "antonio"};

}  // namespace orthonav::bench
