#include "render/world/render_scene.h"

#include "core/error.h"
#include "render/world/texture_lookup.h"

#include <array>
#include <map>

namespace candela {

namespace {

Bsdf make_bsdf(MaterialType type, vec3 diffuse, vec3 specular, float exponent, float roughness, float ior,
               vec3 transmittance) {
  switch (type) {
  case MaterialType::diffuse: return Diffuse{diffuse};
  // No reflection gives back more than it got: where both lobes ask for more than 1, the diffuse one gives
  // in.
  case MaterialType::phong: return Phong{glm::min(diffuse, 1.0f - specular), specular, exponent};
  case MaterialType::ggx: return Ggx{specular, roughness};
  case MaterialType::mirror: return Mirror{specular, glm::min(diffuse, 1.0f - specular)};
  case MaterialType::dielectric: return Dielectric{ior, transmittance};
  }
  return Diffuse{diffuse};
}

/// First `rotation` about +y, then the smallest turn that takes +y to `up`.
mat3 world_from_panorama(const LightDesc& light) {
  glm::dvec3 up = glm::normalize(glm::dvec3(light.up)), y(0, 1, 0), axis = glm::cross(y, up);
  double sine = glm::length(axis), tilt = std::atan2(sine, up.y);
  axis = sine > 0 ? axis / sine : glm::dvec3(1, 0, 0);
  glm::dmat4 turn = glm::rotate(glm::dmat4(1), tilt, axis);
  return mat3(glm::rotate(turn, static_cast<double>(light.rotation), y));
}

MaterialType override_type(BrdfOverride o) { return static_cast<MaterialType>(static_cast<int>(o) - 1); }

} // namespace

Bsdf make_bsdf(const Material& m) {
  return make_bsdf(m.type, m.diffuse, m.specular, m.exponent, m.roughness, m.ior, m.transmittance);
}

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
  scene->materials_ = SceneMaterials::of(document, previous != nullptr ? previous->materials_ : nullptr);
  scene->lights_ = SceneLights::of(document, scene->geometry_, scene->materials_,
                                   previous != nullptr ? previous->lights_ : nullptr, progress);
  return scene;
}

void SceneMaterials::add_materials(const Document& document) {
  const OverrideSettings& o = document.settings.override_brdf;
  for (const Material& m : document.scene.materials) {
    SurfaceMaterial s;
    if (o.brdf != BrdfOverride::none) {
      // A mirror reflects, and nothing else.
      const vec3 diffuse = o.brdf == BrdfOverride::mirror ? vec3(0) : o.diffuse;
      s.bsdf = make_bsdf(override_type(o.brdf), diffuse, o.specular, o.exponent, o.roughness, o.ior, vec3(1));
    } else {
      s.bsdf = make_bsdf(m);
      if (m.diffuse_texture >= 0)
        s.diffuse_texture = textures_[static_cast<std::size_t>(m.diffuse_texture)].get();
      s.diffuse_uv = m.diffuse_uv;
    }
    s.opacity = m.opacity;
    s.emission = m.emission;
    s.emissive = !is_black(m.emission);
    s.two_sided_emission = m.two_sided_emission;
    has_transparency_ |= m.opacity < 1;
    materials_.push_back(s);
  }
  if (o.brdf == BrdfOverride::none) add_media(document.scene.materials);
}

void SceneMaterials::add_media(const std::vector<Material>& materials) {
  auto is_body = [](const Material& m) { return m.type == MaterialType::dielectric; };
  if (std::ranges::none_of(materials,
                           [&](const Material& m) { return is_body(m) && !is_black(m.absorption); }))
    return;
  std::map<std::array<float, 3>, std::uint16_t> known;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!is_body(materials[i])) continue;
    const vec3 a = materials[i].absorption;
    const auto [entry, is_new] =
        known.try_emplace({a.x, a.y, a.z}, static_cast<std::uint16_t>(media_.size()));
    if (is_new) media_.emplace_back(AbsorbingMedium{a});
    if (media_.size() >= MediumId::kNone)
      throw Error(ExitCode::limit, "materials: there are more than 65534 different absorptions: use fewer");
    materials_[i].media.inside.index = entry->second;
  }
}

void SceneLights::add_emitters(const Progress* progress) {
  // A path that meets a partly transparent light by chance sees it with the chance of its opacity; aiming at
  // it must expect the same.
  auto aimed = [](const SurfaceMaterial& m) { return m.emission * m.opacity; };
  bool any = false;
  for (const SurfaceMaterial& m : materials_) any |= m.emissive;
  if (!any) return;
  const Geometry& g = *geometry_;
  light_of_emitter_.reset(g.emitter_count());
  auto add = [&](std::uint64_t emitter, Light light) {
    light_of_emitter_.set(emitter, static_cast<std::uint32_t>(lights_.size()));
    lights_.push_back(light);
  };
  auto add_triangle = [&](std::uint64_t emitter, vec3 p0, vec3 p1, vec3 p2, vec3 outside,
                          const SurfaceMaterial& m) {
    vec3 c = glm::cross(p1 - p0, p2 - p0);
    float double_area = glm::length(c);
    if (!(double_area > 0)) return; // no ray meets it either
    vec3 n = c / double_area;
    if (glm::dot(n, outside) < 0) n = -n;
    add(emitter, TriangleLight{p0, p1 - p0, p2 - p0, n, 0.5f * double_area, aimed(m), m.two_sided_emission});
  };

  for (const RectangleGeometry& r : g.rectangles()) {
    const SurfaceMaterial& m = materials_[g.world().materials[r.first_triangle]];
    // Sheared ones are left to their triangles below.
    float lengths = glm::length(r.edge_x) * glm::length(r.edge_y);
    if (!m.emissive || std::abs(glm::dot(r.edge_x, r.edge_y)) > 1e-6f * lengths) continue;
    if (!(length_squared(glm::cross(r.edge_x, r.edge_y)) > 0)) continue;
    add(r.first_triangle, RectangleLight(r.corner, r.edge_x, r.edge_y, aimed(m), m.two_sided_emission));
    light_of_emitter_.set(r.first_triangle + 1, light_of_emitter_[r.first_triangle]);
  }
  const TriangleSet& world = g.world();
  for (std::uint32_t i = 0; i < world.triangles.size(); ++i) {
    check_now_and_then(progress, i);
    const SurfaceMaterial& m = materials_[world.materials[i]];
    if (!m.emissive || light_of_emitter_[i] != kNoLight) continue;
    uvec3 t = world.triangles[i];
    vec3 p0 = world.positions[t.x], p1 = world.positions[t.y], p2 = world.positions[t.z];
    add_triangle(i, p0, p1, p2, glm::cross(p1 - p0, p2 - p0), m);
  }
  for (std::size_t i = 0; i < g.spheres().size(); ++i)
    if (const SurfaceMaterial& m = materials_[g.sphere_materials()[i]]; m.emissive)
      add(g.sphere_emitter(i),
          SphereLight{g.spheres()[i].center, g.spheres()[i].radius, aimed(m), m.two_sided_emission});
  for (std::size_t i = 0; i < g.discs().size(); ++i)
    if (const SurfaceMaterial& m = materials_[g.disc_materials()[i]]; m.emissive)
      add(g.disc_emitter(i), DiscLight{g.discs()[i].center, g.discs()[i].normal, g.discs()[i].radius,
                                       aimed(m), m.two_sided_emission});
  for (const Geometry::Placed& p : g.placed()) {
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
                   transform_point(w, p2), outside, m);
    }
  }
}

const EnvironmentMap* SceneLights::environment_map(const LightDesc& light, const SceneLights* previous,
                                                   const Progress* progress) {
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
  for (const LightDesc& l : lights) {
    vec3 color = l.color * l.scale;
    if (is_black(color)) continue;
    bool infinite = l.type == LightType::constant || l.type == LightType::environment;
    if (infinite) infinite_lights_.push_back(static_cast<std::uint32_t>(lights_.size()));
    switch (l.type) {
    case LightType::point: lights_.emplace_back(PointLight{l.position, color, l.attenuation}); break;
    case LightType::spot:
      lights_.emplace_back(SpotLight{l.position, glm::normalize(l.direction),
                                     std::min(l.beam_width, l.cutoff_angle), l.cutoff_angle, color,
                                     l.attenuation});
      break;
    case LightType::directional:
      lights_.emplace_back(DirectionalLight{glm::normalize(l.direction), color});
      break;
    case LightType::constant: lights_.emplace_back(ConstantLight{color}); break;
    case LightType::environment:
      if (l.panorama)
        lights_.emplace_back(
            EnvironmentLight{environment_map(l, previous, progress), world_from_panorama(l), color});
      else
        lights_.emplace_back(ConstantLight{color});
      break;
    }
  }
}

std::size_t RenderScene::memory_bytes() const {
  return geometry_->memory_bytes() + materials_->memory_bytes() + lights_->memory_bytes();
}

Bsdf evaluate_bsdf(const SurfaceMaterial& material, vec2 uv) {
  Bsdf bsdf = material.bsdf;
  vec3 texel =
      lookup_bilinear(*material.diffuse_texture, material.diffuse_uv.scale * uv + material.diffuse_uv.offset);
  if (auto* d = std::get_if<Diffuse>(&bsdf))
    d->reflectance *= texel;
  else if (auto* p = std::get_if<Phong>(&bsdf))
    p->diffuse *= texel;
  else if (auto* m = std::get_if<Mirror>(&bsdf))
    m->diffuse *= texel;
  return bsdf;
}

} // namespace candela
