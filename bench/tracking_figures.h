#pragma once

#include <string>
#include <vector>

#include "bench/tag_sequences.h"
#include "bench/tracking_methods.h"

namespace orthonav::bench {

/// Results of a method on a sequence. Sums of squares over `count` poses, without the first pairs.
struct Figures {
  std::vector<double> ms;
  double visible = 0;  ///< tags that both cameras see nearly whole
  double seen = 0;     ///< of these
  int gap = 0;         ///< longest run of pairs in which a visible tag was not seen
  /// Poses of a tool that neither camera sees, or with a corner farther than half the tag's size
  /// from its place; and sightings in one image of an absent id, or at a place where the tag is
  /// not.
  int ghosts = 0;
  double count = 0;  ///< poses other than ghosts
  double position = 0, rotation = 0, tip = 0, nees = 0, nees_count = 0;
  double jitter = 0, jitters = 0;  ///< of tips at rest in World, from the third second on
};

[[nodiscard]] Figures measure(const Sequence& sequence, const Track& track);

/// A table in Markdown.
void print_head();
void print_row(const Sequence& sequence, const std::string& method, const Figures& figures);
/// Prints the Cramér-Rao bound of the visible tags of ten pairs; nothing for a sequence without
/// one.
void print_bound(const Sequence& sequence);

}  // namespace orthonav::bench
