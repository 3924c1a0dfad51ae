#include "engine/io/jpeg_reader.h"

#include <array>
#include <csetjmp>
#include <cstdio>
// libjpeg needs FILE and size_t declared before it.
#include <jpeglib.h>

namespace orthonav::engine {

struct JpegReader::Library {
  jpeg_error_mgr errors{};  // first: libjpeg hands back a pointer to it
  jpeg_decompress_struct decoder{};
  std::jmp_buf failed{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  std::string_view content;

  static Library& of(j_common_ptr common) { return *static_cast<Library*>(common->client_data); }

  static void keep_message(j_common_ptr common) {
    if (of(common).message[0] == '\0') {
      common->err->format_message(common, of(common).message.data());
    }
  }
  [[noreturn]] static void on_error(j_common_ptr common) {
    keep_message(common);
    std::longjmp(of(common).failed, 1);
  }
  static void on_message(j_common_ptr common, int level) {
    if (level >= 0) {
      return;  // informational only
    }
    ++common->err->num_warnings;
    keep_message(common);
  }
  static void print_nothing(j_common_ptr) {}
};

JpegReader::JpegReader(std::string_view content) : library_(std::make_unique<Library>()) {
  library_->content = content;
  library_->decoder.err = jpeg_std_error(&library_->errors);
  library_->errors.error_exit = &Library::on_error;
  library_->errors.emit_message = &Library::on_message;
  library_->errors.output_message = &Library::print_nothing;
  library_->decoder.client_data = library_.get();
}

JpegReader::~JpegReader() { jpeg_destroy_decompress(&library_->decoder); }

// A function that longjmp returns into must hold nothing with a destructor.
bool JpegReader::read_header() {
  jpeg_decompress_struct& decoder = library_->decoder;
  if (setjmp(library_->failed) != 0) {
    return false;
  }
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(library_->content.data()),
               static_cast<unsigned long>(library_->content.size()));
  jpeg_read_header(&decoder, TRUE);
  decoder.out_color_space = JCS_GRAYSCALE;
  decoder.dct_method = JDCT_ISLOW;
  return library_->errors.num_warnings == 0;
}

int JpegReader::width_px() const { return static_cast<int>(library_->decoder.image_width); }
int JpegReader::height_px() const { return static_cast<int>(library_->decoder.image_height); }

bool JpegReader::read_rows(std::uint8_t* pixels) {
  jpeg_decompress_struct& decoder = library_->decoder;
  if (setjmp(library_->failed) != 0) {
    return false;
  }
  jpeg_start_decompress(&decoder);
  while (decoder.output_scanline < decoder.output_height && library_->errors.num_warnings == 0) {
    JSAMPROW row =
        pixels + static_cast<std::size_t>(decoder.output_scanline) * decoder.output_width;
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  if (library_->errors.num_warnings == 0) {
    jpeg_finish_decompress(&decoder);
  }
  return library_->errors.num_warnings == 0;
}

std::string JpegReader::message() const { return library_->message.data(); }

}  // namespace orthonav::engine
