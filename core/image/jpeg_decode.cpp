#include "core/image/decoded.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <jerror.h>
#include <jpeglib.h>

namespace oversketch {

namespace {

constexpr std::string_view kJpeg = "JPEG";
/// More passes over the picture than any encoder makes (a full progressive script has about 10): a few bytes a pass
/// could otherwise keep the decoder busy for minutes.
constexpr int kMostScans = 100;
constexpr std::string_view kExifPrefix{"Exif\0\0", 6};

/// Everything that lives across longjmp: no local of the function that calls setjmp is changed after it.
struct Job {
  jpeg_decompress_struct info;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf failed;
  bool too_many_scans;
};

[[noreturn]] void fail(j_common_ptr info) {
  std::longjmp(static_cast<Job*>(info->client_data)->failed, 1);
}

/// libjpeg goes on after damage, with grey for what is missing; here that ends the reading.  Let pass is only what does
/// not touch the pixels: stray bytes between segments, versions, profiles and parameters that are not used.
void heed_warning(j_common_ptr info, int level) {
  if (level >= 0) return;
  constexpr std::array kHarmless{JWRN_EXTRANEOUS_DATA, JWRN_JFIF_MAJOR, JWRN_ADOBE_XFORM, JWRN_BOGUS_ICC,
                                 JWRN_NOT_SEQUENTIAL};
  if (std::find(kHarmless.begin(), kHarmless.end(), info->err->msg_code) == kHarmless.end()) fail(info);
}

void count_scans(j_common_ptr info) {
  Job& job = *static_cast<Job*>(info->client_data);
  if (job.info.input_scan_number <= kMostScans) return;
  job.too_many_scans = true;
  fail(info);
}

void ignore_message(j_common_ptr) {}

void start(Job& job, std::span<const std::byte> file) {
  job.info.err = jpeg_std_error(&job.errors);
  job.errors.error_exit = fail;
  job.errors.emit_message = heed_warning;
  job.errors.output_message = ignore_message;
  job.info.client_data = &job;
  if (setjmp(job.failed)) return;
  jpeg_create_decompress(&job.info);
  job.progress.progress_monitor = count_scans;
  job.info.progress = &job.progress;
  jpeg_mem_src(&job.info, reinterpret_cast<const unsigned char*>(file.data()), file.size());
  jpeg_save_markers(&job.info, JPEG_APP0 + 1, 0xFFFF);
}

bool read_header(Job& job) {
  if (setjmp(job.failed)) return false;
  jpeg_read_header(&job.info, TRUE);
  return true;
}

/// Of the first EXIF block.  The markers live until the pixels have been read.
int read_orientation(const Job& job) {
  for (jpeg_saved_marker_ptr m = job.info.marker_list; m; m = m->next)
    if (m->data_length >= kExifPrefix.size() && std::memcmp(m->data, kExifPrefix.data(), kExifPrefix.size()) == 0)
      return exif_orientation({reinterpret_cast<const std::byte*>(m->data), m->data_length});
  return 1;
}

bool read_pixels(Job& job, unsigned char* pixels, std::size_t row_bytes) {
  if (setjmp(job.failed)) return false;
  jpeg_start_decompress(&job.info);
  while (job.info.output_scanline < job.info.output_height) {
    JSAMPROW row = pixels + job.info.output_scanline * row_bytes;
    jpeg_read_scanlines(&job.info, &row, 1);
  }
  jpeg_finish_decompress(&job.info);
  return true;
}

Error to_error(const Job& job) {
  if (job.too_many_scans) return image_unsupported(kJpeg, "more than " + std::to_string(kMostScans) + " scans");
  std::array<char, JMSG_LENGTH_MAX> message{};
  job.errors.format_message(reinterpret_cast<j_common_ptr>(const_cast<jpeg_decompress_struct*>(&job.info)),
                            message.data());
  switch (job.errors.msg_code) {
  case JWRN_JPEG_EOF:
  case JERR_INPUT_EMPTY:
  case JERR_INPUT_EOF:
    return image_truncated(kJpeg);
  case JERR_OUT_OF_MEMORY:
    return image_too_large(kJpeg, "there is not enough memory");
  case JERR_IMAGE_TOO_BIG:
    return image_too_large(kJpeg, message.data());
  case JERR_BAD_PRECISION:
  case JERR_SOF_UNSUPPORTED:
  case JERR_ARITH_NOTIMPL:
  case JERR_CONVERSION_NOTIMPL:
    return image_unsupported(kJpeg, std::string("a rare kind of coding (") + message.data() + ")");
  default:
    return image_damaged(kJpeg, message.data());
  }
}

/// Ink to light without a colour profile: what is left of white after both the ink and black.  Adobe's programs store
/// inks the other way round (255 is none) and say so by their marker.
void cmyk_to_rgb(const unsigned char* ink, unsigned char* rgb, std::size_t pixels, bool inverted) {
  for (std::size_t i = 0; i < pixels; ++i, ink += 4, rgb += 3) {
    const int black = inverted ? ink[3] : 255 - ink[3];
    for (int c = 0; c < 3; ++c) {
      const int light = inverted ? ink[c] : 255 - ink[c];
      rgb[c] = static_cast<unsigned char>((light * black + 127) / 255);
    }
  }
}

Decoded without_ink(const Decoded& cmyk, bool inverted) {
  Decoded rgb = make_decoded(cmyk.width, cmyk.height, 3, Samples::kU8);
  cmyk_to_rgb(reinterpret_cast<const unsigned char*>(cmyk.data.get()), reinterpret_cast<unsigned char*>(rgb.data.get()),
              static_cast<std::size_t>(cmyk.width) * static_cast<std::size_t>(cmyk.height), inverted);
  return rgb;
}

} // namespace

Result<Decoded> decode_jpeg(std::span<const std::byte> file, std::int64_t most_pixels) {
  const auto close = [](Job* job) {
    jpeg_destroy_decompress(&job->info);
    delete job;
  };
  const std::unique_ptr<Job, decltype(close)> job(new Job{}, close);
  start(*job, file);
  if (!job->info.src || !read_header(*job)) return to_error(*job);
  if (const auto size = check_size(job->info.image_width, job->info.image_height, kJpeg, most_pixels); !size)
    return size.error();
  const int orientation = read_orientation(*job);
  const int components = job->info.num_components;
  if (components != 1 && components != 3 && components != 4)
    return image_unsupported(kJpeg, std::to_string(components) + " colour channels");
  job->info.out_color_space = components == 1 ? JCS_GRAYSCALE : components == 3 ? JCS_RGB : JCS_CMYK;
  Decoded decoded = make_decoded(static_cast<int>(job->info.image_width), static_cast<int>(job->info.image_height),
                                 components, Samples::kU8);
  if (!read_pixels(*job, reinterpret_cast<unsigned char*>(decoded.data.get()), decoded.row_bytes()))
    return to_error(*job);
  if (components == 4) decoded = without_ink(decoded, job->info.saw_Adobe_marker);
  decoded.orientation = orientation;
  return decoded;
}

} // namespace oversketch
