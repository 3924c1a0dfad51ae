#pragma once

#include <string_view>

namespace orthonav::bench {

/// Voices of espeak-ng: an accent and a variant. No voice is in two of the sets, and two of the
/// measured accents (Scotland, the Caribbean) are in no other.
inline constexpr std::string_view kTestVoices[] = {
    "en-us",     "en-us+f2", "gmw/en+m3", "en-gb-x-rp+f1", "en-gb-scotland+m1",
    "en-029+f3", "en-us+m7"};
/// Thresholds were chosen on these.
inline constexpr std::string_view kTuningVoices[] = {
    "en-us-nyc", "en-us+f4", "en-gb-x-gbclan+m2", "en-gb-x-gbcwmd+f5", "en-us+m6", "gmw/en+f4"};

/// The acoustic model was adapted to these variants, each in three of the accents.
inline constexpr std::string_view kTrainingAccents[] = {
    "en-us", "gmw/en", "en-gb-x-rp", "en-us-nyc", "en-gb-x-gbclan", "en-gb-x-gbcwmd"};
inline constexpr std::string_view kTrainingVariants[] = {
    "Alex",    "Alicia",   "Andrea", "Andy",  "Annie",   "Denis",  "Gene",   "Hugo",
    "Jacky",   "Lee",      "Marco",  "Mario", "Michael", "Mike",   "anika",  "aunty",
    "belinda", "benjamin", "boris",  "david", "ed",      "edward", "linda",  "max",
    "michel",  "paul",     "quincy", "rob",   "robert",  "sandro", "shelby", "steph",
    "travis",  "victor",   "zac",    "m4",    "m5",      "caleb",  "adam",   "antonio"};

}  // namespace orthonav::bench
