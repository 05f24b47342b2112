// JPEG through libjpeg rather than stb_image, whose Debian version (2.27) does not validate Huffman tables
// and accesses memory outside its arrays for some files.

#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <csetjmp>
#include <cstdio> // jpeglib.h needs it before itself
#include <cstdlib>
#include <jerror.h>
#include <jpeglib.h>

namespace candela {

namespace {

/// Many scans over a large picture would take the decoder hours.
constexpr int kMaxScans = 500;

/// libjpeg reports errors by longjmp to the function that called it, which must therefore have no objects
/// with destructors. So the two functions that call libjpeg own nothing; their caller does.
struct ErrorState : jpeg_error_mgr {
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX] = "";
};

ErrorState& state_of(j_common_ptr codec) { return *static_cast<ErrorState*>(codec->err); }

[[noreturn]] void fail(j_common_ptr codec) {
  ErrorState& state = state_of(codec);
  state.format_message(codec, state.message);
  std::longjmp(state.escape, 1);
}

/// Warnings about lost pixels are errors here; others (such as extra bytes between segments) are ignored.
void on_message(j_common_ptr codec, int level) {
  if (level >= 0) return;
  switch (codec->err->msg_code) {
  case JWRN_JPEG_EOF:
  case JWRN_HIT_MARKER:
  case JWRN_HUFF_BAD_CODE:
  case JWRN_MUST_RESYNC:
  case JWRN_BOGUS_PROGRESSION: fail(codec); fail(codec);
  default: break;
  }
}

void init_errors(ErrorState& state) {
  jpeg_std_error(&state);
  state.error_exit = fail;
  state.emit_message = on_message;
  state.output_message = [](j_common_ptr) {};
}

struct DecoderProgress : jpeg_progress_mgr {
  ProgressPart* whole = nullptr;
};

/// Called repeatedly by the decoder. A progressive file is decoded completely before its first line is
/// available.
void watch_decoder(j_common_ptr codec) {
  auto* decoder = reinterpret_cast<j_decompress_ptr>(codec);
  ErrorState& state = state_of(codec);
  const ProgressPart* whole = static_cast<DecoderProgress*>(codec->progress)->whole;
  if (whole && whole->cancelled()) std::longjmp(state.escape, 1);
  if (decoder->input_scan_number <= kMaxScans) return;
  std::snprintf(state.message, sizeof state.message, "more than %d scans", kMaxScans);
  std::longjmp(state.escape, 1);
}

struct Decoder {
  jpeg_decompress_struct codec{};
  ErrorState errors;
  DecoderProgress progress{};
  explicit Decoder(ProgressPart* whole) {
    init_errors(errors);
    codec.err = &errors;
    progress.progress_monitor = watch_decoder;
    progress.whole = whole;
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { jpeg_destroy_decompress(&codec); }
};

bool read_header(Decoder& d, ByteView bytes) {
  if (setjmp(d.errors.escape) != 0) return false;
  jpeg_create_decompress(&d.codec);
  d.codec.progress = &d.progress;
  jpeg_mem_src(&d.codec, bytes.data(), bytes.size());
  jpeg_read_header(&d.codec, TRUE);
  d.codec.out_color_space = JCS_RGB;
  return true;
}

bool read_pixels(Decoder& d, std::uint8_t* rgb) {
  if (setjmp(d.errors.escape) != 0) return false;
  jpeg_start_decompress(&d.codec);
  std::size_t row = std::size_t{d.codec.output_width} * 3;
  while (d.codec.output_scanline < d.codec.output_height) {
    if (d.progress.whole)
      d.progress.whole->reach(static_cast<double>(d.codec.output_scanline) / d.codec.output_height);
    JSAMPROW line = rgb + row * d.codec.output_scanline;
    jpeg_read_scanlines(&d.codec, &line, 1);
  }
  jpeg_finish_decompress(&d.codec);
  return true;
}

struct Encoder {
  jpeg_compress_struct codec{};
  ErrorState errors;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  Encoder() {
    init_errors(errors);
    codec.err = &errors;
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    jpeg_destroy_compress(&codec);
    std::free(bytes);
  }
};

bool write_pixels(Encoder& e, int width, int height, const std::uint8_t* rgb) {
  if (setjmp(e.errors.escape) != 0) return false;
  jpeg_create_compress(&e.codec);
  jpeg_mem_dest(&e.codec, &e.bytes, &e.size);
  e.codec.image_width = static_cast<JDIMENSION>(width);
  e.codec.image_height = static_cast<JDIMENSION>(height);
  e.codec.input_components = 3;
  e.codec.in_color_space = JCS_RGB;
  jpeg_set_defaults(&e.codec);
  jpeg_set_quality(&e.codec, 95, TRUE);
  // Colour in full resolution: renders have sharp saturated edges.
  e.codec.comp_info[0].h_samp_factor = e.codec.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&e.codec, TRUE);
  while (e.codec.next_scanline < e.codec.image_height) {
    // libjpeg's rows are not const; compressing only reads them.
    auto* line = const_cast<std::uint8_t*>(rgb) +
                 std::size_t{e.codec.next_scanline} * std::size_t{e.codec.image_width} * 3;
    jpeg_write_scanlines(&e.codec, &line, 1);
  }
  jpeg_finish_compress(&e.codec);
  return true;
}

} // namespace

bool is_jpg(ByteView bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

Picture8 decode_jpg(ByteView bytes, const Location& where, ProgressPart* progress) {
  Decoder decoder(progress);
  auto damaged = [&] {
    if (progress) progress->check();
    return damaged_image(where, fmt::format("it cannot be decoded ({})", decoder.errors.message));
  };
  if (!read_header(decoder, bytes)) throw damaged();
  std::int64_t width = decoder.codec.image_width, height = decoder.codec.image_height;
  check_image_size(where, width, height);
  if (decoder.codec.num_components > 3 || decoder.codec.jpeg_color_space == JCS_CMYK)
    throw input_error(where, "image", "it is a CMYK picture", "convert it to RGB");
  // The first scan has at least one bit for every 8x8 block.
  if (!decoder.codec.arith_code && static_cast<std::int64_t>(bytes.size()) < width * height / 512)
    throw damaged_image(where, "the JPEG is too short for the size it claims");
  Picture8 picture{static_cast<int>(width), static_cast<int>(height),
                   Bytes(static_cast<std::size_t>(width * height) * 3)};
  if (!read_pixels(decoder, picture.rgb.data())) throw damaged();
  return picture;
}

Bytes encode_jpg(int width, int height, ByteView rgb, const std::string& path) {
  Encoder encoder;
  if (!write_pixels(encoder, width, height, rgb.data()))
    throw output_error(path, fmt::format("it cannot be encoded ({})", encoder.errors.message),
                       "write a PNG instead");
  return Bytes(encoder.bytes, encoder.bytes + encoder.size);
}

} // namespace candela
