#include "io/images/texels_reader.h"

#include "io/files/apart.h"
#include "io/images/image_codec.h"

#include <filesystem>

namespace candela {

namespace {

bool ends_in_tga(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending == ".tga";
}

Texels texels_of(Picture8 picture) { return {picture.width, picture.height, 3, std::move(picture.rgb)}; }

Texels texels_of(const Image& image) {
  std::vector<float> values;
  values.reserve(3 * image.pixels.size());
  for (vec3 pixel : image.pixels) values.insert(values.end(), {pixel.x, pixel.y, pixel.z});
  return {image.width, image.height, 3, std::move(values)};
}

Texels decode(ByteView bytes, const std::string& path, ProgressPart* progress, WarningList& warnings) {
  const Location where{path};
  if (is_stb_format(bytes)) return decode_stb_texels(bytes, where);
  if (is_jpg(bytes)) return texels_of(decode_jpg(bytes, where, progress));
  if (is_pnm(bytes)) return decode_pnm_texels(bytes, where, progress);
  if (ends_in_tga(path)) return decode_stb_texels(bytes, where, true);
  Image image = decode_image(bytes, where, progress, &warnings);
  make_finite(image, where, warnings);
  return texels_of(image);
}

} // namespace

std::shared_ptr<const Texels> read_texels(const std::string& path) {
  WarningList nobody;
  return read_texels(path, nobody);
}

std::shared_ptr<const Texels> read_texels(const std::string& path, WarningList& warnings) {
  warnings.check_stop();
  auto bytes = std::make_shared<const Bytes>(read_file_bytes(path, "image", &warnings.progress()));
  ProgressPart progress = warnings.part(path, bytes->size());
  Texels texels = run_apart(&progress, &warnings, [bytes, path](ProgressPart* part, WarningList* said) {
    return with_fewest_channels(decode(*bytes, path, part, *said));
  });
  return std::make_shared<const Texels>(std::move(texels));
}

} // namespace candela
