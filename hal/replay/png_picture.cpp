#include "hal/replay/png_picture.h"

#include <png.h>
#include <zlib.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <new>
#include <string>

namespace orthonav::replay {

namespace {

/// What the callbacks of libpng, which reports errors by longjmp, work on.
struct Job {
  std::vector<std::uint8_t>* out = nullptr;
  std::string_view rest;
  std::array<char, 80> message{};

  [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
    auto& message = static_cast<Job*>(png_get_error_ptr(png))->message;
    std::strncpy(message.data(), text, message.size() - 1);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_write(png_structp png, png_bytep bytes, std::size_t count) {
    auto& out = *static_cast<Job*>(png_get_io_ptr(png))->out;
    try {
      out.insert(out.end(), bytes, bytes + count);
    } catch (const std::bad_alloc&) {
      png_error(png, "out of memory");
    }
  }
  static void on_flush(png_structp) {}
  static void on_read(png_structp png, png_bytep to, std::size_t count) {
    std::string_view& rest = static_cast<Job*>(png_get_io_ptr(png))->rest;
    if (count > rest.size()) {
      png_error(png, "ends too early");
    }
    std::memcpy(to, rest.data(), count);
    rest.remove_prefix(count);
  }
};

// The two functions that longjmp returns into hold nothing with a destructor.

bool write_all(png_structp png, png_infop info, Job& job, const GreyImage& image) {
  constexpr std::size_t kChunkBytes = 65536;
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_write_fn(png, &job, &Job::on_write, &Job::on_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width_px),
               static_cast<png_uint_32>(image.height_px), 8, PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG);
  png_set_compression_strategy(png, Z_HUFFMAN_ONLY);
  png_set_compression_buffer_size(png, kChunkBytes);
  png_write_info(png, info);
  for (int y = 0; y < image.height_px; ++y) {
    png_write_row(png, image.pixels.data() + static_cast<std::ptrdiff_t>(y) * image.width_px);
  }
  png_write_end(png, nullptr);
  return true;
}

bool read_all(png_structp png, png_infop info, Job& job, GreyImage& image) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_read_fn(png, &job, &Job::on_read);
  png_read_info(png, info);
  if (png_get_image_width(png, info) != static_cast<png_uint_32>(image.width_px) ||
      png_get_image_height(png, info) != static_cast<png_uint_32>(image.height_px) ||
      png_get_rowbytes(png, info) != static_cast<std::size_t>(image.width_px) ||
      png_get_bit_depth(png, info) != 8 ||
      png_get_interlace_type(png, info) != PNG_INTERLACE_NONE) {
    png_error(png, "is not the picture that its header announced");
  }
  for (int y = 0; y < image.height_px; ++y) {
    png_read_row(png, image.pixels.data() + static_cast<std::ptrdiff_t>(y) * image.width_px,
                 nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

Error failed(const Job& job) {
  return Error{job.message[0] == '\0' ? "out of memory" : job.message.data()};
}

}  // namespace

Result<PngHeader> parse_png_header(std::string_view bytes) {
  constexpr std::size_t kFirstChunkEnds = 33;
  constexpr std::string_view kStart("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  if (bytes.size() < kFirstChunkEnds || !bytes.starts_with(kStart)) {
    return Error{"is not a PNG"};
  }
  const auto byte = [bytes](std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); };
  const auto number = [&](std::size_t at) {
    return static_cast<std::int64_t>(byte(at)) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 |
           byte(at + 3);
  };
  const bool grey8 = byte(24) == 8 && byte(25) == PNG_COLOR_TYPE_GRAY && byte(28) == 0;
  return PngHeader{number(16), number(20), grey8};
}

Status encode_png(const GreyImage& image, std::vector<std::uint8_t>& out) {
  out.clear();
  Job job{&out, {}, {}};
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, &Job::on_error, &Job::on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool written = info != nullptr && write_all(png, info, job, image);
  png_destroy_write_struct(&png, &info);
  return written ? Status() : failed(job);
}

Status decode_png(std::string_view bytes, GreyImage& image) {
  Job job{nullptr, bytes, {}};
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, &Job::on_error, &Job::on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool read = info != nullptr && read_all(png, info, job, image);
  png_destroy_read_struct(&png, &info, nullptr);
  return read ? Status() : failed(job);
}

}  // namespace orthonav::replay
