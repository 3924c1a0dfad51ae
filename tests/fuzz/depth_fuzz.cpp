#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "hal/hl2ss/depth_calibration.h"
#include "hal/hl2ss/depth_format.h"
#include "hal/hl2ss/png_decoder.h"
#include "hal/hl2ss/server/depth_bytes.h"
#include "hal/hl2ss/server/depth_request.h"
#include "hal/hl2ss/video_decoder.h"
#include "hal/sim/cameras/depth_model.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {
namespace {

using hl2ss::Bytes;

void ask_server(Bytes input) {
  for (const DepthStream stream : {DepthStream::kAhat, DepthStream::kLongThrow}) {
    const auto asked = hl2ss::understand_depth_request(stream, input);
    if (asked && *asked) {
      insist((*asked)->bytes > 0 && (*asked)->bytes <= input.size() && (*asked)->every > 0);
    }
  }
}

void split(Bytes input) {
  for (const DepthStream stream : {DepthStream::kAhat, DepthStream::kLongThrow}) {
    const auto picture = hl2ss::split_depth(stream, input);
    if (picture && *picture) {
      insist((*picture)->size() + 8 <= input.size());
    }
  }
}

void decode_png(Bytes input) {
  auto decoder = hl2ss::PngDecoder::create(320, 288);
  insist(decoder.ok());
  std::vector<std::uint8_t> bgra;
  if ((*decoder)->decode(input, bgra)) {
    insist(bgra.size() == std::size_t{4} * 320 * 288);
  }
}

void decode_video(Bytes input) {
  auto decoder = hl2ss::VideoDecoder::create(512, 512);
  insist(decoder.ok());
  GreyImage luma;
  std::vector<std::uint8_t> chroma;
  const auto unit = (*decoder)->decode(input, 1, luma, &chroma);
  if (unit && *unit) {
    DepthImage depth;
    DepthImage brightness;
    insist(luma.pixels.size() == std::size_t{512} * 512 && 2 * chroma.size() == luma.pixels.size());
    hl2ss::read_coded_ahat(luma, chroma, depth, brightness);
    insist(depth.pixels.size() == luma.pixels.size());
  }
}

/// A good calibration with numbers written over it: 4 bytes of place, 4 of number, again and again.
void read_calibration(Bytes input) {
  static const auto kGood =
      hl2ss::depth_answer_bytes(sim::calibration_of(sim::hololens2_long_throw()));
  auto answer = kGood;
  for (; input.size() >= 8; input = input.subspan(8)) {
    const auto place = hl2ss::number_at<std::uint32_t>(input, 0);
    std::copy_n(input.begin() + 4, 4,
                answer.begin() + static_cast<std::ptrdiff_t>(4 * (place % (answer.size() / 4))));
  }
  const auto read = hl2ss::read_depth_calibration(DepthStream::kLongThrow, answer);
  if (!read) {
    return;
  }
  for (const auto& [x, y, z] : read->camera.rays) {
    insist(z >= 0.0F && (z == 0.0F || std::abs(std::hypot(x, y, z) - 1.0F) < 1e-5F));
  }
}

}  // namespace

/// The first byte chooses what is read.
void fuzz_depth(Bytes input) {
  if (input.empty()) {
    return;
  }
  const Bytes rest = input.subspan(1);
  switch (input[0] % 5) {
    case 0:
      return ask_server(rest);
    case 1:
      return split(rest);
    case 2:
      return decode_png(rest);
    case 3:
      return decode_video(rest);
    default:
      return read_calibration(rest);
  }
}

}  // namespace orthonav::fuzz
