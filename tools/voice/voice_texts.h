#pragma once

#include <string_view>

namespace orthonav::bench {

/// Talk in an operating room without commands. Two sets without common sentences: thresholds were
/// chosen on the first, and results are reported on the second.
inline constexpr std::string_view kTuningTalk[] = {
    "We saved the scan from yesterday in the same folder.",
    "Could you pass me the small retractor, please?",
    "He was delayed at the airport and started late.",
    "The next patient is already waiting downstairs.",
    "I do not accept that as a reason.",
    "Okay.",
    "That is quite safe, I believe.",
    "Hold the suction a little lower.",
    "Her daily dose was reduced last week.",
    "Yes, go on.",
    "They rejected the first proposal in the spring.",
    "When we are done with this one, we take a short break.",
    "My sister's twins are starting school.",
    "Move the lamp a little towards me.",
    "It is on the left side.",
    "The screws are six millimetres thick.",
    "Thanks.",
    "Nobody deleted anything, the disk was full.",
    "Save your strength for the afternoon.",
    "I would start with the lower level.",
    "Two more minutes.",
    "The rod has to be bent a little more than that.",
    "How is the pressure?",
    "Right.",
    "We shaved the area this morning.",
    "She said the text was too long.",
    "Turn the radio down, please.",
    "There were ten of them in the box.",
    "What did the radiologist say about the lateral view?",
    "That one is mine.",
};

/// Phrases that resemble the wake word and a command: the weights were trained with these as well
/// as with the first set.
inline constexpr std::string_view kNearWakeWord[] = {
    "author",   "authors",     "often", "also",       "order",  "auto",      "although",
    "or so",    "or the",      "other", "ought to",   "others", "off the",   "Arthur",
    "orthodox", "orthopaedic", "offer", "altogether", "awful",  "are those", "north"};
inline constexpr std::string_view kNearCommands[] = {
    "start",  "safe", "saved",  "delayed", "accepted", "except", "the next one", "neck",
    "text",   "down", "one",    "twins",   "tin",      "right",  "rejected",     "object",
    "stop",   "star", "roads",  "move on", "delete",   "save",   "twin",         "done",
    "reject", "next", "accept", "move it", "same",     "day",    "unknown",      "that"};

inline constexpr std::string_view kTestTalk[] = {
    "I'll save that for later, when we are on the other side.",
    "Please be careful, this is not a safe place for the drill.",
    "The report was saved twice and one copy was deleted this morning.",
    "He has to shave twice daily, he told me.",
    "Okay.",
    "Let us look at the next image before we go on.",
    "I'm not done yet, give me another minute.",
    "The anaesthetist accepts the values as they are.",
    "Could somebody start the timer, please?",
    "Yes.",
    "We have to move the rod tray over there.",
    "It was rejected by the committee in the end.",
    "The twin study from last year said the opposite.",
    "Is the pressure still the same?",
    "Everything except the last screw is in place.",
    "Two millimetres more to the left, I think.",
    "Delete is a strong word for what happened to those files.",
    "Safe.",
    "The neck was stiff, and she had been in pain for years.",
    "Down a little.",
    "Who is on duty this evening?",
    "Say when.",
    "You can start closing on your side.",
    "Right, what is next on the list?",
    "I have never seen one like that before.",
    "Give me the long pedicle probe and keep the awl ready.",
    "None of the daily checks showed anything.",
    "Good.",
    "She had started walking again by the end of the week.",
    "Do you want to accept the call or should I take it?",
    "Careful.",
    "The saline is nearly gone, we need a new bag.",
    "They saved him a seat at the front.",
    "It is done, as far as I can tell from here.",
    "More light, please.",
    "Between the two of them there was no difference at all.",
    "The delay was not our fault.",
    "Thank you.",
    "I would rather reject it now than explain it tomorrow.",
    "Wait a moment.",
};

}  // namespace orthonav::bench
