#include "app/tools/texture_users.h"

#include "app/ui/item_list.h"

#include <algorithm>
#include <unordered_set>

namespace candela {

namespace {

ParameterLook look_of(const ParameterRef& parameter, const MaterialField& row) {
  ParameterLook look;
  look.use = parameter.use();
  look.is_number = parameter.number != nullptr;
  if (look.is_number)
    look.factor = vec3(parameter.number->value), look.offset = vec3(parameter.number->offset);
  else
    look.factor = parameter.color->value, look.offset = parameter.color->offset;
  look.lowest = static_cast<float>(row.minimum), look.highest = static_cast<float>(row.maximum);
  return look;
}

} // namespace

std::vector<TextureUser> texture_users(const SceneDesc& scene, int texture) {
  std::vector<TextureUser> users;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    each_parameter(scene.materials[i], [&](const MaterialField& row, const ParameterRef& parameter) {
      if (parameter.use().texture != texture || texture < 0) return;
      users.push_back(
          {{i, std::string(row.key)},
           fmt::format("{}: {}", name_or_number(scene.materials[i].name, "Material", i), field_label(row)),
           look_of(parameter, row)});
    });
  return users;
}

std::string texture_label(const SceneDesc& scene, int texture) {
  const auto index = static_cast<std::size_t>(texture);
  return name_or_number(scene.textures[index]->name, "Texture", index);
}

std::string texture_summary(const Texture& texture) {
  const ImageTexture* image = texture.image();
  if (image == nullptr) return std::string(texture_kind_names()[texture.model.index()]);
  const Texels& t = *image->texels;
  const std::string_view bits = std::visit(
      [](const auto& values) -> std::string_view {
        using T = typename std::decay_t<decltype(values)>::value_type;
        return std::is_floating_point_v<T> ? "float" : sizeof(T) == 1 ? "8 bits" : "16 bits";
      },
      t.data);
  return fmt::format("{} x {}, {} channel{}, {}", t.width, t.height, t.channels, t.channels == 1 ? "" : "s",
                     bits);
}

std::string bytes_text(std::size_t bytes) {
  constexpr double kKilo = 1000;
  const auto size = static_cast<double>(bytes);
  if (size < kKilo) return fmt::format("{} B", bytes);
  if (size < kKilo * kKilo) return fmt::format("{:.1f} kB", size / kKilo);
  if (size < kKilo * kKilo * kKilo) return fmt::format("{:.1f} MB", size / (kKilo * kKilo));
  return fmt::format("{:.2f} GB", size / (kKilo * kKilo * kKilo));
}

std::vector<UvEdge> uv_layout(const Mesh& mesh, std::size_t most) {
  std::vector<UvEdge> edges;
  if (mesh.uvs.empty()) return edges;
  std::unordered_set<std::uint64_t> known;
  for (const uvec3& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      const auto key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
      if (!known.insert(key).second) continue;
      if (edges.size() == most) return edges;
      edges.push_back({mesh.uvs[a], mesh.uvs[b]});
    }
  return edges;
}

} // namespace candela
