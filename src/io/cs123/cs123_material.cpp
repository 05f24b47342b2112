#include "io/cs123/cs123_material.h"

#include "io/files/text_file.h"
#include "io/obj/obj_line.h"

#include <fmt/format.h>

#include <charconv>

namespace candela {

float Cs123Values::parse(std::string_view text, pugi::xml_node node, const Location& where) const {
  std::string_view word = trimmed(text);
  if (check_real(word) != RealWord::good)
    throw input_error(where, node.name(), fmt::format("'{}' is no finite number", word.substr(0, 40)),
                      "give a decimal number");
  if (word.front() == '+') word.remove_prefix(1);
  double value = 0; // from_chars leaves 0 below the range of a double
  std::from_chars(word.data(), word.data() + word.size(), value);
  return static_cast<float>(value);
}

std::optional<float> Cs123Values::optional_number(pugi::xml_node node,
                                                  std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (auto attribute = node.attribute(name))
      return parse(attribute.value(), node, places_.attribute(attribute, node));
  return std::nullopt;
}

float Cs123Values::number(pugi::xml_node node, std::initializer_list<const char*> names) const {
  if (auto value = optional_number(node, names)) return *value;
  throw input_error(places_.element(node), node.name(),
                    fmt::format("the attribute {} is missing", *names.begin()),
                    fmt::format("write <{} {}=\"…\"/>", node.name(), fmt::join(names, " or ")));
}

vec3 Cs123Values::vector(pugi::xml_node node) const {
  float x = number(node, {"x", "v1", "a"}), y = number(node, {"y", "v2", "b"});
  return {x, y, number(node, {"z", "v3", "c"})};
}

vec3 Cs123Values::color(pugi::xml_node node) const {
  float r = number(node, {"r", "x"}), g = number(node, {"g", "y"}), b = number(node, {"b", "z"});
  if (std::min({r, g, b}) < 0)
    throw input_error(places_.element(node), node.name(), "a colour is negative", "give numbers from 0");
  return {r, g, b};
}

void Cs123Values::ignore(pugi::xml_node node) const {
  warnings_.add(places_.element(node),
                fmt::format("<{}> is ignored", std::string_view(node.name()).substr(0, 40)));
}

std::optional<MtlMaterial> cs123_material(pugi::xml_node object, const Cs123Values& values,
                                          const Cs123Coefficients& global, const PathPolicy& policy,
                                          const std::string& folder) {
  MtlMaterial out;
  Material& m = out.material;
  vec3 diffuse(0), specular(0), reflective(0), transparent(0);
  float exponent = PhongMaterial().exponent.value, ior = DielectricMaterial().ior.value;
  bool given = false;
  for (pugi::xml_node child : object.children()) {
    if (child.type() != pugi::node_element) continue;
    std::string_view name = child.name();
    bool known = true;
    if (name == "diffuse")
      diffuse = values.color(child) * global.diffuse;
    else if (name == "specular")
      specular = values.color(child) * global.specular;
    else if (name == "reflective" || name == "reflect")
      reflective = values.color(child) * global.specular;
    else if (name == "transparent")
      transparent = values.color(child) * global.transparent;
    else if (name == "emissive")
      m.emission = values.color(child);
    else if (name == "shininess" || name == "shine")
      exponent = glm::clamp(values.number(child, {"v", "value"}), 0.0f, 1e6f);
    else if (name == "ior")
      ior = glm::clamp(values.number(child, {"v", "value"}), 0.1f, 10.0f);
    else if (name == "texture") {
      auto file = child.attribute("file") ? child.attribute("file") : child.attribute("filename");
      const Location where = file ? values.places().attribute(file, child) : values.places().element(child);
      if (std::string_view(file.value()).empty())
        throw input_error(where, "texture", "it names no file", "write <texture file=\"…\"/>");
      auto repeats = [&](const char* axis) { return values.optional_number(child, {axis}).value_or(1); };
      TextureUse use = ColorParameter::standard_use();
      use.uv.scale = {repeats("u"), repeats("v")};
      out.textures.clear(); // only the last one is used
      if (auto found = policy.find_exported(file.value(), folder, where, "texture", values.warnings()))
        out.textures.push_back({"diffuse", std::move(*found), use, where});
      else
        values.warnings().add(where, fmt::format("the texture '{}' is missing: no texture",
                                                 utf8_name(std::string_view(file.value()).substr(0, 200))));
    } else {
      known = false;
      if (name != "ambient") values.ignore(child); // there is no ambient light to reflect
    }
    given |= known;
  }
  if (!given) return std::nullopt;

  auto clamped = [&](vec3 c) {
    if (max_component(c) > 1)
      values.warnings().add(values.places().element(object), "a reflectance above 1 is taken for 1");
    return glm::min(c, vec3(1));
  };
  const vec3 matte = clamped(!out.textures.empty() && is_black(diffuse) ? vec3(1) : diffuse);
  auto conserved = [&](vec3 gloss) {
    vec3 kept = matte;
    if (conserve_energy(kept, gloss))
      values.warnings().add(values.places().element(object),
                            "diffuse + specular is above 1: the diffuse part is reduced to 1 - specular");
    return kept;
  };
  if (!is_black(transparent)) {
    m.model = DielectricMaterial{ior};
    out.textures.clear();
  } else if (!is_black(reflective)) {
    const vec3 mirrored = clamped(reflective);
    m.model = MirrorMaterial{mirrored, conserved(mirrored)};
    if (!is_black(specular))
      values.warnings().add(values.places().element(object), "a mirror's highlight is ignored");
  } else if (!is_black(specular)) {
    const vec3 gloss = clamped(specular);
    m.model = PhongMaterial{conserved(gloss), gloss, exponent};
  } else {
    m.model = DiffuseMaterial{matte};
  }
  return out;
}

} // namespace candela
