#include "versus_cycles/cycles.h"

#include "core/error.h"
#include "io/images/image_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace candela::versus {

namespace {

using nlohmann::json;

json to_json(vec3 v) { return {v.x, v.y, v.z}; }

Error unknown(std::string_view element, std::string_view cause) {
  return usage_error(element, cause, "teach write_cycles_scene and cycles_render.py");
}

/// The values of our models that Cycles' nodes have; the others must be the defaults.
std::optional<json> glass_json(const Material& m) {
  const auto* glass = std::get_if<RoughDielectricMaterial>(&m.model);
  if (glass == nullptr) return std::nullopt;
  if (*glass != RoughDielectricMaterial{.ior = glass->ior,
                                        .roughness = glass->roughness,
                                        .energy_compensation = false} ||
      m.emission != vec3(0))
    throw unknown("material", "more than index and roughness of rough_dielectric");
  return json{{"type", "glass"},
              {"ior", glass->ior.value},
              {"roughness", glass->roughness.value},
              {"emission", to_json(vec3(0))}};
}

std::optional<json> principled_json(const Material& m) {
  const auto* p = std::get_if<PrincipledMaterial>(&m.model);
  if (p == nullptr) return std::nullopt;
  if (*p != PrincipledMaterial{.base_color = p->base_color,
                               .roughness = p->roughness,
                               .metallic = p->metallic} ||
      m.emission != vec3(0))
    throw unknown("material", "more than colour, roughness and metallic of principled");
  return json{{"type", "principled"},
              {"base_color", to_json(p->base_color.value)},
              {"roughness", p->roughness.value},
              {"metallic", p->metallic.value},
              {"specular", p->specular.value},
              {"emission", to_json(vec3(0))}};
}

std::optional<json> hair_json(const Material& m) {
  const auto* hair = std::get_if<HairMaterial>(&m.model);
  if (hair == nullptr) return std::nullopt;
  if (hair->parametrization != static_cast<int>(HairAbsorption::absorption) || m.emission != vec3(0))
    throw unknown("material", "hair but by its absorption");
  return json{{"type", "hair"},
              {"sigma_a", to_json(hair->sigma_a.value)},
              {"beta_m", hair->beta_m.value},
              {"beta_n", hair->beta_n.value},
              {"alpha", radians(hair->alpha.value)},
              {"ior", hair->ior.value},
              {"emission", to_json(vec3(0))}};
}

/// A surface that is not there around a medium.
std::optional<json> volume_json(const Material& m, const SceneDesc& scene) {
  if (!is_null(m)) return std::nullopt;
  const auto desc = std::ranges::find(scene.media, m.medium, &MediumDesc::name);
  if (desc == scene.media.end()) throw unknown("material", "null without a medium");
  const Medium made = make_medium(*desc);
  if (const auto* smoke = std::get_if<GridMedium>(&made)) {
    const auto* lobe = std::get_if<HenyeyGreenstein>(&smoke->phase);
    if (lobe == nullptr || desc->name != "smoke")
      throw unknown("medium", "a grid but that of smoke_density()");
    return json{{"type", "smoke"},
                {"sigma_a", smoke->density_sigma_t.x * (1 - smoke->albedo.x)},
                {"sigma_s", smoke->density_sigma_t.x * smoke->albedo.x},
                {"g", lobe->g},
                {"emission", to_json(vec3(0))}};
  }
  const auto& medium = std::get<HomogeneousMedium>(made);
  const auto* phase = std::get_if<HenyeyGreenstein>(&medium.phase);
  if (phase == nullptr || medium.sigma_a != vec3(medium.sigma_a.x) ||
      medium.sigma_s != vec3(medium.sigma_s.x) || medium.emits())
    throw unknown("medium", "anything but a grey one of Henyey and Greenstein");
  return json{{"type", "volume"},
              {"sigma_a", medium.sigma_a.x},
              {"sigma_s", medium.sigma_s.x},
              {"g", phase->g},
              {"emission", to_json(vec3(0))}};
}

json material_json(const Material& m, const SceneDesc& scene) {
  if (auto volume = volume_json(m, scene)) return *volume;
  if (is_textured(m) || m.opacity.value < 1) throw unknown("material", "its texture or opacity");
  if (auto glass = glass_json(m)) return *glass;
  if (auto principled = principled_json(m)) return *principled;
  if (auto hair = hair_json(m)) return *hair;
  if (!std::holds_alternative<DiffuseMaterial>(m.model) && !std::holds_alternative<GgxMaterial>(m.model))
    throw unknown("material", "its type");
  const auto* diffuse = std::get_if<DiffuseMaterial>(&m.model);
  const auto* metal = std::get_if<GgxMaterial>(&m.model);
  if (metal != nullptr && (metal->specular != vec3(1) || m.emission != vec3(0)))
    throw unknown("material", "a Fresnel term or emission of ggx");
  return {{"type", std::string(material_type_name(m))},
          {"diffuse", to_json(diffuse != nullptr ? diffuse->diffuse.value : vec3(0))},
          {"specular", to_json(metal != nullptr ? metal->specular.value : vec3(0))},
          {"roughness", metal != nullptr ? metal->roughness.value : 0},
          {"emission", to_json(m.emission.value)}};
}

template <class T>
void write_raw(const std::string& path, const std::vector<T>& values) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!out.flush()) throw output_error(path, "it cannot be written", "free some space");
}

json mesh_json(Mesh mesh, const mat4& world_from_object, int material, const std::string& folder,
               std::size_t index) {
  if (!mesh.normals.empty()) throw unknown("mesh", "its normals");
  for (vec3& p : mesh.positions) p = vec3(world_from_object * vec4(p, 1));
  std::string vertices = fmt::format("{}.vertices", index), triangles = fmt::format("{}.triangles", index);
  write_raw(folder + "/" + vertices, mesh.positions);
  write_raw(folder + "/" + triangles, mesh.triangles);
  return {{"vertices", vertices}, {"triangles", triangles}, {"material", material}};
}

/// Points at the ends of the segments of uniform cubic B-splines, with their radii.
json curves_json(const CurvesShape& shape, const mat4& world_from_object, int material,
                 const std::string& folder, std::size_t index) {
  const Strands& strands = *shape.strands;
  if (world_from_object != mat4(1) || strands.basis != CurveBasis::bspline || strands.has_width_per_point() ||
      shape.curve_form() != CurveForm::round || shape.thickness != 1)
    throw unknown("curves", "anything but tubes of B-splines in world space, with the widths of their ends");
  std::vector<vec3> points;
  std::vector<float> radii;
  std::vector<std::uint32_t> counts;
  std::size_t first = 0;
  for (const std::uint32_t count : strands.counts) {
    const std::uint32_t ends = count - 2;
    for (std::uint32_t k = 0; k < ends; ++k) {
      const vec3* p = &strands.points[first + k];
      points.push_back((p[0] + 4.0f * p[1] + p[2]) / 6.0f);
      const float t = static_cast<float>(k) / static_cast<float>(ends - 1);
      radii.push_back(0.5f * glm::mix(strands.widths[0], strands.widths[1], t));
    }
    counts.push_back(ends);
    first += count;
  }
  const auto name = [&](std::string_view what) { return fmt::format("{}.{}", index, what); };
  write_raw(folder + "/" + name("points"), points);
  write_raw(folder + "/" + name("radii"), radii);
  write_raw(folder + "/" + name("counts"), counts);
  return {{"points", name("points")},
          {"radii", name("radii")},
          {"counts", name("counts")},
          {"material", material}};
}

} // namespace

std::optional<std::string> find_blender() {
  const char* variable = std::getenv("PATH");
  std::istringstream folders(variable != nullptr ? variable : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::string path = folder + "/blender"; ::access(path.c_str(), X_OK) == 0) return path;
  return std::nullopt;
}

void write_cycles_scene(const Document& document, const std::string& folder) {
  const SceneDesc& scene = document.scene;
  const Camera& camera = scene.camera;
  if (!scene.medium.empty()) throw unknown("medium", "it fills the scene");
  if (camera.projection != Projection::perspective || camera.aperture_radius > 0)
    throw unknown("camera", "it is no pinhole");
  json out;
  out["width"] = document.settings.film.width;
  out["height"] = document.settings.film.height;
  out["camera"] = {{"position", to_json(camera.position)},
                   {"target", to_json(camera.target)},
                   {"up", to_json(camera.up)},
                   {"vertical_fov", camera.vertical_fov}};
  for (const Material& m : scene.materials) out["materials"].push_back(material_json(m, scene));
  out["meshes"] = out["curves"] = out["rectangle_lamps"] = out["ball_lamps"] = json::array();
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const mat4& m = instance.world_from_object;
    int index = instance.materials.at(0);
    vec3 emission = scene.materials.at(static_cast<std::size_t>(index)).emission.value;
    if (auto mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape)) {
      if (emission != vec3(0)) throw unknown("instance", "a mesh that shines");
      out["meshes"].push_back(mesh_json(**mesh, m, index, folder, i));
    } else if (auto curves = std::get_if<CurvesShape>(&instance.shape)) {
      out["curves"].push_back(curves_json(*curves, m, index, folder, i));
    } else if (std::holds_alternative<RectangleShape>(instance.shape)) {
      Mesh quad;
      quad.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
      quad.triangles = {{0, 1, 2}, {0, 2, 3}};
      out["meshes"].push_back(mesh_json(std::move(quad), m, index, folder, i));
      if (emission != vec3(0))
        out["rectangle_lamps"].push_back({{"center", to_json(vec3(m[3]))},
                                          {"x", to_json(vec3(m[0]))},
                                          {"y", to_json(vec3(m[1]))},
                                          {"radiance", to_json(emission)}});
    } else if (auto sphere = std::get_if<SphereShape>(&instance.shape);
               sphere != nullptr && emission != vec3(0)) {
      out["ball_lamps"].push_back({{"center", to_json(vec3(m[3]))},
                                   {"radius", sphere->radius * glm::length(vec3(m[0]))},
                                   {"radiance", to_json(emission)}});
    } else {
      throw unknown("instance", "its shape");
    }
  }
  for (const LightDesc& light : scene.lights) {
    const auto panorama = light_panorama(light);
    if (panorama == nullptr || out.contains("panorama") || light.scale * light.color != vec3(1) ||
        std::get<EnvironmentLightModel>(light.model) != EnvironmentLightModel{.panorama = panorama})
      throw unknown("light", "anything but one panorama as it is");
    write_linear_image(panorama->image, folder + "/panorama.exr");
    out["panorama"] = "panorama.exr";
  }
  std::ofstream file(folder + "/scene.json");
  file << out.dump(1) << '\n';
  if (!file.flush()) throw output_error(folder + "/scene.json", "it cannot be written", "free some space");
}

Cycles::Cycles(const std::string& blender, const std::string& folder, int threads,
               const std::vector<std::string>& settings)
    : log_(folder + "/blender.log") {
  std::signal(SIGPIPE, SIG_IGN); // a blender that ended early is detected when reading
  int in[2], out[2];
  if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0)
    throw Error(ExitCode::limit, "versus_cycles: no pipe to blender: too many open files: close some");
  to_ = ::fdopen(in[1], "w");
  from_ = ::fdopen(out[0], "r");
  std::vector<std::string> words = {blender,
                                    "-b",
                                    "--factory-startup",
                                    "-noaudio",
                                    "-t",
                                    std::to_string(threads),
                                    "--python-exit-code",
                                    "1",
                                    "--python",
                                    VERSUS_CYCLES_SCRIPT,
                                    "--",
                                    folder};
  words.insert(words.end(), settings.begin(), settings.end());
  std::vector<char*> arguments;
  for (std::string& w : words) arguments.push_back(w.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, in[0], 0);
  ::posix_spawn_file_actions_adddup2(&actions, out[1], 1);
  ::posix_spawn_file_actions_adddup2(&actions, out[1], 2);
  int failed = ::posix_spawn(&process_, blender.c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(in[0]);
  ::close(out[1]);
  if (failed != 0)
    throw Error(ExitCode::limit, fmt::format("{}: it cannot be started (error {})", blender, failed));
  version_ = answer("versus_cycles ready ");
}

Cycles::~Cycles() {
  std::fclose(to_);
  std::fclose(from_);
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
}

double Cycles::render(int seed, int spp, const std::string& exr) {
  fmt::print(to_, "{} {} {}\n", seed, spp, exr);
  std::fflush(to_);
  return std::stod(answer("versus_cycles rendered "));
}

std::string Cycles::answer(std::string_view word) {
  std::ofstream log(log_, std::ios::app);
  std::string line, last;
  for (int c; (c = std::fgetc(from_)) != EOF;) {
    if (c != '\n') {
      line.push_back(static_cast<char>(c));
      continue;
    }
    if (line.starts_with(word)) return line.substr(word.size());
    log << line << std::endl;
    if (!line.empty() && !line.starts_with("Error: script failed")) last = line; // an exception's own text
    line.clear();
  }
  throw Error(ExitCode::bad_input, fmt::format("blender: it ended early: {}: see {} of --keep FOLDER", last,
                                               std::filesystem::path(log_).filename().string()));
}

} // namespace candela::versus
