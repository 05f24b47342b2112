#pragma once
// The Document determines an image completely; RenderSettings is its part besides the scene. The settings
// table below is the only list of settings: the command line, the panels, scene files, the README and
// validation all iterate it.

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
/// How places in media are chosen for light that is scattered once towards the camera.
enum class MediumSampling : int { mis, distance, equiangular };
enum class MisHeuristic : int { balance, power };
enum class RussianRoulette : int { off, throughput, fixed };
enum class PathComponent : int { all, emitted, direct, indirect };
/// Where the factors of light groups act: on layers of the film, in the finished picture, or on the lights.
enum class LightGroupsIn : int { film, scene };
struct FilmSettings {
  int width = 512;
  int height = 512;
  FilterType filter = FilterType::box;
  float filter_radius =
      0.5f; ///< pixels, half the filter's full width (the gaussian's sigma is a third of it)
  LightGroupsIn light_groups = LightGroupsIn::film; ///< light_layers.h has where the film cannot
  bool operator==(const FilmSettings&) const = default;
};

struct SamplerSettings {
  SamplerType type = SamplerType::sobol;
  int seed = 0;
  int strata = 4; ///< a side, of the stratified sampler
  bool operator==(const SamplerSettings&) const = default;
};

struct AmbientOcclusionSettings {
  float distance = 0; ///< scene units within which surfaces occlude; 0: any
  bool operator==(const AmbientOcclusionSettings&) const = default;
};

/// Terms follow Mitsuba: depths count path segments.
struct PathSettings {
  LightSampling light_sampling = LightSampling::mis;
  MisHeuristic mis_heuristic = MisHeuristic::power;
  int light_samples = 1; ///< shadow rays per vertex
  LightChoiceBy light_choice = LightChoiceBy::contribution;
  DirectionSampling direction_sampling = DirectionSampling::bsdf;
  MediumSampling medium_sampling = MediumSampling::mis;
  TransmittanceEstimator transmittance = TransmittanceEstimator::residual;
  int max_depth = -1; ///< 1: emitters seen directly, 2: direct light, -1: no limit
  RussianRoulette rr = RussianRoulette::throughput;
  int rr_depth = 1; ///< the segment after which Russian roulette starts
  /// For rr = throughput: paths with less throughput continue with the probability throughput / threshold.
  float rr_threshold = 0.35f;
  float rr_probability = 0.9f; ///< probability to continue, for rr = fixed
  PathComponent component = PathComponent::all;
  int only_depth = 0; ///< show only paths of this many segments; 0: all
  /// Number of paths that continue from the first surface that is not specular (path splitting); a pixel's
  /// first sample is not split.
  int split = 2;
  /// Reflected rays leave smooth meshes from the curved surface that their vertices' normals describe.
  bool smooth_terminator = false;
  float clamp = 0; ///< largest channel of a sample; 0: off (clamping is biased)
  bool operator==(const PathSettings&) const = default;
};

/// One material for the whole scene: type and values; surfaces keep their emission and opacity.
struct OverrideSettings {
  int brdf = 0; ///< 0: none; else one more than the index of the material's type
  MaterialChoice values;
  OverrideSettings();
  bool operator==(const OverrideSettings&) const = default;

  bool is_on() const { return brdf > 0; }
};

/// Blocks of pixels with a small error stop early, which biases the result slightly.
struct AdaptiveSettings {
  float error = 0;  ///< relative error at which a block stops; 0: every pixel gets all samples
  int min_spp = 16; ///< before a block may stop
  bool operator==(const AdaptiveSettings&) const = default;
};

/// Stopping criteria of a render; 0 disables one.
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

/// The material of all surfaces if the override is on.
Material overriding_material(const OverrideSettings& settings);

/// Applies KEY=VALUE, as of `--set`; usage errors name the nearest key or the row's domain.
void apply_setting(Document& document, std::string_view assignment);

/// The strongest consequence of changing `before` to `after`.
Invalidates compare_documents(const Document& before, const Document& after);

/// Equality that compares meshes and textures by value.
bool same_content(const Document& a, const Document& b);

/// Why the camera is invalid: a value out of range ("vertical_fov: …"), or a view without a direction; empty
/// if it is valid.
std::string camera_value_problem(const Camera& camera);

/// The same of its motion alone, of a camera that is valid at time 0: "key: cause; remedy".
std::string camera_motion_problem(const Camera& camera);

/// The first problem of the document: a value out of range ("path.max_depth: …"), an index of a material,
/// texture or mesh out of range, invalid pixels, or a bookmark without a unique name; empty if it is valid.
std::string document_problem(const Document& document);

} // namespace candela
