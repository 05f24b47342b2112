// Grids of OpenVDB files, versions 222 to 224 (OpenVDB 2.0 and later), without the library: files are
// hostile, and it trusts them.

#include "io/volumes/vdb_tree.h"
#include "io/volumes/volume_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace candela {

namespace {

constexpr std::array<std::uint8_t, 8> kVdbMagic = {0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};

/// Of an index to the world: world = scale * index + offset.
struct VdbTransform {
  glm::dvec3 scale{1}, offset{0};
  bool operator==(const VdbTransform&) const = default;
};

struct VdbGrid {
  std::string name, type;
  std::uint64_t position = 0;
  bool is_instance = false;
};

class OpenVdbFile {
public:
  OpenVdbFile(ByteView all, const std::string& file, WarningList& warnings)
      : bytes_(all, file), warnings_(warnings) {
    read_header();
    read_descriptors();
  }

  VolumeGrid volume() {
    const VdbGrid* density = density_grid();
    Opened opened = open(*density);
    if (opened.is_level_set)
      throw bytes_.wrong(element(*density), "it is a level set: distances from a surface",
                         "convert it to a fog volume");
    const VoxelBox box = opened.tree.active();
    if (box.empty())
      throw bytes_.wrong(element(*density), "no voxel of it is active", "give a grid with values");
    VolumeGrid grid;
    check_volume_cells(bytes_.file(), box.side(0), box.side(1), box.side(2));
    for (int a = 0; a < 3; ++a) grid.cells[a] = static_cast<int>(box.side(static_cast<std::size_t>(a)));
    glm::dvec3 lo, hi;
    for (int a = 0; a < 3; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      lo[a] = static_cast<double>(box.lo[axis]) - 0.5, hi[a] = static_cast<double>(box.hi[axis]) + 0.5;
    }
    const VdbTransform& t = opened.transform;
    grid.bounds = checked_volume_bounds(bytes_.file(), t.scale * lo + t.offset, t.scale * hi + t.offset);
    grid.density = opened.tree.dense(box);
    if (const VdbGrid* hot = named({"temperature", "flame", "flames", "heat"}, 1))
      grid.temperature = beside(*hot, t, box);
    if (const VdbGrid* color = named({"Cd", "color", "albedo"}, 3)) {
      const std::vector<float> values = beside(*color, t, box);
      grid.color.resize(values.size() / 3);
      for (std::size_t i = 0; i < grid.color.size(); ++i)
        grid.color[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    }
    return grid;
  }

private:
  struct Opened {
    VdbTree tree;
    VdbTransform transform;
    bool is_level_set;
  };

  static std::string element(const VdbGrid& grid) {
    return fmt::format("grid '{}'", grid.name.substr(0, 60));
  }

  std::string read_name() {
    constexpr std::uint32_t kLongest = 4096;
    const auto length = bytes_.value<std::uint32_t>();
    if (length > kLongest) throw bytes_.wrong("header", "a name in it is too long");
    const ByteView taken = bytes_.take(length);
    std::string name(taken.begin(), taken.end());
    for (char& c : name)
      if (c >= 0 && c < ' ') c = '?';
    return name;
  }

  /// Whether one of the entries is "class" with the value "level set".
  bool read_metadata() {
    bool is_level_set = false;
    const auto count = bytes_.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) { // each takes bytes of the file
      const std::string name = read_name();
      read_name(); // of its type
      const ByteView value = bytes_.take(bytes_.value<std::uint32_t>());
      is_level_set |= name == "class" && std::string(value.begin(), value.end()) == "level set";
    }
    return is_level_set;
  }

  void read_header() {
    bytes_.take(kVdbMagic.size());
    version_ = bytes_.value<std::uint32_t>();
    if (version_ < 222 || version_ > 224)
      throw bytes_.wrong("header", fmt::format("the version {} of the format is not read", version_),
                         "save it by OpenVDB 2.0 to 12");
    bytes_.take(8); // version of the library
    has_offsets_ = bytes_.value<std::uint8_t>() != 0;
    constexpr std::size_t kUuidBytes = 36;
    bytes_.take(kUuidBytes);
    read_metadata();
  }

  void read_descriptors() {
    if (!has_offsets_)
      throw bytes_.wrong("header", "it has no places of its grids, as it was a stream", "save it as a file");
    const auto count = bytes_.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
      VdbGrid grid;
      grid.name = read_name();
      grid.name = grid.name.substr(0, grid.name.find('?')); // a number follows where names are there twice
      grid.type = read_name();
      grid.is_instance = !read_name().empty();
      grid.position = bytes_.value<std::uint64_t>();
      bytes_.value<std::uint64_t>(); // of its buffers
      const auto end = bytes_.value<std::uint64_t>();
      grids_.push_back(grid);
      if (grid.position > end) throw bytes_.wrong(element(grid), "it ends before it begins");
      bytes_.seek(end);
    }
  }

  /// Floats or vectors of three, of the usual tree.
  static std::optional<VdbValueType> value_type(std::string_view type) {
    VdbValueType value;
    if (constexpr std::string_view kHalf = "_HalfFloat"; type.ends_with(kHalf)) {
      value.is_half = true;
      type.remove_suffix(kHalf.size());
    }
    value.components = type.starts_with("Tree_vec3") ? 3 : 1;
    value.is_double = type == "Tree_double_5_4_3" || type == "Tree_vec3d_5_4_3";
    if (type != "Tree_float_5_4_3" && type != "Tree_vec3s_5_4_3" && !value.is_double) return std::nullopt;
    return value;
  }

  const VdbGrid* named(std::initializer_list<std::string_view> names, int components) const {
    for (std::string_view name : names)
      for (const VdbGrid& grid : grids_)
        if (const auto type = value_type(grid.type);
            type && type->components == components && grid.name == name && !grid.is_instance)
          return &grid;
    return nullptr;
  }

  const VdbGrid* density_grid() const {
    if (const VdbGrid* grid = named({"density"}, 1)) return grid;
    for (const VdbGrid& grid : grids_)
      if (const auto type = value_type(grid.type); type && type->components == 1 && !grid.is_instance) {
        warnings_.add({bytes_.file()},
                      fmt::format("there is no grid 'density': '{}' is taken", grid.name.substr(0, 60)));
        return &grid;
      }
    throw bytes_.wrong("grids", fmt::format("none of the {} has floats on the usual tree", grids_.size()),
                       "give a grid 'density' of floats");
  }

  VdbTransform read_transform(const VdbGrid& grid) {
    const auto vector = [&] {
      glm::dvec3 v;
      for (int a = 0; a < 3; ++a) v[a] = bytes_.value<double>();
      return v;
    };
    VdbTransform t;
    const std::string map = read_name();
    if (map == "ScaleMap" || map == "UniformScaleMap") {
      t.scale = vector();
      bytes_.take(4 * sizeof(glm::dvec3)); // what follows from it
    } else if (map == "ScaleTranslateMap" || map == "UniformScaleTranslateMap") {
      t.offset = vector();
      t.scale = vector();
      bytes_.take(4 * sizeof(glm::dvec3));
    } else if (map == "TranslationMap") {
      t.offset = vector();
    } else if (map == "AffineMap") {
      double m[4][4]; // of row vectors
      for (auto& row : m)
        for (double& value : row) value = bytes_.value<double>();
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
          if (row != column && m[row][column] != 0) throw turned(grid);
      t.scale = {m[0][0], m[1][1], m[2][2]};
      t.offset = {m[3][0], m[3][1], m[3][2]};
    } else {
      throw turned(grid);
    }
    if (!glm::all(glm::greaterThan(t.scale, glm::dvec3(0)))) throw turned(grid);
    return t;
  }
  Error turned(const VdbGrid& grid) const {
    return bytes_.wrong(element(grid), "its voxels are turned, mirrored, sheared or not all alike",
                        "resample it along the axes of the world");
  }

  Opened open(const VdbGrid& grid) {
    bytes_.seek(grid.position);
    const auto flags = bytes_.value<std::uint32_t>();
    if (flags > (VdbPacking::kZip | VdbPacking::kActiveMask | VdbPacking::kBlosc))
      throw bytes_.wrong(element(grid), "it is compressed in an unknown way");
    const bool is_level_set = read_metadata();
    const VdbTransform transform = read_transform(grid);
    return {VdbTree(bytes_, *value_type(grid.type), {flags}, element(grid), warnings_), transform,
            is_level_set};
  }

  /// The values of another grid in the density's box; none, with a warning, if its voxels are others.
  std::vector<float> beside(const VdbGrid& grid, const VdbTransform& transform, const VoxelBox& box) {
    Opened opened = open(grid);
    if (opened.transform == transform) return opened.tree.dense(box);
    warnings_.add({bytes_.file()},
                  fmt::format("{}: its voxels are not those of the density: it is left out", element(grid)));
    return {};
  }

  VolumeBytes bytes_;
  WarningList& warnings_;
  std::uint32_t version_ = 0;
  bool has_offsets_ = false;
  std::vector<VdbGrid> grids_;
};

} // namespace

bool is_openvdb(ByteView bytes) {
  return bytes.size() >= kVdbMagic.size() && std::ranges::equal(bytes.first(kVdbMagic.size()), kVdbMagic);
}

VolumeGrid parse_openvdb(ByteView bytes, const std::string& file, WarningList& warnings) {
  return OpenVdbFile(bytes, file, warnings).volume();
}

} // namespace candela
