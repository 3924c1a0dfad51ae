#include "engine/io/png_reader.h"

#include <png.h>

#include <csetjmp>
#include <cstring>

namespace orthonav::engine {

struct PngReader::Library {
  png_structp decoder = nullptr;
  png_infop header = nullptr;
  int passes = 1;
  std::string message;
  std::string_view rest;

  [[noreturn]] static void on_error(png_structp decoder, png_const_charp message) {
    static_cast<Library*>(png_get_error_ptr(decoder))->message = message;
    png_longjmp(decoder, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_read(png_structp decoder, png_bytep to, std::size_t bytes) {
    std::string_view& rest = static_cast<Library*>(png_get_io_ptr(decoder))->rest;
    if (bytes > rest.size()) {
      png_error(decoder, "read beyond end of data");
    }
    std::memcpy(to, rest.data(), bytes);
    rest.remove_prefix(bytes);
  }
};

PngReader::PngReader(std::string_view content) : library_(std::make_unique<Library>()) {
  library_->rest = content;
}

PngReader::~PngReader() { png_destroy_read_struct(&library_->decoder, &library_->header, nullptr); }

// A function that longjmp returns into must hold nothing with a destructor.
bool PngReader::read_header() {
  Library& library = *library_;
  library.decoder = png_create_read_struct(PNG_LIBPNG_VER_STRING, &library, &Library::on_error,
                                           &Library::on_warning);
  library.header = library.decoder ? png_create_info_struct(library.decoder) : nullptr;
  if (!library.header) {
    return false;
  }
  if (setjmp(png_jmpbuf(library.decoder)) != 0) {
    return false;
  }
  png_set_read_fn(library.decoder, &library, &Library::on_read);
  png_read_info(library.decoder, library.header);
  png_set_scale_16(library.decoder);
  png_set_expand(library.decoder);
  library.passes = png_set_interlace_handling(library.decoder);
  png_read_update_info(library.decoder, library.header);
  return true;
}

int PngReader::width_px() const {
  return static_cast<int>(png_get_image_width(library_->decoder, library_->header));
}
int PngReader::height_px() const {
  return static_cast<int>(png_get_image_height(library_->decoder, library_->header));
}
int PngReader::channels() const { return png_get_channels(library_->decoder, library_->header); }

bool PngReader::read_pixels(std::uint8_t* pixels) {
  Library& library = *library_;
  if (setjmp(png_jmpbuf(library.decoder)) != 0) {
    return false;
  }
  const png_uint_32 rows = png_get_image_height(library.decoder, library.header);
  const std::size_t bytes = png_get_rowbytes(library.decoder, library.header);
  for (int pass = 0; pass < library.passes; ++pass) {
    for (png_uint_32 row = 0; row < rows; ++row) {
      png_read_row(library.decoder, pixels + row * bytes, nullptr);
    }
  }
  png_read_end(library.decoder, nullptr);
  return true;
}

std::string PngReader::message() const {
  return library_->message.empty() ? "out of memory" : library_->message;
}

}  // namespace orthonav::engine
