#pragma once
// Attributes of CS123 XML elements, and the materials of objects.

#include "io/files/xml_place.h"
#include "io/obj/mtl_reader.h"

#include <initializer_list>

namespace candela {

/// The values of a file's elements. All throw input_error at the attribute or element.
class Cs123Values {
public:
  Cs123Values(const XmlPlaces& places, WarningList& warnings) : places_(places), warnings_(warnings) {}

  /// The first existing attribute, as a finite number.
  std::optional<float> optional_number(pugi::xml_node node, std::initializer_list<const char*> names) const;
  float number(pugi::xml_node node, std::initializer_list<const char*> names) const;
  /// x y z (or v1 v2 v3, a b c).
  vec3 vector(pugi::xml_node node) const;
  /// r g b (or x y z); not negative.
  vec3 color(pugi::xml_node node) const;
  /// `text` as a number of `node`.
  float parse(std::string_view text, pugi::xml_node node, const Location& where) const;

  void ignore(pugi::xml_node node) const;
  const XmlPlaces& places() const { return places_; }
  WarningList& warnings() const { return warnings_; }

private:
  const XmlPlaces& places_;
  WarningList& warnings_;
};

/// Factors of globaldata.
struct Cs123Coefficients {
  float diffuse = 1, specular = 1, transparent = 1;
};

/// The material that the children of a primitive describe, if any. `folder` is the scene's, for textures.
std::optional<MtlMaterial> cs123_material(pugi::xml_node object, const Cs123Values& values,
                                          const Cs123Coefficients& global, const PathPolicy& policy,
                                          const std::string& folder);

} // namespace candela
