// Grids of floats in NanoVDB files of version 32 (Museth 2021, "NanoVDB: A GPU-Friendly and Portable VDB Data
// Structure"): a tree whose nodes of a kind are one after another, as in memory. Nothing in it is trusted:
// nodes are visited as lists, and no offset of a node is followed.

#include "io/volumes/blosc.h"
#include "io/volumes/vdb_tree.h"
#include "io/volumes/volume_bytes.h"

#include <fmt/format.h>

#include <optional>

namespace candela {

namespace {

constexpr std::uint64_t kNanoMagic = 0x304244566f6e614e; // "NanoVDB0"

/// A grid of a file, unpacked.
struct NanoGrid {
  std::string name;
  Bytes bytes;
};

/// Where the parts of its grid are, in bytes.
struct NanoLayout {
  static constexpr std::size_t kVersion = 16, kMatrix = 384, kOffset = 528, kClass = 632, kGrid = 672;
  static constexpr std::size_t kLeaf = 2144, kLower = 33856, kUpper = 270400; ///< sizes of nodes
  static constexpr std::size_t kLeafMask = 16, kLeafValues = 96;
  static constexpr std::size_t kNodeMask =
      32; ///< of active values, then of children, 4 statistics, the table
  static constexpr std::uint32_t kFloat = 1, kLevelSet = 1;
};

class NanoTree {
public:
  NanoTree(const NanoGrid& grid, const std::string& file, const WarningList& warnings)
      : bytes_(grid.bytes, file), element_(fmt::format("grid '{}'", grid.name)), warnings_(warnings) {
    if (at<std::uint64_t>(0) != kNanoMagic || at<std::uint32_t>(NanoLayout::kVersion) >> 21 != 32)
      throw bytes_.wrong(element_, "it is not of version 32");
    if (at<std::uint32_t>(NanoLayout::kClass) == NanoLayout::kLevelSet)
      throw bytes_.wrong(element_, "it is a level set: distances from a surface",
                         "convert it to a fog volume");
    for (int i = 0; i < 9; ++i) {
      const auto value = at<double>(NanoLayout::kMatrix + 8 * static_cast<std::size_t>(i));
      if (i % 4 == 0) scale_[i / 4] = value;
      if (i % 4 == 0 ? !(value > 0) : value != 0)
        throw bytes_.wrong(element_, "its voxels are turned, mirrored or sheared",
                           "resample it along the axes of the world");
    }
    for (int a = 0; a < 3; ++a)
      offset_[a] = at<double>(NanoLayout::kOffset + 8 * static_cast<std::size_t>(a));
    leaves_ = nodes(0, NanoLayout::kLeaf);
    lower_ = nodes(1, NanoLayout::kLower);
    upper_ = nodes(2, NanoLayout::kUpper);
    std::uint64_t voxels = 0; // that tiles fill: they do not overlap, unless the file is hostile
    each_value([&](const auto& first, const auto& last, float) {
      active_.grow(first, last);
      const auto side = static_cast<std::uint64_t>(last[0] - first[0] + 1);
      voxels += side * side * side;
      if (side > 1 && voxels > VolumeGrid::kMaxCells)
        throw limit_error({file}, element_, "its tiles have more voxels than are read",
                          "make the grid coarser, or crop it");
    });
    if (active_.empty()) throw bytes_.wrong(element_, "no voxel of it is active", "give a grid with values");
  }

  const VoxelBox& active() const { return active_; }
  Bounds3 world(const VoxelBox& box) const {
    glm::dvec3 lo, hi;
    for (int a = 0; a < 3; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      lo[a] = scale_[a] * (static_cast<double>(box.lo[axis]) - 0.5) + offset_[a];
      hi[a] = scale_[a] * (static_cast<double>(box.hi[axis]) + 0.5) + offset_[a];
    }
    return checked_volume_bounds(bytes_.file(), lo, hi);
  }
  bool has_voxels_of(const NanoTree& other) const {
    return scale_ == other.scale_ && offset_ == other.offset_;
  }
  std::vector<float> dense(const VoxelBox& box) {
    std::vector<float> out(static_cast<std::size_t>(box.side(0) * box.side(1) * box.side(2)), 0.0f);
    each_value([&](const auto& first, const auto& last, float value) {
      fill_voxels(out, box, first, last, &value, 1);
    });
    return out;
  }

private:
  using Index3 = std::array<std::int64_t, 3>;
  struct Nodes {
    std::size_t begin = 0, count = 0;
  };

  template <class T>
  T at(std::size_t place) {
    bytes_.seek(place);
    return bytes_.value<T>();
  }

  /// The nodes of a level; all are within the bytes.
  Nodes nodes(std::size_t level, std::size_t size) {
    const auto offset = at<std::uint64_t>(NanoLayout::kGrid + 8 * level);
    const std::uint64_t count = at<std::uint32_t>(NanoLayout::kGrid + 32 + 4 * level);
    if (count == 0) return {};
    bytes_.seek(NanoLayout::kGrid);
    bytes_.take(offset);
    const std::size_t begin = bytes_.position();
    bytes_.take(count * size);
    return {begin, static_cast<std::size_t>(count)};
  }

  /// Calls use(first, last, value) for all active values: voxels and tiles.
  template <class Use>
  void each_value(Use use) {
    each_tile(upper_, NanoLayout::kUpper, 5, 7, use);
    each_tile(lower_, NanoLayout::kLower, 4, 3, use);
    for (std::size_t n = 0; n < leaves_.count; ++n) {
      if (n % 256 == 0) warnings_.check_stop();
      const Index3 origin = node_origin(leaves_.begin + n * NanoLayout::kLeaf, 3);
      bytes_.seek(leaves_.begin + n * NanoLayout::kLeaf + NanoLayout::kLeafMask);
      const ByteView mask = bytes_.take(64);
      bytes_.seek(leaves_.begin + n * NanoLayout::kLeaf + NanoLayout::kLeafValues);
      const ByteView values = bytes_.take(2048);
      for (int i = 0; i < 512; ++i) {
        if (!mask_bit(mask, i)) continue;
        float value;
        std::memcpy(&value, values.data() + 4 * i, sizeof(value));
        const Index3 place = place_in_node(i, 3);
        const Index3 voxel{origin[0] + place[0], origin[1] + place[1], origin[2] + place[2]};
        use(voxel, voxel, value);
      }
    }
  }

  template <class Use>
  void each_tile(Nodes list, std::size_t size, int bits, int child_bits, Use use) {
    const int count = 1 << (3 * bits);
    const auto mask_bytes = static_cast<std::uint64_t>(count) / 8;
    const std::int64_t side = std::int64_t{1} << child_bits;
    for (std::size_t n = 0; n < list.count; ++n) {
      warnings_.check_stop();
      const std::size_t node = list.begin + n * size;
      const Index3 origin = node_origin(node, bits + child_bits);
      bytes_.seek(node + NanoLayout::kNodeMask);
      const ByteView active = bytes_.take(mask_bytes), children = bytes_.take(mask_bytes);
      const std::size_t table = node + size - 8 * static_cast<std::size_t>(count);
      for (int i = 0; i < count; ++i) {
        if (!mask_bit(active, i) || mask_bit(children, i)) continue;
        const Index3 place = place_in_node(i, bits);
        const Index3 first{origin[0] + side * place[0], origin[1] + side * place[1],
                           origin[2] + side * place[2]};
        use(first, Index3{first[0] + side - 1, first[1] + side - 1, first[2] + side - 1},
            at<float>(table + 8 * static_cast<std::size_t>(i)));
      }
    }
  }

  /// Of a node whose side is 2^bits: its box begins in it.
  Index3 node_origin(std::size_t node, int bits) {
    bytes_.seek(node);
    Index3 origin;
    for (auto& coordinate : origin)
      coordinate = std::int64_t{bytes_.value<std::int32_t>()} & ~((std::int64_t{1} << bits) - 1);
    return origin;
  }

  VolumeBytes bytes_;
  std::string element_;
  const WarningList& warnings_;
  glm::dvec3 scale_{1}, offset_{0};
  Nodes leaves_, lower_, upper_;
  VoxelBox active_;
};

/// The grids of floats, by name; of the first segment.
std::vector<NanoGrid> nano_grids(VolumeBytes bytes, const WarningList& warnings) {
  bytes.take(12); // magic number and version
  const auto count = bytes.value<std::uint16_t>(), codec = bytes.value<std::uint16_t>();
  if (codec > 2) throw bytes.wrong("header", "it is compressed in an unknown way");
  struct Entry {
    std::string name;
    std::uint64_t size, stored;
    std::uint32_t type;
  };
  std::vector<Entry> entries;
  for (int i = 0; i < count; ++i) {
    Entry entry;
    entry.size = bytes.value<std::uint64_t>(), entry.stored = bytes.value<std::uint64_t>();
    bytes.take(16); // hash of the name, voxels
    entry.type = bytes.value<std::uint32_t>();
    bytes.take(4 + 48 + 24 + 24);
    const auto name_size = bytes.value<std::uint32_t>();
    bytes.take(16 + 12 + 8);
    const ByteView name = bytes.take(name_size);
    for (std::uint8_t c : name.first(std::min<std::size_t>(name.size(), 60)))
      if (c != 0) entry.name += c >= ' ' && c < 127 ? static_cast<char>(c) : '?';
    entries.push_back(std::move(entry));
  }
  std::vector<NanoGrid> grids;
  for (const Entry& entry : entries) {
    warnings.check_stop();
    VolumeBytes packed = bytes;
    const ByteView stored = bytes.take(entry.stored);
    if (entry.type != NanoLayout::kFloat) continue;
    const auto damaged = [&] { return bytes.wrong(fmt::format("grid '{}'", entry.name), "it is damaged"); };
    constexpr std::uint64_t kMostRatio = 1100; // of zlib; LZ4's is less
    if (entry.size > std::uint64_t{1} << 33 || entry.size / kMostRatio > stored.size()) throw damaged();
    NanoGrid grid{entry.name, {}};
    if (codec == 0) {
      if (stored.size() != entry.size) throw damaged();
      grid.bytes.assign(stored.begin(), stored.end());
    } else {
      grid.bytes.resize(static_cast<std::size_t>(entry.size));
      std::span<std::uint8_t> left = grid.bytes;
      while (!left.empty()) {
        const ByteView chunk = packed.take(packed.value<std::uint64_t>());
        std::uint32_t size = 0;
        if (codec == 2 && chunk.size() >= 16) std::memcpy(&size, chunk.data() + 4, sizeof(size));
        const std::size_t here = codec == 1 ? left.size() : size;
        if (here == 0 || here > left.size()) throw damaged();
        if (!(codec == 1 ? decompress_zlib(chunk, left.first(here))
                         : decompress_blosc(chunk, left.first(here))))
          throw damaged();
        left = left.subspan(here);
      }
    }
    grids.push_back(std::move(grid));
  }
  return grids;
}

} // namespace

bool is_nanovdb(ByteView bytes) {
  return bytes.size() >= sizeof(kNanoMagic) &&
         std::memcmp(bytes.data(), &kNanoMagic, sizeof(kNanoMagic)) == 0;
}

VolumeGrid parse_nanovdb(ByteView all, const std::string& file, WarningList& warnings) {
  const VolumeBytes bytes(all, file);
  const std::vector<NanoGrid> grids = nano_grids(bytes, warnings);
  const auto named = [&](std::initializer_list<std::string_view> names) -> const NanoGrid* {
    for (std::string_view name : names)
      for (const NanoGrid& grid : grids)
        if (grid.name == name) return &grid;
    return nullptr;
  };
  if (grids.empty())
    throw bytes.wrong("grids", "none has floats that are not quantised", "give a grid 'density' of floats");
  const NanoGrid* density = named({"density"});
  if (density == nullptr) {
    density = &grids.front();
    warnings.add({file}, fmt::format("there is no grid 'density': '{}' is taken", density->name));
  }
  NanoTree tree(*density, file, warnings);
  const VoxelBox& box = tree.active();
  check_volume_cells(file, box.side(0), box.side(1), box.side(2));
  VolumeGrid out;
  for (int a = 0; a < 3; ++a) out.cells[a] = static_cast<int>(box.side(static_cast<std::size_t>(a)));
  out.bounds = tree.world(box);
  out.density = tree.dense(box);
  if (const NanoGrid* hot = named({"temperature", "flame", "flames", "heat"});
      hot != nullptr && hot != density) {
    NanoTree heat(*hot, file, warnings);
    if (heat.has_voxels_of(tree))
      out.temperature = heat.dense(box);
    else
      warnings.add({file}, fmt::format("grid '{}': its voxels are not those of the density: it is left out",
                                       hot->name));
  }
  return out;
}

} // namespace candela
