#pragma once
// Media of every model as scenes describe them, and their rows.

#include "media/grid_cache.h"
#include "media/measured_media.h"
#include "media/medium.h"
#include "media/procedural_grid.h"

#include <memory>
#include <string>
#include <vector>

namespace candela {

/// The row of one value of a model of media.
template <class Model>
struct MediumRow : FieldInfo {
  std::variant<float Model::*, vec3 Model::*, int Model::*> member;
};

// What the description of a medium offers, its model:
//
//   kName, kHelp   what files call it, and what it is in a few words
//   rows()         a std::array of MediumRow, one for each of its values
//
// and in medium_desc.cpp medium_of(), the medium as transport needs it (media/medium.h), and extinction_of().

/// The same everywhere.
struct HomogeneousMediumModel {
  vec3 sigma_t{1};    ///< extinction coefficient, 1/scene unit
  vec3 albedo{0.75f}; ///< of each collision: the share of the light that is scattered
  bool operator==(const HomogeneousMediumModel&) const = default;

  static constexpr std::string_view kName = "homogeneous";
  static constexpr std::string_view kHelp = "the same everywhere";
  static constexpr auto rows() {
    using Row = MediumRow<HomogeneousMediumModel>;
    return std::array{
        Row{{"sigma_t",
             FieldType::color,
             0,
             1e6,
             "1/scene unit",
             "Extinction coefficient: light goes 1 / (sigma_t scale) on the mean before it is scattered or "
             "absorbed",
             Invalidates::image,
             {},
             true},
            &HomogeneousMediumModel::sigma_t},
        Row{{"albedo", FieldType::color, 0, 1, "",
             "Share of that light which is scattered; the rest is absorbed"},
            &HomogeneousMediumModel::albedo}};
  }
};

/// A material of measured_media.h.
struct MeasuredMediumModel {
  int material = 8; ///< skin1
  bool operator==(const MeasuredMediumModel&) const = default;

  static constexpr std::string_view kName = "measured";
  static constexpr std::string_view kHelp =
      "a measured material by its name, where a scene unit is a millimetre; "
      "where it is a metre, the scale is 1000";
  static constexpr auto rows() {
    return std::array{MediumRow<MeasuredMediumModel>{{"material", FieldType::choice, 0, 0, "",
                                                      "What was measured (Jensen et al. 2001)",
                                                      Invalidates::image, kMeasuredNames},
                                                     &MeasuredMediumModel::material}};
  }
};

/// Where a grid's box stands in the world, axis by axis, and what its values mean.
struct GridPlacement {
  vec3 center{0}, size{2}; ///< scene units
  vec3 sigma_t{1};         ///< extinction coefficient where the density is 1, 1/scene unit
  vec3 albedo{0.75f};      ///< times the grid's colour, if it has any
  float temperature = 0;   ///< of the temperature 1, kelvin; 0: what is sent out does not depend on it
  bool operator==(const GridPlacement&) const = default;
};

template <class Model>
constexpr auto grid_rows() {
  using Row = MediumRow<Model>;
  return std::array{
      Row{{"sigma_t",
           FieldType::color,
           0,
           1e6,
           "1/scene unit",
           "Extinction coefficient where the density is 1",
           Invalidates::image,
           {},
           true},
          &Model::sigma_t},
      Row{{"albedo", FieldType::color, 0, 1, "",
           "Share of the light that is scattered where it meets matter; the rest is absorbed"},
          &Model::albedo},
      Row{{"center", FieldType::point, -1e9, 1e9, "scene units", "Centre of the box that the grid fills"},
          &Model::center},
      Row{{"size", FieldType::point, 1e-6, 1e9, "scene units", "Of that box, along each axis"}, &Model::size},
      Row{{"temperature", FieldType::real, 0, 20000, "K",
           "Of the hottest place (temperature 1): emission is its radiance, and cooler ones are redder and "
           "darker as black bodies are; 0: emission is the same everywhere"},
          &Model::temperature}};
}

/// The values of a file.
struct GridMediumModel : GridPlacement {
  std::shared_ptr<const VolumeGrid> grid;                  ///< null: none yet, and nothing is there
  bool operator==(const GridMediumModel&) const = default; ///< grids by identity

  static constexpr std::string_view kName = "grid";
  static constexpr std::string_view kHelp = "smoke, cloud or fire of a file of densities";
  static constexpr auto rows() { return grid_rows<GridMediumModel>(); }
};

/// Values that are computed.
struct ProceduralMediumModel : GridPlacement, ProceduralGrid {
  bool operator==(const ProceduralMediumModel&) const = default;

  static constexpr std::string_view kName = "procedural";
  static constexpr std::string_view kHelp = "a cloud, smoke or a flame that is computed";
  static constexpr auto rows() {
    using Model = ProceduralMediumModel;
    using Row = MediumRow<Model>;
    const std::array own = {
        Row{{"pattern", FieldType::choice, 0, 0, "",
             "A cumulus on a flat base, a ball of curling smoke, or a flame; y is up. Sides of a box that "
             "does "
             "not stretch them: 1 0.6 0.8, 1 1 1 and 0.5 1 0.5",
             Invalidates::image, kPatterns},
            &Model::pattern},
        Row{{"seed", FieldType::integer, 0, 1e9, "", "Another number, another one of the same kind"},
            &Model::seed},
        Row{{"resolution", FieldType::integer, kLeastResolution, kMostResolution, "",
             "Cells along the longest side: twice as many take eight times the time and memory"},
            &Model::resolution},
        Row{{"frequency", FieldType::real, 0.5, 64, "",
             "Features of the largest size along the longest side"},
            &Model::frequency},
        Row{{"octaves", FieldType::integer, 1, 10, "", "Sizes of features, each half of the one before"},
            &Model::octaves},
        Row{{"coverage", FieldType::real, 0, 1, "", "How much of the box is filled"}, &Model::coverage},
        Row{{"softness", FieldType::real, 0, 1, "", "Of the edges: from sharp ones to a gradual decrease"},
            &Model::softness}};
    constexpr auto kPlaced = grid_rows<Model>();
    std::array<Row, own.size() + kPlaced.size()> all{};
    std::copy(own.begin(), own.end(), all.begin());
    std::copy(kPlaced.begin(), kPlaced.end(), all.begin() + own.size());
    return all;
  }
};

/// A new one is its struct, and its name here.
using MediumDescModel =
    std::variant<HomogeneousMediumModel, MeasuredMediumModel, GridMediumModel, ProceduralMediumModel>;

/// A phase function and its values, as a part of a medium.
struct PhaseDesc {
  std::string name{}; ///< none: it is the medium's
  PhaseModel model;
  bool operator==(const PhaseDesc&) const = default;
};

/// What surfaces or the whole scene may be filled with, by its name.
struct MediumDesc {
  std::string name;
  MediumDescModel model;
  float scale = 1;  ///< multiplies the coefficients
  vec3 emission{0}; ///< as HomogeneousMedium has it
  PhaseDesc phase;
  bool operator==(const MediumDesc&) const = default;
};

/// Choices over an int, the type by its index in the list: for files and panels.
const FieldInfo& medium_type_field();
const FieldInfo& phase_type_field();
inline int medium_type(const MediumDesc& medium) { return static_cast<int>(medium.model.index()); }
inline int phase_type(const PhaseDesc& phase) { return static_cast<int>(phase.model.index()); }

/// Of the type, with default values.
MediumDesc default_medium(int type);
PhaseDesc default_phase(int type);
/// Changes the type. Values of the same key stay, the others become the new type's defaults.
void change_type(MediumDesc& medium, int type);
void change_type(PhaseDesc& phase, int type);

/// The rows of a medium's values but its phase function's: those of its type, then those of all. The
/// addresses are those in a MediumDesc of this type.
std::span<const Field<MediumDesc>> medium_fields(const MediumDesc& medium);
std::span<const Field<PhaseDesc>> phase_fields(const PhaseDesc& phase);

/// The values of a file, of a medium that may have them; null: none.
bool takes_grid(const MediumDesc& medium);
std::shared_ptr<const VolumeGrid> medium_grid(const MediumDesc& medium);
/// Gives a medium that may have them the values of a file.
void set_medium_grid(MediumDesc& medium, std::shared_ptr<const VolumeGrid> grid);

PhaseFunction make_phase(const PhaseDesc& phase);
/// What make_medium() needs beside the description.
struct MediumContext {
  Spectrum absorption{0}; ///< absorption coefficient that is added, 1/scene unit
  TransmittanceEstimator estimator = TransmittanceEstimator::residual;
  GridCache* grids = nullptr; ///< null: bricks are made anew
};
/// As transport needs it.
Medium make_medium(const MediumDesc& medium, const MediumContext& context = {});
/// Its extinction coefficient, 1/scene unit; of a grid where the density is 1.
Spectrum medium_extinction(const MediumDesc& medium);

/// What is wrong with the media of a scene: "media[0].name: cause; remedy"; empty if all is well.
std::string media_problem(const std::vector<MediumDesc>& media);

} // namespace candela
