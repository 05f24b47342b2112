#include "media/medium_desc.h"

#include "core/model_fields.h"

#include <fmt/format.h>

#include <set>

namespace candela {

namespace {

constexpr auto kMediumNames = model_names<MediumDesc>();
constexpr auto kPhaseNames = model_names<PhaseDesc>();

/// "isotropic: …; rayleigh: …", as the models describe themselves.
template <class Owner>
std::string models_help() {
  std::string out;
  [&]<std::size_t... Type>(std::index_sequence<Type...>) {
    ((out += fmt::format("{}{}: {}", Type > 0 ? "; " : "", ModelOf<Owner, Type>::kName,
                         ModelOf<Owner, Type>::kHelp)),
     ...);
  }
  (ModelTypes<Owner>());
  return out;
}

const Field<MediumDesc> kCommonFields[] = {
    {{"scale",
      FieldType::real,
      0,
      1e6,
      "",
      "Multiplies the coefficients: how dense it is",
      Invalidates::image,
      {},
      true},
     [](MediumDesc& m) -> void* { return &m.scale; }},
    {{"emission",
      FieldType::color,
      0,
      1e9,
      "W/(m^2 sr)",
      "Radiance of a thick body of it, if it did not scatter: it sends out sigma_t (1 - albedo) of that on a "
      "way of "
      "one scene unit",
      Invalidates::image,
      {},
      true},
     [](MediumDesc& m) -> void* { return &m.emission; }},
};

/// Values of the same key and type stay.
constexpr auto kCopyAlike = [](const auto& to, auto& changed, const auto& from, auto& old) {
  if (to.type == from.type) field_copy(to, to.address(changed), from.address(old));
};

std::span<const Field<MediumDesc>> fields_of_medium_type(int type) {
  static const auto tables = model_tables<MediumDesc, Field<MediumDesc>>(
      []<std::size_t Type, std::size_t Row>() { return model_field<MediumDesc, Type, Row>(); },
      [](auto) { return std::span(kCommonFields); });
  return tables[static_cast<std::size_t>(type)];
}

std::span<const Field<PhaseDesc>> fields_of_phase_type(int type) {
  static const auto tables = model_tables<PhaseDesc, Field<PhaseDesc>>(
      []<std::size_t Type, std::size_t Row>() { return model_field<PhaseDesc, Type, Row>(); },
      [](auto) { return std::span<const Field<PhaseDesc>>(); });
  return tables[static_cast<std::size_t>(type)];
}

template <class Owner>
std::string rows_problem(std::span<const Field<Owner>> rows, const Owner& owner, std::string_view prefix) {
  for (const auto& row : rows)
    if (auto problem = field_problem(row, row.address(const_cast<Owner&>(owner))); !problem.empty())
      return fmt::format("{}{}: {}; give {}", prefix, row.key, problem, field_domain(row));
  return {};
}

} // namespace

const FieldInfo& medium_type_field() {
  static const std::string help = models_help<MediumDesc>();
  static const FieldInfo field{"type", FieldType::choice, 0, 0, "", help, Invalidates::image, kMediumNames};
  return field;
}
const FieldInfo& phase_type_field() {
  static const std::string help = "Where light goes that is scattered: " + models_help<PhaseDesc>();
  static const FieldInfo field{"type", FieldType::choice, 0, 0, "", help, Invalidates::image, kPhaseNames};
  return field;
}

MediumDesc default_medium(int type) { return with_model<MediumDesc>(type); }
PhaseDesc default_phase(int type) { return with_model<PhaseDesc>(type); }

void change_type(MediumDesc& medium, int type) {
  const PhaseDesc phase = medium.phase;
  change_model(medium, type, fields_of_medium_type, kCopyAlike);
  medium.phase = phase;
}
void change_type(PhaseDesc& phase, int type) { change_model(phase, type, fields_of_phase_type, kCopyAlike); }

std::span<const Field<MediumDesc>> medium_fields(const MediumDesc& medium) {
  return fields_of_medium_type(medium_type(medium));
}
std::span<const Field<PhaseDesc>> phase_fields(const PhaseDesc& phase) {
  return fields_of_phase_type(phase_type(phase));
}

bool takes_grid(const MediumDesc& medium) { return std::holds_alternative<GridMediumModel>(medium.model); }
std::shared_ptr<const VolumeGrid> medium_grid(const MediumDesc& medium) {
  const auto* model = std::get_if<GridMediumModel>(&medium.model);
  return model != nullptr ? model->grid : nullptr;
}
void set_medium_grid(MediumDesc& medium, std::shared_ptr<const VolumeGrid> grid) {
  std::get<GridMediumModel>(medium.model).grid = std::move(grid);
}

namespace {

Spectrum extinction_of(const MediumDesc& desc, const HomogeneousMediumModel& model, const PhaseFunction&) {
  return model.sigma_t * desc.scale;
}
Medium medium_of(const MediumDesc& desc, const HomogeneousMediumModel& model, const PhaseFunction& phase,
                 const MediumContext& context) {
  const Spectrum sigma_t = model.sigma_t * desc.scale;
  return HomogeneousMedium{sigma_t * (1.0f - model.albedo) + context.absorption, sigma_t * model.albedo,
                           desc.emission, phase};
}

/// By the similarity of phase functions (Wyman, Patterson & Wilson 1989) sigma_s (1 - g) is what was
/// measured.
HomogeneousMedium measured_medium(const MediumDesc& desc, const MeasuredMediumModel& model,
                                  const PhaseFunction& phase) {
  const MeasuredMedium& measured = kMeasuredMedia[static_cast<std::size_t>(model.material)];
  return {measured.sigma_a * desc.scale, measured.reduced_sigma_s * (desc.scale / (1 - mean_cosine(phase))),
          desc.emission, phase};
}
Spectrum extinction_of(const MediumDesc& desc, const MeasuredMediumModel& model, const PhaseFunction& phase) {
  return measured_medium(desc, model, phase).sigma_t();
}
Medium medium_of(const MediumDesc& desc, const MeasuredMediumModel& model, const PhaseFunction& phase,
                 const MediumContext& context) {
  HomogeneousMedium medium = measured_medium(desc, model, phase);
  medium.sigma_a += context.absorption;
  return medium;
}

Medium grid_medium(const MediumDesc& desc, const GridPlacement& placement,
                   const std::shared_ptr<const VolumeGrid>& grid, const PhaseFunction& phase,
                   const MediumContext& context) {
  if (!grid) return HomogeneousMedium{.sigma_a = context.absorption, .phase = phase};
  GridMedium medium;
  medium.values = grid;
  medium.bricks = context.grids != nullptr ? context.grids->bricks(grid) : std::make_shared<BrickGrid>(*grid);
  // The lower corner is at -1/2 cell.
  medium.cells_per_unit = vec3(grid->cells) / placement.size;
  medium.first_cell = (placement.center - 0.5f * placement.size) * medium.cells_per_unit + 0.5f;
  medium.density_sigma_t = placement.sigma_t * desc.scale;
  medium.albedo = placement.albedo;
  medium.absorption = context.absorption;
  medium.emission = desc.emission;
  if (placement.temperature > 0 && max_component(desc.emission) > 0)
    medium.glow = std::make_shared<const GlowTable>(placement.temperature);
  medium.phase = phase;
  medium.estimator = context.estimator;
  return medium;
}
Spectrum extinction_of(const MediumDesc& desc, const GridPlacement& placement, const PhaseFunction&) {
  return placement.sigma_t * desc.scale;
}
Medium medium_of(const MediumDesc& desc, const GridMediumModel& model, const PhaseFunction& phase,
                 const MediumContext& context) {
  return grid_medium(desc, model, model.grid, phase, context);
}

Medium medium_of(const MediumDesc& desc, const ProceduralMediumModel& model, const PhaseFunction& phase,
                 const MediumContext& context) {
  const ProceduralGrid& made = model;
  return grid_medium(desc, model,
                     context.grids != nullptr ? context.grids->made(made) : make_procedural_grid(made), phase,
                     context);
}

} // namespace

PhaseFunction make_phase(const PhaseDesc& phase) {
  return std::visit([](const auto& model) -> PhaseFunction { return model.closure(); }, phase.model);
}

Medium make_medium(const MediumDesc& medium, const MediumContext& context) {
  const PhaseFunction phase = make_phase(medium.phase);
  return std::visit([&](const auto& model) { return medium_of(medium, model, phase, context); },
                    medium.model);
}

Spectrum medium_extinction(const MediumDesc& medium) {
  const PhaseFunction phase = make_phase(medium.phase);
  return std::visit([&](const auto& model) { return extinction_of(medium, model, phase); }, medium.model);
}

std::string media_problem(const std::vector<MediumDesc>& media) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < media.size(); ++i) {
    const MediumDesc& medium = media[i];
    const std::string at = fmt::format("media[{}].", i);
    if (medium.name.empty()) return at + "name: is empty; give the name by which materials refer to it";
    if (!names.insert(medium.name).second)
      return fmt::format("{}name: '{}' is there twice; give each its own", at, medium.name);
    if (auto problem = rows_problem(medium_fields(medium), medium, at); !problem.empty()) return problem;
    if (auto problem = rows_problem(phase_fields(medium.phase), medium.phase, at + "phase.");
        !problem.empty())
      return problem;
  }
  return {};
}

} // namespace candela
