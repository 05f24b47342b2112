#pragma once
// What a scene is made of: values, cheap to copy (bulk data is shared), edited by the UI and the command
// line.

#include "core/fields.h"
#include "scene/mesh.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace candela {

enum class Projection : int { perspective, orthographic };

/// A pinhole, or a thin lens when aperture_radius > 0.
struct Camera {
  vec3 position{0, 0, 5};
  vec3 target{0, 0, 0};
  vec3 up{0, 1, 0};
  float vertical_fov = radians(45.0f); ///< radians, of the full image height
  Projection projection = Projection::perspective;
  float orthographic_height = 2; ///< scene units, of the full image height
  float aspect = 0;              ///< width over height of the view; 0: that of the film, pixels are square
  float aperture_radius = 0;     ///< scene units; 0: pinhole
  int blades = 0;                ///< sides of the aperture's polygon; below 3: round
  float blade_rotation = 0;      ///< radians
  float focus_distance = 0;      ///< scene units along the view axis; 0: the distance to the target
  bool operator==(const Camera&) const = default;

  float effective_focus_distance() const {
    return focus_distance > 0 ? focus_distance : glm::length(target - position);
  }
};

enum class MaterialType : int { diffuse, phong, ggx, mirror, dielectric };

/// One flat struct for every type, so that a live switch of the type keeps what both types know.
struct Material {
  std::string name;
  MaterialType type = MaterialType::diffuse;
  vec3 diffuse{0.5f};              ///< Lambertian reflectance (diffuse, phong, mirror)
  int diffuse_texture = -1;        ///< index into SceneDesc::textures, multiplies `diffuse`; -1: none
  vec3 specular{0};                ///< specular reflectance; at normal incidence for ggx (F0)
  float exponent = 40;             ///< of the Phong lobe
  float roughness = 0.3f;          ///< of ggx: alpha = roughness^2
  float ior = 1.5f;                ///< of dielectric, inside over outside
  vec3 transmittance{1};           ///< of dielectric: tint of each crossing of the surface
  vec3 absorption{0};              ///< of dielectric: sigma_a, 1/scene unit (Beer-Lambert)
  float opacity = 1;               ///< share of light that meets the surface at all
  vec3 emission{0};                ///< radiance, W/(m^2 sr)
  bool two_sided_emission = false; ///< otherwise only from the side of the geometric normal
  bool operator==(const Material&) const = default;
};

enum class LightType : int { point, directional, constant };

/// A light without a shape; shapes shine by their material's emission.
struct LightDesc {
  std::string name;
  LightType type = LightType::point;
  vec3 position{0};         ///< of point
  vec3 direction{0, -1, 0}; ///< the light travels along it, of directional; any length
  /// point: intensity, W/sr; directional: irradiance on a surface facing it, W/m^2; constant: radiance,
  /// W/(m^2 sr)
  vec3 color{1};
  float scale = 1; ///< multiplies color
  bool operator==(const LightDesc&) const = default;
};

struct SphereShape { ///< of the given radius about the origin of its instance
  float radius = 1;
  bool operator==(const SphereShape&) const = default;
};
struct RectangleShape { ///< [-1, 1]^2 in the xy plane, normal +z, as in Mitsuba
  bool operator==(const RectangleShape&) const = default;
};
struct DiscShape { ///< unit disc in the xy plane, normal +z
  bool operator==(const DiscShape&) const = default;
};
using Shape = std::variant<std::shared_ptr<const Mesh>, SphereShape, RectangleShape, DiscShape>;

/// A shape somewhere in the scene. Several instances may share one mesh.
struct Instance {
  std::string name;
  Shape shape;
  mat4 world_from_object{1.0f};
  std::vector<int> materials; ///< by the mesh's material slot; one entry for the other shapes
  bool operator==(const Instance&) const = default;
};

/// A view to come back to.
struct Bookmark {
  std::string name;
  Camera camera;
  bool operator==(const Bookmark&) const = default;
};

struct SceneDesc {
  Camera camera;
  std::vector<Bookmark> bookmarks;
  std::vector<Material> materials;
  std::vector<LightDesc> lights;
  std::vector<Instance> instances;
  std::vector<std::shared_ptr<const Texture>> textures;
  bool operator==(const SceneDesc&) const = default; ///< meshes and textures by identity
};

/// Rows of the editable values; names, transforms and texture links are not in them.
std::span<const Field<Material>> material_fields();
std::span<const Field<LightDesc>> light_fields();

/// Whether a material (light) of this type looks at the field: panels show only these.
bool material_uses(MaterialType type, std::string_view key);
bool light_uses(LightType type, std::string_view key);

} // namespace candela
