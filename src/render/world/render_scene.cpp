#include "render/world/render_scene.h"

#include "core/error.h"
#include "sampling/warp.h"

#include <array>
#include <map>
#include <set>

namespace candela {

std::shared_ptr<const RenderScene> RenderScene::build(const Document& document, const RenderScene* previous,
                                                      Progress* progress) {
  const std::vector<Instance>& instances = document.scene.instances;
  const bool same = previous != nullptr && previous->instances() == instances;
  return build(document,
               same ? previous->geometry_ : Geometry::build(instances, BuildQuality::high, progress),
               previous, progress);
}

std::shared_ptr<const RenderScene> RenderScene::build(const Document& document,
                                                      std::shared_ptr<const Geometry> geometry,
                                                      const RenderScene* previous, Progress* progress) {
  auto scene = std::make_shared<RenderScene>();
  const bool same_geometry = previous != nullptr && previous->geometry_ == geometry;
  scene->geometry_ = std::move(geometry);
  scene->instances_ = same_geometry ? previous->instances_
                                    : std::make_shared<const std::vector<Instance>>(document.scene.instances);
  scene->materials_ =
      SceneMaterials::of(document, previous != nullptr ? previous->materials_ : nullptr, progress);
  scene->surfaces_ = scene->materials_->data();
  scene->has_transparency_ = scene->materials_->has_transparency();
  scene->filters_textures_ = scene->materials_->filters_textures();
  scene->has_media_ = !scene->materials_->media().empty();
  scene->lights_ = SceneLights::of(document, scene->geometry_, scene->materials_,
                                   previous != nullptr ? previous->lights_ : nullptr, progress);
  return scene;
}

void SceneMaterials::add_materials(const Document& document, const MipPyramidSource& pyramids) {
  const OverrideSettings& o = document.settings.override_brdf;
  const Material overriding = o.is_on() ? overriding_material(o) : Material();
  std::vector<const Material*> scattering; // what each surface scatters by
  for (const Material& own : document.scene.materials) {
    if (o.is_on()) {
      Material m = own;
      m.model = overriding.model;
      materials_.add(m, textures_, pyramids);
    } else {
      materials_.add(own, textures_, pyramids);
    }
    scattering.push_back(o.is_on() ? &overriding : &own);
    has_transparency_ |= own.opacity.value < 1 || own.opacity.is_textured();
  }
  add_media(scattering);
}

void SceneMaterials::add_media(const std::vector<const Material*>& materials) {
  auto absorbs = [](const Material* m) {
    const auto absorption = inside_absorption(m->model);
    return absorption && !is_black(*absorption);
  };
  if (std::ranges::none_of(materials, absorbs)) return;
  std::map<std::array<float, 3>, std::uint16_t> known;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const std::optional<vec3> a = inside_absorption(materials[i]->model);
    if (!a) continue;
    const auto [entry, is_new] =
        known.try_emplace({a->x, a->y, a->z}, static_cast<std::uint16_t>(media_.size()));
    if (is_new) media_.emplace_back(AbsorbingMedium{*a});
    if (media_.size() >= MediumId::kNone)
      throw Error(ExitCode::limit, "materials: there are more than 65534 different absorptions: use fewer");
    materials_[i].media.inside.index = entry->second;
  }
}

namespace {

/// What light sampling expects of a surface: of one with textures, what `mean` says. A path that meets a
/// partly transparent light sees it with the probability of its opacity; sampling the light must expect the
/// same.
template <class Mean>
vec3 expected_radiance(const SurfaceMaterial& m, Mean mean) {
  return has_textured_radiance(m) ? mean() : m.emission * m.opacity;
}

/// Texture coordinates of a sphere, of a disc, by equal areas of the unit square.
vec2 sphere_coordinates(vec2 q) { return {q.x, 1 - std::acos(1 - 2 * q.y) * kInvPi}; }
vec2 disc_coordinates(vec2 q) { return 0.5f * sample_uniform_disc(q) + 0.5f; }

} // namespace

void SceneLights::add_emitter(std::uint64_t emitter, const SurfaceMaterial& material, Light light) {
  const auto index = static_cast<std::uint32_t>(lights_.size());
  light_of_emitter_.set(emitter, index);
  lights_.push_back(light);
  if (!has_textured_radiance(material)) return;
  emitter_textures_.resize(index + 1);
  emitter_textures_[index] = {emitter, &material};
}

void SceneLights::add_emitters(const SceneLights* previous, const Progress* progress) {
  bool any = false;
  for (const SurfaceMaterial& m : materials_) any |= m.emissive;
  if (!any) return;
  const Geometry& g = *geometry_;
  light_of_emitter_.reset(g.emitter_count());
  auto add_triangle = [&](std::uint64_t emitter, vec3 p0, vec3 p1, vec3 p2, vec3 outside,
                          const SurfaceMaterial& m, Hit hit) {
    vec3 c = glm::cross(p1 - p0, p2 - p0);
    float double_area = glm::length(c);
    if (!(double_area > 0)) return; // no ray meets it either
    vec3 n = c / double_area;
    if (glm::dot(n, outside) < 0) n = -n;
    auto mean = [&] {
      return mean_radiance_of_triangle(m, [&](vec2 barycentric) {
        hit.u = barycentric.x, hit.v = barycentric.y;
        return g.uv({}, hit);
      });
    };
    add_emitter(emitter, m,
                TriangleLight{p0, p1 - p0, p2 - p0, n, 0.5f * double_area, expected_radiance(m, mean),
                              m.two_sided_emission});
  };
  auto triangle_hit = [](std::uint32_t primitive, std::uint32_t instance) {
    Hit hit;
    hit.kind = PrimitiveKind::triangle, hit.primitive = primitive, hit.instance = instance;
    return hit;
  };

  for (const RectangleGeometry& r : g.rectangles()) {
    const SurfaceMaterial& m = materials_[g.world().materials[r.first_triangle]];
    // Sheared ones are left to their triangles below.
    float lengths = glm::length(r.edge_x) * glm::length(r.edge_y);
    if (!m.emissive || std::abs(glm::dot(r.edge_x, r.edge_y)) > 1e-6f * lengths) continue;
    if (!(length_squared(glm::cross(r.edge_x, r.edge_y)) > 0)) continue;
    const EmissionTable* table =
        has_textured_radiance(m) ? &emission_table(m, r, previous, progress) : nullptr;
    add_emitter(r.first_triangle, m,
                RectangleLight(r.corner, r.edge_x, r.edge_y,
                               expected_radiance(m, [&] { return table->mean; }), m.two_sided_emission,
                               table != nullptr ? table->grid.get() : nullptr));
    light_of_emitter_.set(r.first_triangle + 1, light_of_emitter_[r.first_triangle]);
  }
  const TriangleSet& world = g.world();
  for (std::uint32_t i = 0; i < world.triangles.size(); ++i) {
    check_now_and_then(progress, i);
    const SurfaceMaterial& m = materials_[world.materials[i]];
    if (!m.emissive || light_of_emitter_[i] != kNoLight) continue;
    uvec3 t = world.triangles[i];
    vec3 p0 = world.positions[t.x], p1 = world.positions[t.y], p2 = world.positions[t.z];
    add_triangle(i, p0, p1, p2, glm::cross(p1 - p0, p2 - p0), m, triangle_hit(i, kNoInstance));
  }
  for (std::size_t i = 0; i < g.spheres().size(); ++i)
    if (const SurfaceMaterial& m = materials_[g.sphere_materials()[i]]; m.emissive)
      add_emitter(g.sphere_emitter(i), m,
                  SphereLight{g.spheres()[i].center, g.spheres()[i].radius,
                              expected_radiance(m, [&] { return mean_radiance(m, sphere_coordinates); }),
                              m.two_sided_emission});
  for (std::size_t i = 0; i < g.discs().size(); ++i)
    if (const SurfaceMaterial& m = materials_[g.disc_materials()[i]]; m.emissive)
      add_emitter(g.disc_emitter(i), m,
                  DiscLight{g.discs()[i].center, g.discs()[i].normal, g.discs()[i].radius,
                            expected_radiance(m, [&] { return mean_radiance(m, disc_coordinates); }),
                            m.two_sided_emission});
  for (std::uint32_t instance = 0; instance < g.placed().size(); ++instance) {
    const Geometry::Placed& p = g.placed()[instance];
    auto shines = [&](std::uint32_t material) { return materials_[material].emissive; };
    if (std::ranges::none_of(p.slot_materials, shines)) continue;
    const TriangleSet& set = g.objects()[p.object]->set;
    for (std::uint32_t i = 0; i < set.triangles.size(); ++i) {
      check_now_and_then(progress, i);
      const SurfaceMaterial& m = materials_[p.slot_materials[set.materials[i]]];
      if (!m.emissive) continue;
      uvec3 t = set.triangles[i];
      vec3 p0 = set.positions[t.x], p1 = set.positions[t.y], p2 = set.positions[t.z];
      vec3 outside = p.normal_to_world * glm::cross(p1 - p0, p2 - p0);
      const mat4& w = p.world_from_object;
      add_triangle(p.first_emitter + i, transform_point(w, p0), transform_point(w, p1),
                   transform_point(w, p2), outside, m, triangle_hit(i, instance));
    }
  }
}

const EmissionTable& SceneLights::emission_table(const SurfaceMaterial& material,
                                                 const RectangleGeometry& rectangle,
                                                 const SceneLights* previous, const Progress* progress) {
  const TriangleSet& world = geometry_->world();
  const bool mirrored = world.uvs[world.triangles[rectangle.first_triangle].x].x > 0.5f;
  auto fits = [&](const RectangleEmission& known) {
    return known.mirrored == mirrored && emits_alike(*known.material, material);
  };
  auto own = std::ranges::find_if(emission_tables_, fits);
  if (own != emission_tables_.end()) return *own->table;
  std::shared_ptr<const EmissionTable> table;
  if (previous != nullptr) {
    auto known = std::ranges::find_if(previous->emission_tables_, fits);
    if (known != previous->emission_tables_.end()) table = known->table;
  }
  if (!table) table = std::make_shared<const EmissionTable>(tabulate_emission(material, mirrored, progress));
  emission_tables_.push_back({&material, mirrored, table});
  return *table;
}

const EnvironmentMap* SceneLights::environment_map(const EnvironmentLightModel& light,
                                                   const SceneLights* previous, const Progress* progress) {
  auto fits = [&](const auto& map) {
    return map->panorama() == light.panorama && map->mapping() == light.mapping;
  };
  auto own = std::ranges::find_if(environment_maps_, fits);
  if (own != environment_maps_.end()) return own->get();
  std::shared_ptr<const EnvironmentMap> map;
  if (previous != nullptr) {
    auto known = std::ranges::find_if(previous->environment_maps_, fits);
    if (known != previous->environment_maps_.end()) map = *known;
  }
  if (!map) map = std::make_shared<const EnvironmentMap>(light.panorama, light.mapping, progress);
  environment_maps_.push_back(map);
  return map.get();
}

void SceneLights::add_lights(const std::vector<LightDesc>& lights, const SceneLights* previous,
                             const Progress* progress) {
  const EnvironmentMapSource maps = [&](const EnvironmentLightModel& m) {
    return environment_map(m, previous, progress);
  };
  for (const LightDesc& desc : lights) {
    if (is_black(desc.color * desc.scale)) continue;
    const Light light = make_light(desc, maps);
    if (light_kind(light) == LightKind::infinite)
      infinite_lights_.push_back(static_cast<std::uint32_t>(lights_.size()));
    lights_.push_back(light);
  }
}

std::size_t RenderScene::memory_bytes() const {
  return geometry_->memory_bytes() + materials_->memory_bytes() + lights_->memory_bytes();
}

} // namespace candela
