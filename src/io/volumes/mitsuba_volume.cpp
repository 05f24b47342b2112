// Mitsuba's volumes (Jakob 2010, "Mitsuba Renderer", documentation of the plugin gridvolume): "VOL", a byte
// 3, the encoding, cells along x, y and z, and channels as int32, six floats of the box, then the values, x
// fastest.

#include "io/volumes/volume_bytes.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

namespace candela {

namespace {

constexpr std::string_view kMitsubaMagic = "VOL";
enum MitsubaEncoding : int { kFloat32 = 1, kFloat16 = 2, kUint8 = 3 };

} // namespace

bool is_mitsuba_volume(ByteView bytes) {
  return bytes.size() >= kMitsubaMagic.size() &&
         std::memcmp(bytes.data(), kMitsubaMagic.data(), kMitsubaMagic.size()) == 0;
}

VolumeGrid parse_mitsuba_volume(ByteView all, const std::string& file, WarningList& warnings) {
  VolumeBytes bytes(all, file);
  bytes.take(kMitsubaMagic.size());
  if (const int version = bytes.value<std::uint8_t>(); version != 3)
    throw bytes.wrong("version", fmt::format("{} is not known", version), "give a volume of version 3");
  const auto encoding = bytes.value<std::int32_t>();
  if (encoding != kFloat32 && encoding != kFloat16 && encoding != kUint8)
    throw bytes.wrong("encoding", fmt::format("{} is not known", encoding),
                      "give float32 (1), float16 (2) or uint8 (3) values");
  VolumeGrid grid;
  for (int a = 0; a < 3; ++a) grid.cells[a] = bytes.value<std::int32_t>();
  check_volume_cells(file, grid.cells.x, grid.cells.y, grid.cells.z);
  if (const auto channels = bytes.value<std::int32_t>(); channels != 1)
    throw bytes.wrong("channels", fmt::format("{} of them are no density", channels),
                      "give a volume of one channel; a colour is the medium's albedo");
  float corners[6];
  for (float& corner : corners) corner = bytes.value<float>();
  grid.bounds =
      checked_volume_bounds(file, {corners[0], corners[1], corners[2]}, {corners[3], corners[4], corners[5]});
  const std::uint64_t count = grid.cell_count();
  const std::uint64_t size = encoding == kFloat32 ? 4 : encoding == kFloat16 ? 2 : 1;
  const ByteView values = bytes.take(count * size);
  grid.density.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < grid.density.size(); ++i) {
    if (i % (1 << 20) == 0) warnings.check_stop();
    const std::uint8_t* value = values.data() + i * size;
    if (encoding == kUint8) {
      grid.density[i] = static_cast<float>(*value) / 255;
    } else if (encoding == kFloat16) {
      std::uint16_t half;
      std::memcpy(&half, value, sizeof(half));
      grid.density[i] = glm::unpackHalf1x16(half);
    } else {
      std::memcpy(&grid.density[i], value, sizeof(float));
    }
  }
  if (bytes.left() > 0)
    warnings.add({file}, fmt::format("{} bytes that are left over are ignored", bytes.left()));
  return grid;
}

} // namespace candela
