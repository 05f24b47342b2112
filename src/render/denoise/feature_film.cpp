#include "render/denoise/feature_film.h"

#include "materials/direction_sampling.h"
#include "render/camera/camera_view.h"
#include "render/camera/pixel_rays.h"
#include "render/integrators/path_integrator.h"

#include <omp.h>

namespace candela {

namespace {

/// Specular surfaces in a row that a path follows; the features are those of the next one.
constexpr int kMaxSpecular = 8;
/// Share of specular scattering from which on a surface is followed.
constexpr float kSpecular = 0.999f;

struct Features {
  vec3 albedo{0}, normal{0}, position{0};
};

class FeatureTracer {
public:
  FeatureTracer(const RenderScene& scene, const PathSettings& path)
      : scene_(scene), direction_sampling_(path.direction_sampling) {
    Bounds3 bounds = scene.geometry().finite_bounds();
    if (bounds.empty()) return;
    center_ = bounds.center();
    extent_ = std::max(glm::length(bounds.diagonal()), std::numeric_limits<float>::min());
  }

  /// The sampler stands at the ray's sample; its numbers take the features through glass the way that the
  /// image's path goes. `media` are the ray's, in scenes with any. Textures are filtered over the cone, as in
  /// the image.
  Features trace(Ray ray, const MediumStack& media, const RayCone& pixel, Sampler& sampler) const {
    Features seen;
    vec3 tint(1);
    RayCounts ignored;
    MediaPassage passage{media, Spectrum(1)};
    ConeOfRay seen_along{pixel, ray.origin};
    const ConeOfRay* cone = scene_.filters_textures() ? &seen_along : nullptr;
    for (int depth = 1;; ++depth) {
      sampler.set_bounce(static_cast<std::uint32_t>(depth));
      Hit hit;
      if (!intersect_scene(scene_, ray, sampler, hit, ignored, scene_.has_priorities() ? &passage : nullptr,
                           cone)) {
        seen.albedo = seen.normal = vec3(0);
        seen.position = ray.direction; // farther than the whole scene, so that it differs
        return seen;
      }
      SurfaceInteraction surface = scene_.geometry().surface(ray, hit);
      vec3 wo = -ray.direction;
      const bool outside = glm::dot(surface.geometric_normal, wo) > 0;
      const SurfaceMaterial& material = facing(scene_.material(surface.material), outside);
      auto texture_at = [&] { return texture_point(scene_, ray, hit, cone, material.asks_place); };
      BlendArena blends;
      Bsdf bsdf =
          material.textured != nullptr ? evaluate_bsdf(material, texture_at(), blends) : material.bsdf;
      set_outside(scene_, material, passage.media, outside, bsdf);
      const vec3 normal = shading_normal_at(material, scene_, ray, hit, surface, cone);
      Basis frame = Basis::from_normal(normal);
      vec3 wo_local = frame.to_local(wo);
      // Lamps are told from what is around them by a reflectance in [0, 1], however bright they are.
      vec3 emission = emission_at(material, texture_at);
      emission /= 1 + max_component(emission);
      seen.albedo = tint * (bsdf_albedo(bsdf) + emission);
      seen.normal = outside ? normal : -normal;
      seen.position = (surface.position - center_) / extent_;
      if (depth > kMaxSpecular || bsdf_delta_probability(bsdf, wo_local) < kSpecular) return seen;
      vec2 u = sampler.get_2d(Dimension::bsdf_direction);
      auto s = sample_direction(bsdf, wo_local, vec3(u, sampler.get_1d(Dimension::bsdf_lobe)),
                                direction_sampling_);
      if (!s) return seen;
      tint *= glm::min(s->weight, 1.0f);
      vec3 wi = frame.to_world(s->wi);
      if (!same_hemisphere(wo_local, s->wi)) passage.media.cross(material.media, outside);
      ray = {offset_ray_origin(surface.position, surface.position_error, surface.geometric_normal, wi), 0, wi,
             kInfinity, ray.time};
      if (cone != nullptr) seen_along = seen_along.after(surface.position, 0);
    }
  }

private:
  const RenderScene& scene_;
  DirectionSampling direction_sampling_;
  vec3 center_{0};
  float extent_ = 1;
};

} // namespace

FeatureFilm::FeatureFilm(int width, int height, ivec2 origin)
    : width_(width), height_(height), origin_(origin),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void FeatureFilm::resolve(NoisyImage& albedo, NoisyImage& normal, NoisyImage& position) const {
  const auto n = static_cast<float>(spp_);
  const float count[2] = {std::ceil(n / 2), std::floor(n / 2)};
  NoisyImage* images[] = {&albedo, &normal, &position};
  for (std::size_t g = 0; g < 3; ++g) {
    for (Image* image : {&images[g]->half[0], &images[g]->half[1], &images[g]->variance})
      *image = {width_, height_, std::vector<vec3>(pixels_.size())};
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const Pixel& p = pixels_[i];
        const std::size_t k = 3 * g + c;
        const auto axis = static_cast<glm::length_t>(c);
        for (std::size_t h = 0; h < 2; ++h) images[g]->half[h].pixels[i][axis] = p.sum[h][k] / count[h];
        const float sum = p.sum[0][k] + p.sum[1][k];
        images[g]->variance.pixels[i][axis] =
            std::max(p.sum_of_squares[k] - sum * sum / n, 0.0f) / (n * (n - 1));
      }
  }
}

bool render_features(const RenderScene& scene, const Document& document, std::uint32_t spp, FeatureFilm& film,
                     const std::atomic<bool>& stop, int threads) {
  if (spp <= film.spp_) return true;
  const PixelRays rays(document);
  const CameraView view(document.scene.camera, document.settings.film.width, document.settings.film.height);
  const FeatureTracer tracer(scene, document.settings.path);
  const MediaNear camera_media(scene, view.position());
  bool stopped = false;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads > 0 ? threads : omp_get_num_procs())       \
    reduction(||                                                                                             \
              : stopped)
  for (int y = 0; y < film.height_; ++y) {
    if (stop.load(std::memory_order_relaxed)) {
      stopped = true;
      continue;
    }
    Sampler sampler = PixelRays::sampler(document.settings.sampler);
    for (int x = 0; x < film.width_ && !stopped; ++x) {
      stopped = stop.load(std::memory_order_relaxed);
      FeatureFilm::Pixel& p =
          film.pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width_) +
                       static_cast<std::size_t>(x)];
      for (std::uint32_t i = film.spp_; i < spp; ++i) {
        const auto start = rays.start(uvec2(film.origin_ + ivec2(x, y)), i, sampler);
        if (!start) continue; // black
        const vec3 origin = start->ray.origin,
                   direction = rays.motion().direction_at_start(start->ray.direction, start->ray.time);
        const Features f = tracer.trace(start->ray, camera_media.at(origin, start->ray.time),
                                        view.pixel_cone(direction), sampler);
        const vec3* groups[] = {&f.albedo, &f.normal, &f.position};
        for (std::size_t k = 0; k < FeatureFilm::kChannels; ++k) {
          float v = start->weight * (*groups[k / 3])[static_cast<glm::length_t>(k % 3)];
          if (!std::isfinite(v)) v = 0; // a degenerate triangle's normal
          p.sum[i % 2][k] += v;
          p.sum_of_squares[k] += v * v;
        }
      }
    }
  }
  film.spp_ = spp;
  return !stopped;
}

} // namespace candela
