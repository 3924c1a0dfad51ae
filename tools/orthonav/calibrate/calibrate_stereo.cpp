#include "tools/orthonav/calibrate/calibrate_stereo.h"

#include <memory>

#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

int run_stereo(const StereoArguments& arguments) {
  const bool images =
      !arguments.chessboard.empty() || !arguments.left.empty() || !arguments.right.empty();
  const bool recording = !arguments.recording.empty() || !arguments.board.empty();
  if (images == recording) {
    return bad_input(
        "calibrate stereo: give --chessboard, --left and --right, or a RECORDING "
        "and --board");
  }
  if (recording && (arguments.recording.empty() || arguments.board.empty())) {
    return bad_input("calibrate stereo: a RECORDING needs --board, and --board a RECORDING");
  }
  if (images &&
      (arguments.chessboard.empty() || arguments.left.empty() || arguments.right.empty())) {
    return bad_input("calibrate stereo: images need --chessboard, --left and --right");
  }
  return images ? run_stereo_images(arguments) : run_stereo_recording(arguments);
}

constexpr const char* kStereoFooter =
    "\nImages: of a flat chessboard seen by both cameras at once, ten pairs and more, tilted "
    "every\n"
    "way and up to the edges. They are paired by the numbers in their names. A board with an odd\n"
    "and an even count is best: half a turn shows. A recording: of a board of tags (see `print\n"
    "board`), moved all over both images; the lenses stay as the device has them, and what is "
    "found\n"
    "is how the cameras lie to each other. Pixel coordinates: the top-left pixel's centre is\n"
    "(0.5, 0.5). Exit code 1: too few views, or the verdict is fail.";

}  // namespace

void add_calibrate_stereo(CLI::App& calibrate, Action& action) {
  auto arguments = std::make_shared<StereoArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "stereo", "Two cameras, from images of a chessboard or a recording of a board of tags");
  command->add_option("RECORDING", arguments->recording, "Folder of a recording");
  command->add_option("--board", arguments->board, "The board in the recording (JSON)")
      ->type_name("FILE");
  command
      ->add_option("--chessboard", arguments->chessboard,
                   "Inner corners across and down, such as 9x6")
      ->type_name("COLUMNSxROWS");
  command->add_option("--square-mm", arguments->square_mm, "Edge of a square as printed")
      ->check(finite_number(1, 500))
      ->capture_default_str();
  command->add_option("--left", arguments->left, "Images of the left camera (PNG, JPEG, PGM)")
      ->type_name("IMAGE");
  command->add_option("--right", arguments->right, "Images of the right camera")
      ->type_name("IMAGE");
  arguments->json.add_to(*command);
  command->footer(kStereoFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_stereo(*arguments); }; });
}

}  // namespace orthonav::tools
