#include "core/base/check.h"
#include "core/image/image_io.h"
#include "core/image/levels.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <jerror.h>
#include <jpeglib.h>

namespace oversketch {

namespace {

struct EncodeJob {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  std::jmp_buf failed;
  unsigned char* bytes;
  unsigned long size;
};

[[noreturn]] void fail_encoding(j_common_ptr info) {
  std::longjmp(static_cast<EncodeJob*>(info->client_data)->failed, 1);
}

void ignore_warning(j_common_ptr) {}

bool start(EncodeJob& job, JDIMENSION width, JDIMENSION height, int quality) {
  job.info.err = jpeg_std_error(&job.errors);
  job.errors.error_exit = fail_encoding;
  job.errors.output_message = ignore_warning;
  job.info.client_data = &job;
  if (setjmp(job.failed)) return false;
  jpeg_create_compress(&job.info);
  jpeg_mem_dest(&job.info, &job.bytes, &job.size);
  job.info.image_width = width;
  job.info.image_height = height;
  job.info.input_components = 3;
  job.info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&job.info);
  jpeg_set_quality(&job.info, quality, TRUE);
  // Colour at full resolution (4:4:4): outlines of strongly coloured parts stay sharp.
  job.info.comp_info[0].h_samp_factor = 1;
  job.info.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&job.info, TRUE);
  return true;
}

bool write_row(EncodeJob& job, unsigned char* row) {
  if (setjmp(job.failed)) return false;
  JSAMPROW rows[1] = {row};
  jpeg_write_scanlines(&job.info, rows, 1);
  return true;
}

bool finish(EncodeJob& job) {
  if (setjmp(job.failed)) return false;
  jpeg_finish_compress(&job.info);
  return true;
}

bool encode(EncodeJob& job, const Image& image, int quality) {
  if (!start(job, static_cast<JDIMENSION>(image.width()), static_cast<JDIMENSION>(image.height()), quality))
    return false;
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(image.width()) * 4);
  for (int y = 0; y < image.height(); ++y) {
    to_levels8(image.pixels().row(y), rgba);
    for (std::size_t i = 4, to = 3; i < rgba.size(); i += 4, to += 3)
      std::copy_n(rgba.data() + i, 3, rgba.data() + to);
    if (!write_row(job, rgba.data())) return false;
  }
  return finish(job);
}

} // namespace

Result<std::vector<std::byte>> encode_jpeg(const Image& image, int quality) {
  CHECK(quality >= 1 && quality <= 100, "JPEG quality is 1 to 100");
  if (const auto checked = check_exportable(image); !checked) return checked.error();
  if (image.width() > JPEG_MAX_DIMENSION || image.height() > JPEG_MAX_DIMENSION)
    return Error{"image.too-large",
                 "A JPEG has at most " + std::to_string(JPEG_MAX_DIMENSION) + " pixels a side: save it as a PNG.", ""};
  const auto close = [](EncodeJob* job) {
    jpeg_destroy_compress(&job->info);
    std::free(job->bytes);
    delete job;
  };
  const std::unique_ptr<EncodeJob, decltype(close)> job(new EncodeJob{}, close);
  if (!encode(*job, image, quality)) {
    std::array<char, JMSG_LENGTH_MAX> message{};
    job->errors.format_message(reinterpret_cast<j_common_ptr>(&job->info), message.data());
    return Error{"image.encode", std::string("The JPEG could not be made: ") + message.data() + ".", ""};
  }
  const auto* bytes = reinterpret_cast<const std::byte*>(job->bytes);
  return std::vector<std::byte>(bytes, bytes + job->size);
}

} // namespace oversketch
