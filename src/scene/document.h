#pragma once
// The Document is everything that decides an image; RenderSettings is the part of it that is not the scene.
// The settings table at the bottom is the only list of settings: the command line, the panels, scene files,
// the README and validation all iterate it.

#include "sampling/direction_type.h"
#include "sampling/sampler_type.h"
#include "scene/scene_desc.h"

namespace candela {

enum class FilterType : int { box, gaussian };
enum class LightSampling : int { bsdf, nee, mis };
enum class MisHeuristic : int { balance, power };
enum class RussianRoulette : int { off, throughput, fixed };
enum class PathComponent : int { all, emitted, direct, indirect };
enum class View : int { radiance, albedo, normal, depth };
enum class BrdfOverride : int { none, diffuse, phong, ggx, mirror, dielectric };
enum class ToneMap : int { reinhard, filmic, srgb };

struct FilmSettings {
  int width = 512;
  int height = 512;
  FilterType filter = FilterType::box;
  float filter_radius =
      0.5f; ///< pixels, half the filter's full width (the gaussian's sigma is a third of it)
  bool operator==(const FilmSettings&) const = default;
};

struct SamplerSettings {
  SamplerType type = SamplerType::sobol;
  int seed = 0;
  int strata = 4; ///< a side, of the stratified sampler
  bool operator==(const SamplerSettings&) const = default;
};

/// Terms follow Mitsuba: depths count path segments.
struct PathSettings {
  LightSampling light_sampling = LightSampling::mis;
  MisHeuristic mis_heuristic = MisHeuristic::power;
  int light_samples = 1; ///< shadow rays a vertex
  DirectionSampling direction_sampling = DirectionSampling::bsdf;
  int max_depth = -1; ///< 1: emitters seen directly, 2: direct light, -1: no limit
  RussianRoulette rr = RussianRoulette::throughput;
  int rr_depth = 3;            ///< the segment after which Russian roulette starts
  float rr_probability = 0.9f; ///< chance to go on, of rr = fixed
  PathComponent component = PathComponent::all;
  float clamp = 0; ///< largest value of a sample's channel; 0: off (it biases)
  bool operator==(const PathSettings&) const = default;
};

/// One material for the whole scene: its type and parameters; emission stays each surface's own.
struct OverrideSettings {
  BrdfOverride brdf = BrdfOverride::none;
  vec3 diffuse{0.5f};
  vec3 specular{0.9f};
  float exponent = 40;
  float roughness = 0.3f;
  float ior = 1.5f;
  bool operator==(const OverrideSettings&) const = default;
};

/// When a render is finished; 0 switches a criterion off.
struct StopSettings {
  int spp = 64;
  float time = 0; ///< seconds of rendering
  bool operator==(const StopSettings&) const = default;
};

/// How the picture is shown and written to 8-bit files; never changes the accumulation.
struct DisplaySettings {
  ToneMap tone_map = ToneMap::srgb;
  float exposure = 0;    ///< stops (powers of two)
  float white_point = 4; ///< luminance that extended Reinhard maps to white
  bool operator==(const DisplaySettings&) const = default;
};

struct RenderSettings {
  FilmSettings film;
  SamplerSettings sampler;
  PathSettings path;
  OverrideSettings override_brdf;
  View view = View::radiance;
  StopSettings stop;
  DisplaySettings display;
  bool operator==(const RenderSettings&) const = default;
};

struct Document {
  SceneDesc scene;
  RenderSettings settings;
  bool operator==(const Document&) const = default;
};

/// The settings table (the camera's values among them).
std::span<const Field<Document>> settings_table();
const Field<Document>* find_setting(std::string_view key);

/// `--set KEY=VALUE`; usage errors name the nearest key or the row's domain.
void apply_setting(Document& document, std::string_view assignment);

/// The heaviest consequence of turning `before` into `after`.
Invalidates compare_documents(const Document& before, const Document& after);

/// Equality that looks into meshes and textures.
bool same_content(const Document& a, const Document& b);

/// The first field of the document that breaks its row ("path.max_depth: …"), or a material index, texture
/// index or mesh index out of range; empty when all is well.
std::string document_problem(const Document& document);

} // namespace candela
