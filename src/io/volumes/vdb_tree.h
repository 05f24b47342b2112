#pragma once
// The tree of a grid in an OpenVDB file (Museth 2013, "VDB: High-Resolution Sparse Volumes with Dynamic
// Topology"): a root, nodes of 32^3 and 16^3 children, and leaves of 8^3 voxels.

#include "io/volumes/volume_bytes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace candela {

/// What the voxels of a tree are.
struct VdbValueType {
  int components = 1; ///< 1 or 3
  bool is_double = false;
  bool is_half = false; ///< in the file, where values are packed
};

/// How values are packed: flags of OpenVDB.
struct VdbPacking {
  static constexpr std::uint32_t kZip = 1, kActiveMask = 2, kBlosc = 4;
  std::uint32_t flags = 0;
};

/// Voxels of a box of a grid, in index space; `hi` is inside.
struct VoxelBox {
  std::array<std::int64_t, 3> lo{INT64_MAX, INT64_MAX, INT64_MAX}, hi{INT64_MIN, INT64_MIN, INT64_MIN};
  bool empty() const { return lo[0] > hi[0]; }
  std::int64_t side(std::size_t axis) const { return hi[axis] - lo[axis] + 1; }
  void grow(const std::array<std::int64_t, 3>& first, const std::array<std::int64_t, 3>& last) {
    for (std::size_t a = 0; a < 3; ++a) lo[a] = std::min(lo[a], first[a]), hi[a] = std::max(hi[a], last[a]);
  }
};

/// Sets the voxels from `first` to `last` (inside) that are in the box, of values in the order of
/// VdbTree::dense().
void fill_voxels(std::vector<float>& out, const VoxelBox& box, const std::array<std::int64_t, 3>& first,
                 const std::array<std::int64_t, 3>& last, const float* value, int components);

/// Of bit masks of nodes.
inline bool mask_bit(ByteView mask, int i) {
  return ((mask[static_cast<std::size_t>(i) / 8] >> (i % 8)) & 1) != 0;
}
/// Place of a node's i-th value in it, of 2^bits values along each axis; z fastest.
inline std::array<std::int64_t, 3> place_in_node(int i, int bits) {
  const int low = (1 << bits) - 1;
  return {i >> (2 * bits), (i >> bits) & low, i & low};
}

class VdbTree {
public:
  /// Reads the topology at the place of `bytes`, which must outlive this. Throws input_error, limit_error and
  /// Cancelled. `element` is the grid in messages.
  VdbTree(VolumeBytes bytes, VdbValueType type, VdbPacking packing, std::string element,
          const WarningList& warnings);

  /// What its active voxels and tiles fill.
  const VoxelBox& active() const { return active_; }

  /// The values in the box, `components` floats a voxel, x fastest; all of a leaf's voxels, active tiles, and
  /// elsewhere the background. The box must not have more than VolumeGrid::kMaxCells voxels.
  std::vector<float> dense(const VoxelBox& box);

private:
  static constexpr int kLeafBits = 3;
  static constexpr int kLeafValues = 1 << (3 * kLeafBits);
  using Index3 = std::array<std::int64_t, 3>;
  using Value = std::array<float, 3>;
  using Mask = ByteView; ///< a bit for each value

  struct Leaf {
    Index3 origin;
    Mask active;
  };
  struct Tile {
    Index3 origin;
    std::int64_t side;
    Value value;
  };

  void read_root();
  void read_node(const Index3& origin, int bits, int child_bits_in_all);
  void read_leaf(const Index3& origin);
  void add_tile(const Index3& origin, std::int64_t side, const Value& value);
  Value read_value();
  /// `count` values of a node, into values_.
  void read_values(int count, Mask active);
  /// Of `count` values as they are stored, into packed_.
  void unpack(int count);
  Error wrong(std::string_view cause) const;

  VolumeBytes bytes_;
  VdbValueType type_;
  VdbPacking packing_;
  std::string element_;
  const WarningList& warnings_;
  Value background_{};
  VoxelBox active_;
  std::vector<Leaf> leaves_;
  std::vector<Tile> tiles_;
  std::size_t buffers_ = 0; ///< place where the leaves' values begin
  std::vector<float> values_;
  std::vector<float> packed_;
  Bytes raw_;
  std::size_t nodes_ = 0;
  std::uint64_t tile_voxels_ = 0;
};

} // namespace candela
