#include "render/integrators/subsurface_probe.h"

#include "core/basis.h"
#include "media/diffusion_profile.h"
#include "render/integrators/medium_way.h"
#include "render/world/surface_relief.h"

namespace candela {

namespace {

/// Probabilities of the disc's axes: the tangents, and the normal.
constexpr vec3 kAxisProbability(0.25f, 0.25f, 0.5f);

/// Divides u in [0, 1) among probabilities that add up to 1; u becomes uniform again.
int choose_of_three(vec3 probability, float& u) {
  int i = 0;
  while (i < 2 && u >= probability[i]) u -= probability[i++];
  while (!(probability[i] > 0)) --i; // rounding
  u = std::clamp(u / probability[i], 0.0f, 1 - 0x1p-24f);
  return i;
}

template <class Profile, class Make>
ProfileChannels<Profile> profile_channels(const Subsurface& bsdf, Make make) {
  const Spectrum a = bsdf.plastic.diffuse, length = bsdf.mean_free_path;
  return {{make(a.x, length.x), make(a.y, length.y), make(a.z, length.z)}, a};
}

} // namespace

/// All that a ray meets that light may leave by.
void SubsurfaceProbe::find(const RenderScene& scene, const SubsurfacePoint& entry, Ray ray,
                           RayCounts& counts) {
  constexpr int kMostSurfaces = 1024; // two coincident ones could catch it for ever
  const Geometry& geometry = scene.geometry();
  const std::uint32_t material = geometry.material_of(entry.hit);
  const vec3 end = ray.at(ray.t_max);
  found_.clear();
  for (int i = 0; i < kMostSurfaces; ++i) {
    Hit hit;
    ++counts.closest;
    if (!geometry.accel().intersect(ray, hit)) return;
    if (hit.instance == entry.hit.instance && geometry.material_of(hit) == material)
      found_.push_back({ray, hit});
    const SurfaceInteraction s = geometry.surface(ray, hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    ray.t_max = glm::dot(end - ray.origin, ray.direction);
    if (!(ray.t_max > 0)) return;
  }
}

template <class Profile>
std::optional<SubsurfaceExit> SubsurfaceProbe::sample_by(const Profile& profile, const RenderScene& scene,
                                                         const SubsurfacePoint& entry, const Subsurface& bsdf,
                                                         Spectrum channels, vec2 probe_u, vec2 point_u,
                                                         RayCounts& counts) {
  const Basis frame = Basis::from_normal(entry.normal);
  const std::array<vec3, 3> axes{frame.to_world({1, 0, 0}), frame.to_world({0, 1, 0}), entry.normal};
  const auto channel = static_cast<std::size_t>(choose_of_three(channels, probe_u.x));
  const auto axis = static_cast<std::size_t>(choose_of_three(kAxisProbability, probe_u.x));

  const float end = profile.channel[channel].end();
  const float r = std::min(profile.channel[channel].sample(point_u.x), end), phi = 2 * kPi * point_u.y;
  const float half = safe_sqrt(sqr(end) - sqr(r));
  const vec3 along = axes[axis];
  const vec3 offset = r * (std::cos(phi) * axes[(axis + 1) % 3] + std::sin(phi) * axes[(axis + 2) % 3]);
  find(scene, entry, {entry.position + offset + half * along, 0, -along, 2 * half, entry.time}, counts);
  if (found_.empty()) return std::nullopt;
  const auto count = static_cast<float>(found_.size());
  const Found& chosen = found_[std::min(static_cast<std::size_t>(probe_u.y * count), found_.size() - 1)];

  SubsurfaceExit exit;
  exit.surface = scene.geometry().surface(chosen.ray, chosen.hit);
  exit.side = entry.side > 0 ? 1.0f : -1.0f;
  const vec3 away = exit.surface.position - entry.position, normal = exit.surface.geometric_normal;
  const float distance2 = glm::dot(away, away), distance = std::sqrt(distance2);
  float pdf = 0; // by area of the surface
  for (std::size_t a = 0; a < 3; ++a) {
    const float projected = safe_sqrt(distance2 - sqr(glm::dot(away, axes[a])));
    float on_disc = 0;
    for (std::size_t c = 0; c < 3; ++c)
      if (const float p = channels[static_cast<int>(c)]; p > 0 && distance < profile.channel[c].end())
        on_disc += p * profile.channel[c].pdf(projected);
    pdf += kAxisProbability[static_cast<int>(a)] * std::abs(glm::dot(normal, axes[a])) * on_disc;
  }
  if (!(pdf > 0)) return std::nullopt;
  exit.weight = profile.value(distance) * (count / pdf);
  const SurfaceMaterial& material = facing(scene.material(exit.surface.material), exit.side > 0);
  exit.normal = shading_normal_at(material, scene, chosen.ray, chosen.hit, exit.surface);
  exit.bsdf = bsdf;
  exit.bsdf.part = Subsurface::Part::exit;
  return exit;
}

std::optional<SubsurfaceExit> SubsurfaceProbe::sample(const RenderScene& scene, const SubsurfacePoint& entry,
                                                      const Subsurface& bsdf, Spectrum throughput,
                                                      vec2 probe_u, vec2 point_u, RayCounts& counts) {
  const Spectrum leaves = throughput * bsdf.plastic.diffuse;
  if (is_black(leaves)) return std::nullopt;
  const Spectrum channels = channel_probabilities(leaves);
  if (bsdf.method == SubsurfaceMethod::burley) {
    const auto profile = profile_channels<BurleyProfile>(
        bsdf, [](float albedo, float length) { return BurleyProfile(albedo, length); });
    return sample_by(profile, scene, entry, bsdf, channels, probe_u, point_u, counts);
  }
  const auto profile = profile_channels<DipoleProfile>(
      bsdf, [&](float albedo, float length) { return DipoleProfile(albedo, length, bsdf.plastic.ior); });
  return sample_by(profile, scene, entry, bsdf, channels, probe_u, point_u, counts);
}

} // namespace candela
