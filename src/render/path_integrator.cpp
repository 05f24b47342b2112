#include "render/path_integrator.h"

#include "bsdf/direction_sampling.h"

namespace candela {

namespace {

/// More transparent surfaces in a row than any scene has end the ray: two coincident ones could catch it for
/// ever.
constexpr std::uint32_t kMaxCrossings = 1024;

/// Ray from a surface point towards w (unit).
Ray spawn_ray(const Surface& s, vec3 w) {
  return {offset_ray_origin(s.position, s.position_error, s.geometric_normal, w), 0, w, kInfinity};
}

/// Share of the light that comes through between a surface point and a light sample: 0 or 1, or the product
/// of what the transparent surfaces between let pass.
float visibility(const RenderScene& scene, const Surface& from, const LightSample& light, RayCounts& counts) {
  const Accel& accel = scene.geometry().accel();
  Ray ray = spawn_ray(from, light.direction);
  vec3 target(0);
  if (!light.infinite) {
    // Both ends are moved off their surfaces by their error bounds, so what is left must be free but for what
    // the distance adds to the rounding of t.
    target = offset_ray_origin(light.point, light.point_error, light.point_normal, -light.direction);
    ray.direction = target - ray.origin;
    ray.t_max = 1 - gamma_bound(16);
  }
  if (!scene.has_transparency()) {
    ++counts.shadow;
    return accel.occluded(ray) ? 0.0f : 1.0f;
  }
  float through = 1;
  for (std::uint32_t i = 0; i < kMaxCrossings; ++i) {
    ++counts.shadow;
    auto hit = accel.intersect(ray);
    if (!hit) return through;
    through *= 1 - scene.material(scene.geometry().material_of(*hit)).opacity;
    if (through <= 0) return 0;
    Surface s = scene.geometry().surface(ray, *hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    if (!light.infinite) ray.direction = target - ray.origin;
  }
  return 0;
}

/// Weight of the strategy with density `mine` (> 0) against the other's (Veach 1997, section 9.2).
float heuristic(MisHeuristic how, float mine, float other) {
  float ratio = other / mine; // squares of densities could overflow, their ratio is what matters
  return 1 / (1 + (how == MisHeuristic::power ? ratio * ratio : ratio));
}

/// The walk's state and settings, so that its steps can be read one by one.
class PathTracer {
public:
  PathTracer(const RenderScene& scene, Sampler& sampler, const PathSettings& settings, RayCounts& counts)
      : scene_(scene), sampler_(sampler), settings_(settings), counts_(counts) {
    last_depth_ = settings.max_depth < 0 ? std::numeric_limits<int>::max() : settings.max_depth;
    if (settings.component == PathComponent::emitted) last_depth_ = std::min(last_depth_, 1);
    if (settings.component == PathComponent::direct) last_depth_ = std::min(last_depth_, 2);
  }

  /// With segments numbered by depth = 1, 2, ... the estimate is the sum over vertices of
  ///   throughput x (emission met by chance, weighted + light aimed at, weighted),
  /// throughput being the product of f |cos| / pdf and of 1 / survival so far.
  vec3 trace(Ray ray) {
    for (int depth = 1; depth <= last_depth_; ++depth) {
      sampler_.set_bounce(static_cast<std::uint32_t>(depth));
      Hit hit;
      if (!intersect_scene(scene_, ray, sampler_, hit, counts_)) {
        add_background(ray, depth);
        break;
      }
      Surface surface = scene_.geometry().surface(ray, hit);
      const SurfaceMaterial& material = scene_.material(surface.material);
      vec3 wo = -ray.direction;
      bool outside = glm::dot(wo, surface.geometric_normal) > 0;
      if (material.absorbing && !outside) // it came through the inside of this body (Beer-Lambert)
        throughput_ *= glm::exp(-material.absorption * glm::length(surface.position - previous_));
      if (material.emissive && (outside || material.two_sided_emission))
        add_emission(surface, material, ray, depth);
      if (depth == last_depth_ || !scatter(surface, material, wo, depth, ray)) break;
    }
    if (settings_.clamp > 0) radiance_ = glm::min(radiance_, settings_.clamp);
    return radiance_;
  }

private:
  bool wanted(int depth) const { // is light of paths of this length part of the component?
    switch (settings_.component) {
    case PathComponent::all: return true;
    case PathComponent::emitted: return depth == 1;
    case PathComponent::direct: return depth == 2;
    case PathComponent::indirect: return depth > 2;
    }
    return true;
  }

  /// Weight of a light met by chance, given the density (1/sr) with which aiming would have found it.
  float weight_by_chance(float aimed_pdf) const {
    if (arrived_by_delta_ || settings_.light_sampling == LightSampling::bsdf) return 1;
    if (settings_.light_sampling == LightSampling::nee) return 0;
    return heuristic(settings_.mis_heuristic, arrival_pdf_,
                     aimed_pdf * static_cast<float>(settings_.light_samples));
  }

  bool needs_aimed_pdf() const {
    return !arrived_by_delta_ && settings_.light_sampling == LightSampling::mis;
  }

  void add_background(const Ray& ray, int depth) {
    if (!wanted(depth)) return;
    for (std::uint32_t i : scene_.infinite_lights()) {
      const Light& light = scene_.lights()[i];
      float aimed = needs_aimed_pdf()
                        ? scene_.all_lights().pmf(i) * light_pdf(light, reference_, {}, ray.direction)
                        : 0;
      radiance_ += throughput_ * light_radiance(light, ray.direction) * weight_by_chance(aimed);
    }
  }

  void add_emission(const Surface& surface, const SurfaceMaterial& material, const Ray& ray, int depth) {
    if (!wanted(depth)) return;
    float aimed = 0;
    if (needs_aimed_pdf()) {
      std::uint32_t i = scene_.light_of(surface.emitter);
      if (i != kNoLight)
        aimed = scene_.all_lights().pmf(i) *
                light_pdf(scene_.lights()[i], reference_, surface.position, ray.direction);
    }
    radiance_ += throughput_ * material.emission * weight_by_chance(aimed);
  }

  /// Direct light at the vertex and the next direction; false where the path ends.
  bool scatter(const Surface& surface, const SurfaceMaterial& material, vec3 wo, int depth, Ray& ray) {
    Bsdf textured;
    const Bsdf* bsdf = &material.bsdf;
    if (material.diffuse_texture != nullptr) {
      textured = evaluate_bsdf(material, surface);
      bsdf = &textured;
    }
    Basis frame = Basis::from_normal(surface.shading_normal);
    vec3 wo_local = frame.to_local(wo);
    // Seen from a side from which the interpolated normal looks away: nothing sensible scatters there.
    float side = glm::dot(wo, surface.geometric_normal);
    if (wo_local.z * side <= 0) return false;
    reference_ = {surface.position, side > 0 ? surface.geometric_normal : -surface.geometric_normal};

    // A path that can still matter beyond this vertex? Only then is aiming worth a ray.
    if (wanted(depth + 1) && bsdf_delta_probability(*bsdf, wo_local) < 1)
      add_direct(surface, *bsdf, frame, wo_local);
    if (depth + 1 > last_depth_) return false;

    vec2 u = sampler_.get_2d(Dimension::bsdf_direction);
    auto s = sample_direction(*bsdf, wo_local, vec3(u, sampler_.get_1d(Dimension::bsdf_lobe)),
                              settings_.direction_sampling);
    if (!s) return false;
    vec3 wi = frame.to_world(s->wi);
    bool reflected = s->wi.z * wo_local.z > 0;
    // The interpolated normal may take a reflection through the surface, or a refraction back: no light
    // there.
    if ((glm::dot(wi, surface.geometric_normal) * side > 0) != reflected) return false;
    throughput_ *= s->weight;
    eta2_ *= sqr(s->eta);
    if (!survives(depth)) return false;

    arrived_by_delta_ = s->delta;
    arrival_pdf_ = s->pdf;
    previous_ = surface.position;
    ray = spawn_ray(surface, wi);
    return true;
  }

  void add_direct(const Surface& surface, const Bsdf& bsdf, const Basis& frame, vec3 wo_local) {
    // Point and directional lights can only be aimed at, so they are under every strategy.
    bool aim = settings_.light_sampling != LightSampling::bsdf;
    const AliasTable& table = aim ? scene_.all_lights() : scene_.delta_lights();
    if (table.empty()) return;
    auto n = static_cast<float>(settings_.light_samples);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(settings_.light_samples); ++i) {
      AliasTable::Sample choice =
          table.sample(table.size() > 1 ? sampler_.get_1d(Dimension::light_choice, i) : 0);
      auto light = sample_light(scene_.lights()[choice.index], reference_,
                                sampler_.get_2d(Dimension::light_position, i));
      if (!light || glm::dot(light->direction, reference_.normal) <= 0)
        continue; // all that is aimed from reflects
      vec3 wi_local = frame.to_local(light->direction);
      BsdfEval e = direction_eval_pdf(bsdf, wo_local, wi_local, settings_.direction_sampling);
      vec3 contribution = throughput_ * e.f_cos * light->radiance;
      if (is_black(contribution)) continue;
      float through = visibility(scene_, surface, *light, counts_);
      if (through == 0) continue;
      float pdf = choice.pmf * light->pdf;
      float weight = 1;
      if (!light->delta && settings_.light_sampling == LightSampling::mis)
        weight = heuristic(settings_.mis_heuristic, n * pdf, e.pdf);
      radiance_ += contribution * (through * weight / (pdf * n));
    }
  }

  /// Russian roulette (Arvo and Kirk 1990): going on with probability q and weight 1/q keeps the mean.
  bool survives(int depth) {
    // Nothing, or less than a normal float: rounding would keep denormals alive for ever where reflectance is
    // above 1/2.
    if (max_component(throughput_) < std::numeric_limits<float>::min()) return false;
    if (settings_.rr == RussianRoulette::off || depth < settings_.rr_depth) return true;
    float q = settings_.rr_probability;
    // Without the 1/eta^2 of refractions, which the way out of the glass gives back.
    if (settings_.rr == RussianRoulette::throughput) q = std::min(1.0f, max_component(throughput_) * eta2_);
    if (sampler_.get_1d(Dimension::russian_roulette) >= q) return false;
    throughput_ /= q;
    return true;
  }

  const RenderScene& scene_;
  Sampler& sampler_;
  const PathSettings& settings_;
  RayCounts& counts_;
  int last_depth_;

  vec3 radiance_{0};
  vec3 throughput_{1};
  float eta2_ = 1;
  // The last vertex: how the path left it.
  bool arrived_by_delta_ = true; ///< the camera cannot be aimed from
  float arrival_pdf_ = 0;        ///< 1/sr
  vec3 previous_{0};
  LightReference reference_;
};

} // namespace

bool intersect_scene(const RenderScene& scene, Ray& ray, const Sampler& sampler, Hit& hit,
                     RayCounts& counts) {
  const Accel& accel = scene.geometry().accel();
  for (std::uint32_t crossing = 0; crossing < kMaxCrossings; ++crossing) {
    ++counts.closest;
    auto found = accel.intersect(ray);
    if (!found) return false;
    hit = *found;
    if (!scene.has_transparency()) return true;
    float opacity = scene.material(scene.geometry().material_of(hit)).opacity;
    if (opacity >= 1 || sampler.get_1d(Dimension::opacity, crossing) < opacity) return true;
    Surface s = scene.geometry().surface(ray, hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
  }
  return false;
}

vec3 path_radiance(const RenderScene& scene, Ray ray, Sampler& sampler, const PathSettings& settings,
                   RayCounts& counts) {
  return PathTracer(scene, sampler, settings, counts).trace(ray);
}

vec3 view_value(const RenderScene& scene, Ray ray, vec3 forward, View view, Sampler& sampler,
                RayCounts& counts) {
  vec3 origin = ray.origin;
  sampler.set_bounce(1);
  Hit hit;
  if (!intersect_scene(scene, ray, sampler, hit, counts)) return vec3(0);
  Surface surface = scene.geometry().surface(ray, hit);
  switch (view) {
  case View::albedo: {
    const SurfaceMaterial& material = scene.material(surface.material);
    return bsdf_albedo(material.diffuse_texture ? evaluate_bsdf(material, surface) : material.bsdf);
  }
  case View::normal: {
    vec3 n = surface.shading_normal;
    if (glm::dot(surface.geometric_normal, ray.direction) > 0) n = -n;
    return 0.5f * n + 0.5f;
  }
  case View::depth: return vec3(glm::dot(surface.position - origin, forward));
  default: break;
  }
  return vec3(0);
}

} // namespace candela
