#pragma once

#include <array>
#include <string>
#include <string_view>

namespace orthonav::voice {

/// A word and its sounds, in the phones of the en-us acoustic model (CMUdict's, without stress).
/// Further ways to say a word follow as "word(2)", "word(3)".
struct Pronunciation {
  std::string_view word;
  std::string_view sounds;
};

/// The words of the commands, as Americans, Britons and others say them.
inline constexpr Pronunciation kSpoken[] = {
    {"start", "S T AA R T"},
    {"start(2)", "S T AA T"},
    {"start(3)", "S T AO T"},
    {"start(4)", "S T AA R"},
    {"start(5)", "S T AH R T"},
    {"save", "S EY V"},
    {"save(2)", "S EH V"},
    {"save(3)", "S IY V"},
    {"save(4)", "S EY IH V"},
    {"delete", "D IH L IY T"},
    {"delete(2)", "D IY L IY T"},
    {"delete(3)", "D AH L IY T"},
    {"accept", "AE K S EH P T"},
    {"accept(2)", "AH K S EH P T"},
    {"accept(3)", "EH K S EH P T"},
    {"accept(4)", "AE K S EH P"},
    {"accept(5)", "AH G S EH P T"},
    {"accept(6)", "AH K S AE P T"},
    {"accept(7)", "AH K S EY P T"},
    {"reject", "R IH JH EH K T"},
    {"reject(2)", "R IY JH EH K T"},
    {"reject(3)", "R AH JH EH K T"},
    {"next", "N EH K S T"},
    {"next(2)", "N EH K S"},
    {"next(3)", "N AE K S T"},
    {"next(4)", "N EY K S T"},
    {"next(5)", "N AY K S T"},
    {"next(6)", "N IH K S T"},
    {"done", "D AH N"},
    {"done(2)", "D UH N"},
    {"move", "M UW V"},
    {"rod", "R AA D"},
    {"rod(2)", "R AO D"},
    {"twin", "T W IH N"},
    {"twin(2)", "T W IY N"},
    {"twin(3)", "T W EH N"},
    {"twin(4)", "D W IH N"},
    {"twin(5)", "TH W IH N"},
    {"twin(6)", "T W IH NG"},
    {"ortho", "AO R TH OW"},
    {"ortho(2)", "AO TH OW"},
    {"ortho(3)", "AO TH UH"},
    {"ortho(4)", "AO R TH AH"},
    {"ortho(5)", "AO F OW"},
};

/// Words that resemble a command but are not one.
inline constexpr Pronunciation kOthers[] = {
    {"safe", "S EY F"},
    {"saved", "S EY V D"},
    {"say", "S EY"},
    {"shave", "SH EY V"},
    {"same", "S EY M"},
    {"saves", "S EY V Z"},
    {"daily", "D EY L IY"},
    {"deleted", "D IH L IY T IH D"},
    {"delayed", "D IH L EY D"},
    {"except", "IH K S EH P T"},
    {"accepted", "AE K S EH P T IH D"},
    {"access", "AE K S EH S"},
    {"rejected", "R IH JH EH K T IH D"},
    {"text", "T EH K S T"},
    {"neck", "N EH K"},
    {"dumb", "D AH M"},
    {"down", "D AW N"},
    {"gun", "G AH N"},
    {"one", "W AH N"},
    {"none", "N AH N"},
    {"started", "S T AA R T IH D"},
    {"star", "S T AA R"},
    {"stop", "S T AA P"},
    {"win", "W IH N"},
    {"twins", "T W IH N Z"},
    {"tin", "T IH N"},
    {"between", "B IH T W IY N"},
    {"moved", "M UW V D"},
    {"right", "R AY T"},
    {"red", "R EH D"},
    {"road", "R OW D"},
    {"thanks", "TH AE NG K S"},
    {"yes", "Y EH S"},
    {"okay", "OW K EY"},
    {"what", "W AH T"},
    {"nurse", "N ER S"},
    {"suction", "S AH K SH AH N"},
    {"screw", "S K R UW"},
    {"ten", "T EH N"},
};

/// Words that are said where a command is expected.
inline constexpr Pronunciation kAnswers[] = {
    {"no", "N OW"},
    {"yes", "Y EH S"},
    {"confirm", "K AH N F ER M"},
    {"undo", "AH N D UW"},
    {"okay", "OW K EY"},
    {"okay-british", "AH K EY"},
    {"reset", "R IY S EH T"},
    {"reset-short", "R IH S EH T"},
    {"stop", "S T AA P"},
    {"stop-british", "S T AO P"},
};

inline constexpr std::array<std::string_view, 39> kPhones = {
    "AA", "AE", "AH", "AO", "AW", "AY", "B",  "CH", "D", "DH", "EH", "ER", "EY",
    "F",  "G",  "HH", "IH", "IY", "JH", "K",  "L",  "M", "N",  "NG", "OW", "OY",
    "P",  "R",  "S",  "SH", "T",  "TH", "UH", "UW", "V", "W",  "Y",  "Z",  "ZH"};

/// The word that stands for one sound in a grammar.
inline std::string sound_word(std::string_view phone) { return "sound-" + std::string(phone); }

}  // namespace orthonav::voice
