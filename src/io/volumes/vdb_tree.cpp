#include "io/volumes/vdb_tree.h"

#include "io/volumes/blosc.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>

namespace candela {

namespace {

int bits_set(ByteView mask) {
  int count = 0;
  for (std::uint8_t byte : mask) count += std::popcount(byte);
  return count;
}

} // namespace

VdbTree::VdbTree(VolumeBytes bytes, VdbValueType type, VdbPacking packing, std::string element,
                 const WarningList& warnings)
    : bytes_(bytes), type_(type), packing_(packing), element_(std::move(element)), warnings_(warnings) {
  read_root();
  buffers_ = bytes_.position();
}

Error VdbTree::wrong(std::string_view cause) const {
  return bytes_.wrong(element_, cause, "save it again from the program that made it");
}

VdbTree::Value VdbTree::read_value() {
  Value value{};
  for (int c = 0; c < type_.components; ++c)
    value[static_cast<std::size_t>(c)] =
        type_.is_double ? static_cast<float>(bytes_.value<double>()) : bytes_.value<float>();
  return value;
}

void VdbTree::read_root() {
  if (bytes_.value<std::int32_t>() != 1) throw wrong("it has several buffers");
  background_ = read_value();
  const auto tiles = bytes_.value<std::uint32_t>(), children = bytes_.value<std::uint32_t>();
  constexpr int kTopBits = 5, kBelowTop = 4 + kLeafBits;
  const auto origin = [&] {
    Index3 o;
    for (auto& coordinate : o) coordinate = bytes_.value<std::int32_t>();
    return o;
  };
  for (std::uint32_t i = 0; i < tiles; ++i) {
    const Index3 o = origin();
    const Value value = read_value();
    if (bytes_.value<std::uint8_t>() != 0) add_tile(o, std::int64_t{1} << (kTopBits + kBelowTop), value);
  }
  for (std::uint32_t i = 0; i < children; ++i) read_node(origin(), kTopBits, kBelowTop);
}

void VdbTree::add_tile(const Index3& origin, std::int64_t side, const Value& value) {
  // Tiles do not overlap, unless the file is made to keep readers busy.
  tile_voxels_ += static_cast<std::uint64_t>(side * side * side);
  if (tile_voxels_ > VolumeGrid::kMaxCells)
    throw limit_error(
        {bytes_.file()}, element_,
        fmt::format("its tiles have more than the {} voxels that are read", VolumeGrid::kMaxCells),
        "make the grid coarser, or crop it");
  active_.grow(origin, {origin[0] + side - 1, origin[1] + side - 1, origin[2] + side - 1});
  tiles_.push_back({origin, side, value});
}

void VdbTree::read_node(const Index3& origin, int bits, int child_bits_in_all) {
  if (++nodes_ % 64 == 0) warnings_.check_stop();
  const int count = 1 << (3 * bits);
  const auto mask_bytes = static_cast<std::uint64_t>(count) / 8;
  const Mask children = bytes_.take(mask_bytes), active = bytes_.take(mask_bytes);
  read_values(count, active);
  const std::int64_t side = std::int64_t{1} << child_bits_in_all;
  const auto origin_of = [&](int i) {
    const Index3 place = place_in_node(i, bits);
    return Index3{origin[0] + side * place[0], origin[1] + side * place[1], origin[2] + side * place[2]};
  };
  for (int i = 0; i < count; ++i)
    if (mask_bit(active, i) && !mask_bit(children, i)) {
      Value value{};
      for (int c = 0; c < type_.components; ++c)
        value[static_cast<std::size_t>(c)] = values_[static_cast<std::size_t>(i * type_.components + c)];
      add_tile(origin_of(i), side, value);
    }
  for (int i = 0; i < count; ++i) {
    if (!mask_bit(children, i)) continue;
    if (child_bits_in_all == kLeafBits)
      read_leaf(origin_of(i));
    else
      read_node(origin_of(i), 4, kLeafBits);
  }
}

void VdbTree::read_leaf(const Index3& origin) {
  const Mask active = bytes_.take(kLeafValues / 8);
  leaves_.push_back({origin, active});
  for (int i = 0; i < kLeafValues; ++i) {
    if (!mask_bit(active, i)) continue;
    const Index3 place = place_in_node(i, kLeafBits);
    const Index3 voxel{origin[0] + place[0], origin[1] + place[1], origin[2] + place[2]};
    active_.grow(voxel, voxel);
  }
}

void VdbTree::unpack(int count) {
  const int scalars = count * type_.components;
  const std::size_t size = type_.is_half ? 2 : type_.is_double ? 8 : 4;
  raw_.resize(static_cast<std::size_t>(scalars) * size);
  packed_.resize(static_cast<std::size_t>(scalars));
  if (scalars == 0 && type_.is_half) return; // not even their size is stored
  if ((packing_.flags & (VdbPacking::kBlosc | VdbPacking::kZip)) != 0) {
    const auto length = bytes_.value<std::int64_t>();
    if (length > 0) {
      const ByteView in = bytes_.take(static_cast<std::uint64_t>(length));
      const bool blosc = (packing_.flags & VdbPacking::kBlosc) != 0;
      if (!(blosc ? decompress_blosc(in, raw_) : decompress_zlib(in, raw_)))
        throw wrong(blosc ? "values are not compressed by Blosc with LZ4 or zlib, or damaged"
                          : "compressed values are damaged");
    } else {
      if (static_cast<std::uint64_t>(-(length + 1)) + 1 != raw_.size())
        throw wrong("values have the wrong size");
      std::ranges::copy(bytes_.take(raw_.size()), raw_.begin());
    }
  } else {
    std::ranges::copy(bytes_.take(raw_.size()), raw_.begin());
  }
  for (std::size_t i = 0; i < packed_.size(); ++i) {
    const std::uint8_t* from = raw_.data() + i * size;
    if (type_.is_half) {
      std::uint16_t half;
      std::memcpy(&half, from, sizeof(half));
      packed_[i] = glm::unpackHalf1x16(half);
    } else if (type_.is_double) {
      double value;
      std::memcpy(&value, from, sizeof(value));
      packed_[i] = static_cast<float>(value);
    } else {
      std::memcpy(&packed_[i], from, sizeof(float));
    }
  }
}

void VdbTree::read_values(int count, Mask active) {
  // Which values are there that are not active: none but the background, its negative, or up to two more.
  enum Stored : std::int8_t {
    kBackground,
    kMinusBackground,
    kOneValue,
    kMaskOfSigns,
    kMaskAndOneValue,
    kMaskAndTwoValues,
    kAll
  };
  const auto stored = bytes_.value<std::int8_t>();
  if (stored < kBackground || stored > kAll) throw wrong("its values are stored in an unknown way");
  const auto components = static_cast<std::size_t>(type_.components);
  Value inactive[2] = {background_, background_};
  if (stored != kBackground)
    for (float& v : inactive[0]) v = -v;
  if (stored == kOneValue || stored == kMaskAndOneValue || stored == kMaskAndTwoValues)
    inactive[0] = read_value();
  if (stored == kMaskAndTwoValues) inactive[1] = read_value();
  Mask second;
  if (stored == kMaskOfSigns || stored == kMaskAndOneValue || stored == kMaskAndTwoValues)
    second = bytes_.take(static_cast<std::uint64_t>(count) / 8);
  const bool only_active = (packing_.flags & VdbPacking::kActiveMask) != 0 && stored != kAll;
  unpack(only_active ? bits_set(active) : count);
  if (!only_active) {
    values_.swap(packed_);
    return;
  }
  values_.resize(static_cast<std::size_t>(count) * components);
  std::size_t next = 0;
  for (int i = 0; i < count; ++i) {
    float* out = values_.data() + static_cast<std::size_t>(i) * components;
    const float* from = inactive[!second.empty() && mask_bit(second, i) ? 1 : 0].data();
    if (mask_bit(active, i)) from = packed_.data() + components * next++;
    std::copy_n(from, components, out);
  }
}

void fill_voxels(std::vector<float>& out, const VoxelBox& box, const std::array<std::int64_t, 3>& first,
                 const std::array<std::int64_t, 3>& last, const float* value, int components) {
  std::array<std::int64_t, 3> lo, hi;
  for (std::size_t a = 0; a < 3; ++a)
    lo[a] = std::max(first[a], box.lo[a]) - box.lo[a], hi[a] = std::min(last[a], box.hi[a]) - box.lo[a];
  for (std::int64_t z = lo[2]; z <= hi[2]; ++z)
    for (std::int64_t y = lo[1]; y <= hi[1]; ++y)
      for (std::int64_t x = lo[0]; x <= hi[0]; ++x) {
        const std::int64_t cell = (z * box.side(1) + y) * box.side(0) + x;
        std::copy_n(value, components, out.begin() + cell * components);
      }
}

std::vector<float> VdbTree::dense(const VoxelBox& box) {
  const auto cells = static_cast<std::size_t>(box.side(0) * box.side(1) * box.side(2));
  const auto components = static_cast<std::size_t>(type_.components);
  std::vector<float> out(cells * components, background_[0]);
  for (std::size_t c = 1; c < components; ++c)
    for (std::size_t i = 0; i < cells; ++i) out[i * components + c] = background_[c];
  for (const Tile& tile : tiles_) {
    warnings_.check_stop();
    const Index3 last{tile.origin[0] + tile.side - 1, tile.origin[1] + tile.side - 1,
                      tile.origin[2] + tile.side - 1};
    fill_voxels(out, box, tile.origin, last, tile.value.data(), type_.components);
  }
  bytes_.seek(buffers_);
  for (std::size_t l = 0; l < leaves_.size(); ++l) {
    if (l % 256 == 0) warnings_.check_stop();
    const Leaf& leaf = leaves_[l];
    bytes_.take(kLeafValues / 8); // the mask again
    read_values(kLeafValues, leaf.active);
    for (int i = 0; i < kLeafValues; ++i) {
      const Index3 place = place_in_node(i, kLeafBits);
      const Index3 voxel{leaf.origin[0] + place[0], leaf.origin[1] + place[1], leaf.origin[2] + place[2]};
      fill_voxels(out, box, voxel, voxel, values_.data() + static_cast<std::size_t>(i) * components,
                  type_.components);
    }
  }
  return out;
}

} // namespace candela
