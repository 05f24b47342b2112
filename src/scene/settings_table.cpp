// The settings table: one row per setting, in the order in which the panels and the README show them.

#include "core/error.h"
#include "scene/camera_settings.h"
#include "scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace candela {

namespace {

constexpr std::string_view kFilters[] = {"box", "tent", "gaussian", "blackman_harris", "mitchell"};
constexpr std::string_view kSamplers[] = {"independent", "stratified", "halton",    "sobol",
                                          "pmj02",       "lattice",    "blue_noise"};
constexpr std::string_view kIntegrators[] = {"path", "direct", "whitted", "ao"};
constexpr std::string_view kLightSampling[] = {"bsdf", "nee", "mis"};
constexpr std::string_view kLightChoices[] = {"power", "contribution"};
constexpr std::string_view kHeuristics[] = {"balance", "power"};
constexpr std::string_view kDirections[] = {"uniform", "cosine", "bsdf"};
constexpr std::string_view kRoulette[] = {"off", "throughput", "fixed"};
constexpr std::string_view kComponents[] = {"all", "emitted", "direct", "indirect"};
constexpr std::string_view kMediumSamplings[] = {"mis", "distance", "equiangular"};
constexpr std::string_view kTransmittanceEstimators[] = {"residual", "ratio"};
constexpr std::string_view kLightGroups[] = {"film", "scene"};
/// "none", then the materials' types, without those that name other materials.
std::span<const std::string_view> override_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all{"none"};
    all.insert(all.end(), scattering_type_names().begin(), scattering_type_names().end());
    return all;
  }();
  return names;
}
constexpr std::string_view kViews[] = {
    "radiance", "albedo",   "normal",      "geometric_normal", "depth",    "optical_depth", "uv",
    "material", "bvh_cost", "depth_share", "light_share",      "variance", "samples",       "nonfinite"};
constexpr std::string_view kToneMaps[] = {"reinhard", "reinhard_simple", "filmic", "aces", "srgb"};
constexpr std::string_view kFalseColors[] = {"auto", "off", "viridis", "magma"};

constexpr auto kImage = Invalidates::image;

// NOLINTNEXTLINE(bugprone-macro-parentheses): a path of members
#define AT(member) [](Document& d) -> void* { return &d.member; }

/// All rows except those of the camera and of the override, which are derived from the materials' rows.
const Field<Document> kRows[] = {
    {{"sampler.type", FieldType::choice, 0, 0, "", "Where the random numbers come from", kImage, kSamplers},
     AT(settings.sampler.type)},
    {{"sampler.seed", FieldType::integer, 0, 2147483647, "", "Different seeds give independent noise"},
     AT(settings.sampler.seed)},
    {{"sampler.strata", FieldType::integer, 1, 64, "", "Strata a side of the stratified sampler"},
     AT(settings.sampler.strata)},

    {{"integrator", FieldType::choice, 0, 0, "",
      "Full paths; direct light alone; Whitted's ray tracing (direct light and perfect mirrors); ambient "
      "occlusion",
      kImage, kIntegrators},
     AT(settings.integrator)},
    {{"path.light_sampling", FieldType::choice, 0, 0, "",
      "How direct light is found: by BSDF sampling (bsdf), by light sampling (nee), or by both, weighted "
      "(mis)",
      kImage, kLightSampling},
     AT(settings.path.light_sampling)},
    {{"path.mis_heuristic", FieldType::choice, 0, 0, "", "Weights of mis", kImage, kHeuristics},
     AT(settings.path.mis_heuristic)},
    {{"path.light_samples", FieldType::integer, 1, 64, "", "Shadow rays at every vertex, for nee and mis"},
     AT(settings.path.light_samples)},
    {{"path.light_choice", FieldType::choice, 0, 0, "",
      "How one of several lights is sampled: by power, or by its estimated contribution to the point",
      Invalidates::scene, kLightChoices},
     AT(settings.path.light_choice)},
    {{"path.direction_sampling", FieldType::choice, 0, 0, "",
      "Density of the next direction: uniform, by the cosine, or by the material", kImage, kDirections},
     AT(settings.path.direction_sampling)},
    {{"path.medium_sampling", FieldType::choice, 0, 0, "",
      "Where on a ray through media lights are sampled: by distance (in proportion to what arrives at the "
      "eye), "
      "equiangular (near a sampled light), or both, combined by MIS",
      kImage, kMediumSamplings},
     AT(settings.path.medium_sampling)},
    {{"path.transmittance", FieldType::choice, 0, 0, "",
      "What light passes grids of smoke and clouds: estimated as it differs from the mean of each brick "
      "(residual tracking), or as a whole (ratio tracking)",
      Invalidates::scene, kTransmittanceEstimators},
     AT(settings.path.transmittance)},
    {{"path.max_depth", FieldType::integer, -1, 1000000, "segments",
      "Longest path: 1 shows only emitters, 2 also direct light; -1: no limit, except 1024 with path.rr = "
      "off (a limit loses light)"},
     AT(settings.path.max_depth)},
    {{"path.rr", FieldType::choice, 0, 0, "",
      "Russian roulette: off, by the path's throughput, or with a fixed probability; from 64 segments on a "
      "path continues with 0.99 at most, so that all end",
      kImage, kRoulette},
     AT(settings.path.rr)},
    {{"path.rr_depth", FieldType::integer, 0, 1000000, "segments", "Segments before Russian roulette starts"},
     AT(settings.path.rr_depth)},
    {{"path.rr_threshold", FieldType::real, 0.001, 1000, "",
      "Throughput below which a path may end, with path.rr = throughput"},
     AT(settings.path.rr_threshold)},
    {{"path.rr_probability", FieldType::real, 0.01, 1, "", "Probability to continue, with path.rr = fixed"},
     AT(settings.path.rr_probability)},
    {{"path.component", FieldType::choice, 0, 0, "", "Which part of the light is shown", kImage, kComponents},
     AT(settings.path.component)},
    {{"path.only_depth", FieldType::integer, 0, 1000000, "segments",
      "Shows only the light of paths of this length (1: emitters, 2: direct light, 3: one bounce); 0: all"},
     AT(settings.path.only_depth)},
    {{"path.split", FieldType::integer, 1, 64, "paths",
      "Number of paths that continue from the first surface that is not specular, each with its share of the "
      "weight; a pixel's first sample is not split, for an early picture"},
     AT(settings.path.split)},
    {{"path.smooth_terminator", FieldType::boolean, 0, 0, "",
      "Light leaves meshes with vertex normals from the curved surface that those describe, so that coarse "
      "ones "
      "show no facets where the light grazes them; off: from the triangles"},
     AT(settings.path.smooth_terminator)},
    {{"path.clamp",
      FieldType::real,
      0,
      1e9,
      "W/(m^2 sr)",
      "Largest channel of one sample; 0 is off (clamping loses light: the image is biased)",
      kImage,
      {},
      true},
     AT(settings.path.clamp)},

    {{"ao.distance",
      FieldType::real,
      0,
      1e9,
      "scene units",
      "Distance within which a surface occludes, of integrator = ao; 0: any",
      kImage,
      {},
      true},
     AT(settings.ao.distance)},
    {{"adaptive.error",
      FieldType::real,
      0,
      1,
      "",
      "Blocks of pixels stop at this relative error; 0: all get every sample (early stopping is biased)",
      kImage,
      {},
      true},
     AT(settings.adaptive.error)},
    {{"adaptive.min_spp", FieldType::integer, 2, 1000000, "samples",
      "Samples that every pixel gets before a block may stop"},
     AT(settings.adaptive.min_spp)},

    {{"film.width", FieldType::integer, 1, 16384, "pixels", "Width of the image"}, AT(settings.film.width)},
    {{"film.height", FieldType::integer, 1, 16384, "pixels", "Height of the image"},
     AT(settings.film.height)},
    {{"film.filter", FieldType::choice, 0, 0, "", "Pixel filter, sampled by importance", kImage, kFilters},
     AT(settings.film.filter)},
    {{"film.filter_radius", FieldType::real, 0.01, 8, "pixels",
      "Half the filter's full width: a box tiles the film at 0.5, a tent interpolates at 1; usual are "
      "1.5 for gaussian (sigma is a third of it), 1.5 to 2 for blackman_harris and 2 for mitchell"},
     AT(settings.film.filter_radius)},
    {{"film.light_groups", FieldType::choice, 0, 0, "",
      "Where light groups are switched, scaled and coloured: in layers of the film, in the finished picture, "
      "without a restart, or in the scene, whose samples then go where the light is",
      Invalidates::scene, kLightGroups},
     AT(settings.film.light_groups)},
    {{"view", FieldType::choice, 0, 0, "",
      "What a pixel shows: radiance, a property of the first surface, or a statistic of the render", kImage,
      kViews},
     AT(settings.view)},

    {{"stop.spp", FieldType::integer, 0, 1000000000, "samples", "Samples a pixel at which to stop; 0: never",
      Invalidates::nothing},
     AT(settings.stop.spp)},
    {{"stop.time", FieldType::real, 0, 1e9, "s", "Seconds of rendering at which to stop; 0: never",
      Invalidates::nothing},
     AT(settings.stop.time)},
    {{"stop.noise",
      FieldType::real,
      0,
      10,
      "",
      "Relative error of the image, the square root of its estimated relMSE, at which to stop; 0: never",
      Invalidates::nothing,
      {},
      true},
     AT(settings.stop.noise)},

    {{"display.tone_map", FieldType::choice, 0, 0, "",
      "Reinhard by luminance (extended by a white point, or simple), filmic curves, or sRGB encoding alone",
      Invalidates::display, kToneMaps},
     AT(settings.display.tone_map)},
    {{"display.exposure", FieldType::real, -20, 20, "stops", "Powers of two that multiply the picture",
      Invalidates::display},
     AT(settings.display.exposure)},
    {{"display.auto_exposure", FieldType::boolean, 0, 0, "",
      "Finds the exposure from the picture; display.exposure is added", Invalidates::display},
     AT(settings.display.auto_exposure)},
    {{"display.white_point",
      FieldType::real,
      0.01,
      1e6,
      "",
      "Luminance that Reinhard maps to white",
      Invalidates::display,
      {},
      true},
     AT(settings.display.white_point)},
    {{"display.false_color", FieldType::choice, 0, 0, "",
      "False colours of the luminance: for scalar views (auto), never, or always", Invalidates::display,
      kFalseColors},
     AT(settings.display.false_color)},
    {{"display.false_color_min", FieldType::real, -1e9, 1e9, "",
      "Value where the false colours begin, in the view's unit; both ends 0: found from the picture",
      Invalidates::display},
     AT(settings.display.false_color_min)},
    {{"display.false_color_max", FieldType::real, -1e9, 1e9, "",
      "Value where the false colours end; not above their beginning: found from the picture",
      Invalidates::display},
     AT(settings.display.false_color_max)},
    {{"display.denoise", FieldType::boolean, 0, 0, "",
      "Shows and writes the denoised picture, labelled as such (denoising is biased)", Invalidates::display},
     AT(settings.display.denoise)},
    {{"display.dither", FieldType::boolean, 0, 0, "",
      "Dithers the rounding to 8 bits, so that gradients have no bands; deterministic, at most one step from "
      "the rounded values. Not for views that are data, nor for EXR, HDR and PFM",
      Invalidates::display},
     AT(settings.display.dither)},
};

#undef AT

template <std::size_t I>
void* override_value(Document& d) {
  return material_choice_fields()[I].address(d.settings.override_brdf.values);
}

std::vector<Field<Document>> override_rows() {
  std::vector<Field<Document>> out = {
      {{"override.brdf", FieldType::choice, 0, 0, "", "Renders every surface as this one material", kImage,
        override_names()},
       [](Document& d) -> void* { return &d.settings.override_brdf.brdf; }}};
  static std::deque<std::string> texts; // storage of the rows' string views
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    for (auto address : {override_value<I>...}) {
      FieldInfo row = material_choice_fields()[out.size() - 1];
      row.key = texts.emplace_back(fmt::format("override.{}", row.key));
      row.help = texts.emplace_back(fmt::format("Of the override: {}", row.help));
      out.push_back({row, address});
    }
  }
  (std::make_index_sequence<kMaterialKeyCount>());
  return out;
}

std::vector<Field<Document>> whole_table() {
  std::vector<Field<Document>> table(std::begin(kRows), std::end(kRows));
  const auto film = std::ranges::find(table, "film.width", &FieldInfo::key);
  const auto rows = override_rows();
  table.insert(film, rows.begin(), rows.end());
  const auto camera = camera_rows();
  table.insert(std::ranges::find(table, "stop.spp", &FieldInfo::key), camera.begin(), camera.end());
  return table;
}

} // namespace

std::span<const Field<Document>> settings_table() {
  static const std::vector<Field<Document>> table = whole_table();
  return table;
}

const Field<Document>* find_setting(std::string_view key) {
  for (const auto& row : settings_table())
    if (row.key == key) return &row;
  return nullptr;
}

OverrideSettings::OverrideSettings() {
  // A visible colour: black would hide the shape of glossy lobes and metals.
  constexpr float kShown = 0.9f;
  for (const auto& row : material_choice_fields())
    if (row.key == "specular") *static_cast<vec3*>(row.address(values)) = vec3(kShown);
}

Material overriding_material(const OverrideSettings& settings) {
  MaterialChoice choice = settings.values;
  choice.type = settings.brdf - 1;
  return chosen_material(choice, false);
}

void apply_setting(Document& document, std::string_view assignment) {
  auto equals = assignment.find('=');
  if (equals == std::string_view::npos)
    throw usage_error(fmt::format("--set {}", assignment), "there is no '='", "write KEY=VALUE");
  std::string_view key = assignment.substr(0, equals);
  const auto* row = find_setting(key);
  if (row == nullptr) {
    std::vector<std::string_view> keys;
    for (const auto& r : settings_table()) keys.push_back(r.key);
    std::string near = nearest_name(key, keys);
    throw usage_error(fmt::format("--set {}", key), "there is no such setting",
                      near.empty() ? "see `candela settings`" : fmt::format("did you mean {}?", near));
  }
  field_from_text(*row, row->address(document), assignment.substr(equals + 1));
}

} // namespace candela
