#pragma once
// Numbers, colours and pictures as Mitsuba means them.

#include "lights/panorama.h"
#include "support/mitsuba_xml.h"

#include <map>
#include <memory>

namespace candela::test::mitsuba_xml {

/// Names of the indices of refraction that the scenes use, as Mitsuba has them.
inline float ior(const Node& bsdf, std::string_view name, const char* otherwise) {
  static const std::map<std::string, float> known = {{"air", 1.000277f},
                                                     {"bk7", 1.5046f},
                                                     {"diamond", 2.419f},
                                                     {"polypropylene", 1.49f},
                                                     {"water", 1.3330f}};
  const std::string value = text(bsdf, name, otherwise);
  const auto found = known.find(value);
  return found != known.end() ? found->second : numbers(value).at(0);
}
inline float relative_ior(const Node& bsdf, const char* inside) {
  return ior(bsdf, "int_ior", inside) / ior(bsdf, "ext_ior", "air");
}

/// A constant colour. Spectra that are tabulated are known by their values alone, as Mitsuba 3.9.1 converts
/// them.
inline vec3 color_of(const Node& node) {
  static const std::map<std::string, vec3> tabulated = {
      {"400:0.78, 500:0.78, 600:0.78, 700:0.78", {0.776368f, 0.779809f, 0.776029f}},
      {"400:0, 500:8, 600:15.6, 700:18.4", {20.7108f, 10.8546f, 2.77115f}}};
  const std::string value = node.attribute("value").value();
  const auto found = tabulated.find(value);
  return found != tabulated.end() ? found->second : three(value);
}

/// Mitsuba's first and last rows lie at the poles, ours half a row away from them: the picture between its
/// rows.
inline std::shared_ptr<const Panorama> with_rows_of_mitsuba(const Panorama& panorama) {
  constexpr int kFiner = 8;
  const Image& from = panorama.image;
  auto out = std::make_shared<Panorama>(panorama);
  Image& to = out->image;
  to.height = kFiner * from.height;
  to.pixels.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  for (int y = 0; y < to.height; ++y) {
    const float row =
        (static_cast<float>(y) + 0.5f) / static_cast<float>(to.height) * static_cast<float>(from.height - 1);
    const int above = std::min(static_cast<int>(row), from.height - 2);
    for (int x = 0; x < to.width; ++x)
      to.at(x, y) = glm::mix(from.at(x, above), from.at(x, above + 1), row - static_cast<float>(above));
  }
  return out;
}

} // namespace candela::test::mitsuba_xml
