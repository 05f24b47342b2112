#include "app/cli/compare_command.h"

#include "app/console/outputs.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "imaging/compare.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

namespace candela {

int run_compare(const std::string& a, const std::string& b, const std::optional<std::string>& diff_path) {
  // Checked first, so that a mistyped name costs no time.
  if (diff_path && is_linear_format(image_format_of(*diff_path)))
    throw usage_error(fmt::format("--diff {}", *diff_path), "the differences are an 8-bit picture",
                      "use .png, .jpg or .ppm");
  check_stdout();
  if (diff_path) check_outputs({{"--diff", *diff_path}}, {a, b});
  Image image = read_image(a), reference = read_image(b);
  if (image.width != reference.width || image.height != reference.height)
    throw input_error({a}, "image",
                      fmt::format("it has {} x {} pixels, {} has {} x {}", image.width, image.height, b,
                                  reference.width, reference.height),
                      "compare pictures of one size");
  std::string json = comparison_json(compare_images(image, reference));
  OutputWriter writer;
  if (diff_path)
    writer.attempt(*diff_path, [&] {
      write_srgb8_image(image.width, image.height, relative_error_picture(image, reference), *diff_path);
    });
  print_result(json + "\n");
  return static_cast<int>(writer.code());
}

} // namespace candela
