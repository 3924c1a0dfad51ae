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
    {"begin", "B IH G IH N"},
    {"begin(2)", "B IY G IH N"},
    {"guiding", "G AY D IH NG"},
    {"save", "S EY V"},
    {"save(2)", "S EH V"},
    {"save(3)", "S IY V"},
    {"save(4)", "S EY IH V"},
    {"points", "P OY N T S"},
    {"points(2)", "P OY N S"},
    {"delete", "D IH L IY T"},
    {"delete(2)", "D IY L IY T"},
    {"delete(3)", "D AH L IY T"},
    {"last", "L AE S T"},
    {"last(2)", "L AA S T"},
    {"accept", "AE K S EH P T"},
    {"accept(2)", "AH K S EH P T"},
    {"accept(3)", "EH K S EH P T"},
    {"accept(4)", "AE K S EH P"},
    {"accept(5)", "AH G S EH P T"},
    {"accept(6)", "AH K S AE P T"},
    {"accept(7)", "AH K S EY P T"},
    {"result", "R IH Z AH L T"},
    {"result(2)", "R IY Z AH L T"},
    {"reject", "R IH JH EH K T"},
    {"reject(2)", "R IY JH EH K T"},
    {"reject(3)", "R AH JH EH K T"},
    {"level", "L EH V AH L"},
    {"go", "G OW"},
    {"go(2)", "G ER"},
    {"go(3)", "G UW"},
    {"to", "T UW"},
    {"to(2)", "T AH"},
    {"to(3)", "D AH"},
    {"to(4)", "T UH"},
    {"next", "N EH K S T"},
    {"next(2)", "N EH K S"},
    {"next(3)", "N AE K S T"},
    {"next(4)", "N EY K S T"},
    {"next(5)", "N AY K S T"},
    {"next(6)", "N IH K S T"},
    {"finish", "F IH N IH SH"},
    {"move", "M UW V"},
    {"template", "T EH M P L AH T"},
    {"template(2)", "T EH M P L EY T"},
    {"rod", "R AA D"},
    {"rod(2)", "R AO D"},
    {"twin", "T W IH N"},
    {"twin(2)", "T W IY N"},
    {"twin(3)", "T W EH N"},
    {"twin(4)", "D W IH N"},
    {"twin(5)", "TH W IH N"},
    {"twin(6)", "T W IH NG"},
    {"screw", "S K R UW"},
    {"ortho", "AO R TH OW"},
    {"ortho(2)", "AO TH OW"},
    {"ortho(3)", "AO TH UH"},
    {"ortho(4)", "AO R TH AH"},
    {"ortho(5)", "AO F OW"},
};

/// What people say where a command is expected, and after the first word of one. "On" and "all" are
/// left out: they sound like the end of "finish rod".
inline constexpr std::array<std::string_view, 7> kAnswers = {"stop",    "okay", "yes",  "no",
                                                             "confirm", "undo", "reset"};
inline constexpr std::array<std::string_view, 6> kOtherEndings = {"it",    "this", "that",
                                                                  "again", "back", "nothing"};
inline constexpr Pronunciation kOthers[] = {
    {"stop", "S T AA P"},         {"stop(2)", "S T AO P"}, {"okay", "OW K EY"},
    {"okay(2)", "AH K EY"},       {"yes", "Y EH S"},       {"no", "N OW"},
    {"confirm", "K AH N F ER M"}, {"undo", "AH N D UW"},   {"reset", "R IY S EH T"},
    {"reset(2)", "R IH S EH T"},  {"it", "IH T"},          {"this", "DH IH S"},
    {"that", "DH AE T"},          {"again", "AH G EH N"},  {"back", "B AE K"},
    {"nothing", "N AH TH IH NG"},
};

inline constexpr std::array<std::string_view, 39> kPhones = {
    "AA", "AE", "AH", "AO", "AW", "AY", "B",  "CH", "D", "DH", "EH", "ER", "EY",
    "F",  "G",  "HH", "IH", "IY", "JH", "K",  "L",  "M", "N",  "NG", "OW", "OY",
    "P",  "R",  "S",  "SH", "T",  "TH", "UH", "UW", "V", "W",  "Y",  "Z",  "ZH"};

/// The word that stands for one sound in a grammar.
inline std::string sound_word(std::string_view phone) { return "sound-" + std::string(phone); }

}  // namespace orthonav::voice
