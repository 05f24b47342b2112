#include "app/compare_command.h"

#include "core/error.h"
#include "io/image_file.h"
#include "render/compare.h"

#include <fmt/format.h>

#include <cstdio>

namespace candela {

int run_compare(const std::string& a, const std::string& b, const std::optional<std::string>& diff_path) {
  // Before the work, so that a mistyped name costs none.
  if (diff_path && is_linear_format(image_format_of(*diff_path)))
    throw usage_error(fmt::format("--diff {}", *diff_path), "the differences are an 8-bit picture",
                      "use .png, .jpg or .ppm");
  Image image = read_image(a), reference = read_image(b);
  if (image.width != reference.width || image.height != reference.height)
    throw input_error({a}, "image",
                      fmt::format("it has {} x {} pixels, {} has {} x {}", image.width, image.height, b,
                                  reference.width, reference.height),
                      "compare pictures of one size");
  std::string json = comparison_json(compare_images(image, reference));
  if (diff_path)
    write_srgb8_image(image.width, image.height, relative_error_picture(image, reference), *diff_path);
  fmt::print("{}\n", json);
  return 0;
}

} // namespace candela
