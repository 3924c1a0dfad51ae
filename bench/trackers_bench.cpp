// Every way of tracking on the same pairs, one thread each: time, detections and ghosts, errors
// against the truth, honesty of the covariance, and the Cramér-Rao bound. Prints a table in
// Markdown.
//   bench_trackers [PAIRS] [--other] [--only SEQUENCE,...] [--methods METHOD,...] [--pictures
//   FOLDER]
//     PAIRS      pairs a sequence, 300 by default, at least 70; 100 of --other
//     --other    sequences from a renderer and cameras that share nothing with the simulator
//     --only     sequences whose names contain one of these
//     --methods  methods whose names contain one of these
//     --pictures writes some pairs of each sequence as PGM
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "bench/other_sequences.h"
#include "bench/recorded_sequence.h"
#include "bench/tracking_figures.h"

namespace orthonav::bench {
namespace {

struct Arguments {
  int pairs = 0;
  bool other = false;
  std::string pictures;
  std::vector<std::string> only;
  std::vector<std::string> methods;
};

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.emplace_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

Arguments parsed(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--only" && i + 1 < argc) {
      arguments.only = split(argv[++i]);
    } else if (word == "--methods" && i + 1 < argc) {
      arguments.methods = split(argv[++i]);
    } else if (word == "--pictures" && i + 1 < argc) {
      arguments.pictures = argv[++i];
    } else if (word == "--other") {
      arguments.other = true;
    } else if (std::atoi(argv[i]) > 0) {
      arguments.pairs = std::max(std::atoi(argv[i]), 70);
    } else {
      std::fprintf(stderr,
                   "usage: bench_trackers [PAIRS] [--other] [--only SEQUENCE,...] "
                   "[--methods METHOD,...] [--pictures FOLDER]\n");
      std::exit(2);
    }
  }
  if (arguments.pairs == 0) {
    arguments.pairs = arguments.other ? 100 : 300;
  }
  return arguments;
}

bool wanted(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::any_of(list.begin(), list.end(), [&](const std::string& part) {
           return name.find(part) != std::string::npos;
         });
}

void write(const GreyImage& image, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << image.width_px << ' ' << image.height_px << "\n255\n";
  file.write(reinterpret_cast<const char*>(image.pixels.data()),
             static_cast<std::streamsize>(image.pixels.size()));
}

void write_pictures(const Sequence& sequence, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (std::size_t k = 0; k < sequence.frames.size(); k += 25) {
    const std::string start = folder + "/" + sequence.name + "_" + std::to_string(k);
    write(sequence.frames[k].left, start + "_left.pgm");
    write(sequence.frames[k].right, start + "_right.pgm");
  }
}

void run(const Sequence& sequence, const Arguments& arguments) {
  if (!arguments.pictures.empty()) {
    write_pictures(sequence, arguments.pictures);
  }
  for (const Method& method : tracking_methods()) {
    if (wanted(arguments.methods, method.name)) {
      print_row(sequence, method.name, measure(sequence, method.start(sequence)));
    }
  }
  print_bound(sequence);
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  using namespace orthonav::bench;
  const Arguments arguments = parsed(argc, argv);
  print_head();
  for (const std::string& name : arguments.other ? other_sequence_names() : sequence_names()) {
    if (wanted(arguments.only, name)) {
      run(arguments.other ? make_other_sequence(name, arguments.pairs, 11)
                          : make_sequence(name, arguments.pairs, 7),
          arguments);
    }
  }
  if (arguments.other || !wanted(arguments.only, "recorded")) {
    return 0;
  }
  if (const auto recorded = recorded_sequence()) {
    run(*recorded, arguments);
  } else {
    std::fprintf(stderr, "the recorded sample is not here: its sequence is left out\n");
  }
  return 0;
}
