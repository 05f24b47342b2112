#pragma once
// The Document is everything that decides an image; RenderSettings is the part of it that is not the scene.
// The settings table at the bottom is the only list of settings: the command line, the panels, scene files,
// the README and validation all iterate it.

#include "imaging/display_settings.h"
#include "imaging/view.h"
#include "materials/material_choice.h"
#include "sampling/direction_type.h"
#include "sampling/filter_type.h"
#include "sampling/sampler_type.h"
#include "scene/scene_desc.h"

namespace candela {

enum class Integrator : int { path, direct, whitted, ao };
enum class LightSampling : int { bsdf, nee, mis };
enum class LightChoiceBy : int { power, contribution };
enum class MisHeuristic : int { balance, power };
enum class RussianRoulette : int { off, throughput, fixed };
enum class PathComponent : int { all, emitted, direct, indirect };
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

struct AmbientOcclusionSettings {
  float distance = 0; ///< scene units within which a surface occludes; 0: any
  bool operator==(const AmbientOcclusionSettings&) const = default;
};

/// Terms follow Mitsuba: depths count path segments.
struct PathSettings {
  LightSampling light_sampling = LightSampling::mis;
  MisHeuristic mis_heuristic = MisHeuristic::power;
  int light_samples = 1; ///< shadow rays a vertex
  LightChoiceBy light_choice = LightChoiceBy::contribution;
  DirectionSampling direction_sampling = DirectionSampling::bsdf;
  int max_depth = -1; ///< 1: emitters seen directly, 2: direct light, -1: no limit
  RussianRoulette rr = RussianRoulette::throughput;
  int rr_depth = 1; ///< the segment after which Russian roulette starts
  /// Of rr = throughput: what carries less than this continues with the probability throughput / threshold.
  float rr_threshold = 0.35f;
  float rr_probability = 0.9f; ///< chance to go on, of rr = fixed
  PathComponent component = PathComponent::all;
  int only_depth = 0; ///< show paths of this many segments alone; 0: all
  /// Paths that go on from the first surface that is not specular, but for a pixel's first sample.
  int split = 2;
  float clamp = 0; ///< largest value of a sample's channel; 0: off (it biases)
  bool operator==(const PathSettings&) const = default;
};

/// One material for the whole scene: its type and values; emission and opacity stay each surface's own.
struct OverrideSettings {
  int brdf = 0; ///< 0: none; else one more than the index of the material's type
  MaterialChoice values;
  OverrideSettings();
  bool operator==(const OverrideSettings&) const = default;

  bool is_on() const { return brdf > 0; }
};

/// Blocks of pixels whose error is small stop early; the means of those that stop by luck are biased.
struct AdaptiveSettings {
  float error = 0;  ///< relative error of a block at which it stops; 0: every pixel gets all samples
  int min_spp = 16; ///< before any stops
  bool operator==(const AdaptiveSettings&) const = default;
};

/// When a render is finished; 0 switches a criterion off.
struct StopSettings {
  int spp = 64;
  float time = 0;  ///< seconds of rendering
  float noise = 0; ///< relative error of the image, the square root of its estimated relMSE
  bool operator==(const StopSettings&) const = default;
};

struct RenderSettings {
  FilmSettings film;
  SamplerSettings sampler;
  Integrator integrator = Integrator::path;
  PathSettings path;
  AmbientOcclusionSettings ao;
  AdaptiveSettings adaptive;
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

/// The material that all surfaces get where the override is on.
Material overriding_material(const OverrideSettings& settings);

/// `--set KEY=VALUE`; usage errors name the nearest key or the row's domain.
void apply_setting(Document& document, std::string_view assignment);

/// The heaviest consequence of turning `before` into `after`.
Invalidates compare_documents(const Document& before, const Document& after);

/// Equality that looks into meshes and textures.
bool same_content(const Document& a, const Document& b);

/// Why nothing can be seen through the camera: a value outside of its row ("vertical_fov: …"), or a view that
/// goes nowhere; empty if all is well.
std::string camera_value_problem(const Camera& camera);

/// The first field of the document that breaks its row ("path.max_depth: …"), or a material index, texture
/// index or mesh index out of range, or a bookmark without a name of its own; empty when all is well.
std::string document_problem(const Document& document);

} // namespace candela
