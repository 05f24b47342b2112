// Volumes of every format: what is written is read again, and damage is told. The files in data/ were written
// by OpenVDB and NanoVDB 10.0.1: with known values, other compressions, half floats, and a tile.

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/volumes/blosc.h"
#include "io/volumes/cvol_file.h"
#include "io/volumes/volume_reader.h"
#include "support/scratch_folder.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

namespace candela::test {
namespace {

std::string data(const std::string& name) { return CANDELA_TEST_SOURCE_DIR "/tests/io/volumes/data/" + name; }

std::string text_of(const std::vector<Warning>& warnings) {
  std::string text;
  for (const Warning& warning : warnings) text += warning.text + "\n";
  return text;
}

VolumeGrid parsed(const std::string& bytes, std::string* warned = nullptr) {
  WarningList warnings;
  VolumeGrid grid =
      parse_volume({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "v", warnings);
  if (warned != nullptr) *warned = text_of(warnings.warnings());
  return grid;
}

/// The error of bytes that are refused; "" if they are not.
std::string error_of(const std::string& bytes) {
  try {
    parsed(bytes);
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::limit);
    return error.what();
  }
  return "";
}

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
  std::string out;
  for (T value : values) out.append(reinterpret_cast<const char*>(&value), sizeof(value));
  return out;
}

std::string mitsuba(int encoding, glm::ivec3 cells, int channels, const std::string& values) {
  return "VOL\3" + bytes_of<std::int32_t>({encoding, cells.x, cells.y, cells.z, channels}) +
         bytes_of<float>({-1, 0, 1, 2, 3, 4}) + values;
}

TEST(CvolFile, ReadsWhatItWrites) {
  ScratchFolder folder;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> share(0, 1);
  for (bool hot : {false, true})
    for (bool colored : {false, true}) {
      VolumeGrid grid;
      grid.cells = {3, 4, 5};
      grid.bounds = {{-1, 0.1f, 2}, {1 / 3.0f, 5, 1e6f}};
      for (int i = 0; i < 60; ++i) {
        grid.density.push_back(5 * share(random));
        if (hot) grid.temperature.push_back(share(random));
        if (colored) grid.color.emplace_back(share(random), share(random), share(random));
      }
      write_cvol(grid, folder / "g.cvol");
      WarningList warnings;
      grid.source = folder / "g.cvol";
      EXPECT_EQ(*read_volume(folder / "g.cvol", warnings), grid);
      EXPECT_EQ(text_of(warnings.warnings()), "");
    }
}

TEST(CvolFile, IsLaidOutAsDescribed) {
  const VolumeGrid grid =
      parsed("candela volume 1\ncells 2 1 1\nchannels density\ndata\n" + bytes_of<float>({0.25f, 4}));
  EXPECT_EQ(grid.cells, glm::ivec3(2, 1, 1));
  EXPECT_EQ(grid.density, (std::vector<float>{0.25f, 4}));
  EXPECT_EQ(grid.bounds, (Bounds3{vec3(-1), vec3(1)}));
}

TEST(CvolFile, DamageIsTold) {
  const std::string two = bytes_of<float>({1, 1});
  const struct {
    std::string bytes;
    const char* said;
  } kCases[] = {
      {"candela volume 2\ncells 2 1 1\nchannels density\ndata\n" + two, "v:1: version: only 1 is known"},
      {"candela volume 1\ncells 2 1\nchannels density\ndata\n" + two, "v:2: cells: 2 values instead of 3"},
      {"candela volume 1\ncells 2 1 x\nchannels density\ndata\n" + two, "v:2: cells: 'x' is no number"},
      {"candela volume 1\ncells 2 0 1\nchannels density\ndata\n" + two, "v: cells: 2 x 0 x 1 has no cell"},
      {"candela volume 1\ncells -2 1 1\nchannels density\ndata\n" + two, "cells: -2 x 1 x 1"},
      {"candela volume 1\ncells 2000000000 2000000000 2000000000\nchannels density\ndata\n" + two,
       "are more than the 268435456 that are read: make the grid coarser"},
      {"candela volume 1\ncells 2 1 2\nchannels density\ndata\n" + two, "the file ends early"},
      {"candela volume 1\ncells 1 1 1\nchannels density\ndata\n" + two, "4 bytes are left over"},
      {"candela volume 1\ncells 2 1 1\nchannels temperature\ndata\n" + two, "there is no density"},
      {"candela volume 1\ncells 2 1 1\nchannels density density\ndata\n" + two, "'density' is there twice"},
      {"candela volume 1\ncells 2 1 1\nchannels heat\ndata\n" + two, "there is no channel 'heat'"},
      {"candela volume 1\nbounds 0 0 0 0 1 1\ncells 2 1 1\nchannels density\ndata\n" + two, "v: bounds: "},
      {"candela volume 1\nbounds 0 0 0 nan 1 1\ncells 2 1 1\nchannels density\ndata\n" + two, "v: bounds: "},
      {"candela volume 1\nsize 2\n", "'size' is not known"},
      {"candela volume 1\n" + std::string(9000, 'x'), "there is no line 'data'"},
      {"candela volume 1\n\n", "an empty line"},
      {"candela volume", "it is in no known format: give"},
      {"", "it is in no known format"},
  };
  for (const auto& one : kCases)
    EXPECT_NE(error_of(one.bytes).find(one.said), std::string::npos) << error_of(one.bytes);
}

TEST(Volumes, ValuesThatAreNoAmountsAreCounted) {
  std::string warned;
  const float nan = std::nanf("");
  const VolumeGrid grid =
      parsed("candela volume 1\ncells 4 1 1\nchannels density temperature color\ndata\n" +
                 bytes_of<float>({1, -2, nan, INFINITY}) + bytes_of<float>({0, 500, 1000, -1}) +
                 bytes_of<float>({0, 1, 2, nan, -1, 0.5f, 0, 0, 0, 1, 1, 1}),
             &warned);
  EXPECT_EQ(grid.density, (std::vector<float>{1, 0, 0, 0}));
  EXPECT_EQ(grid.temperature, (std::vector<float>{0, 0.5f, 1, 0}));
  EXPECT_EQ(grid.color, (std::vector<vec3>{{0, 1, 1}, {0, 0, 0.5f}, vec3(0), vec3(1)}));
  EXPECT_EQ(warned, "v: density: 3 of 4 values are negative, infinite or undefined: taken for 0\n"
                    "v: temperature: 1 of 4 values are negative, infinite or undefined: taken for 0\n"
                    "v: temperature: divided by the largest value, 1000\n"
                    "v: color: 2 of 4 values are not in [0, 1]: moved into it\n");
}

TEST(MitsubaVolume, EveryEncodingIsRead) {
  const glm::ivec3 cells(2, 1, 2);
  const VolumeGrid floats = parsed(mitsuba(1, cells, 1, bytes_of<float>({0, 1, 2, 3.5f})));
  EXPECT_EQ(floats.density, (std::vector<float>{0, 1, 2, 3.5f}));
  EXPECT_EQ(floats.bounds, (Bounds3{{-1, 0, 1}, {2, 3, 4}}));
  EXPECT_EQ(floats.cells, cells);
  EXPECT_EQ(parsed(mitsuba(2, cells, 1, bytes_of<std::uint16_t>({0, 0x3c00, 0x3800, 0x4200}))).density,
            (std::vector<float>{0, 1, 0.5f, 3}));
  EXPECT_EQ(parsed(mitsuba(3, cells, 1, bytes_of<std::uint8_t>({0, 255, 51, 0}))).density,
            (std::vector<float>{0, 1, 0.2f, 0}));
}

TEST(MitsubaVolume, DamageIsTold) {
  const std::string one = bytes_of<float>({1});
  EXPECT_NE(error_of("VOL\2" + one).find("version: 2 is not known"), std::string::npos);
  EXPECT_NE(error_of(mitsuba(4, {1, 1, 1}, 1, one)).find("encoding: 4"), std::string::npos);
  EXPECT_NE(error_of(mitsuba(1, {1, 1, 1}, 3, one + one + one)).find("channels: 3 of them are no density"),
            std::string::npos);
  EXPECT_NE(error_of(mitsuba(1, {-1, 1, 1}, 1, one)).find("cells: -1"), std::string::npos);
  EXPECT_NE(error_of(mitsuba(1, {1 << 30, 1 << 30, 1 << 30}, 1, one)).find("more than"), std::string::npos);
  EXPECT_NE(error_of(mitsuba(1, {2, 1, 1}, 1, one)).find("ends early"), std::string::npos);
  EXPECT_NE(error_of("VOL\3").find("ends early"), std::string::npos);
}

TEST(MitsubaVolume, OneOfMitsubaIsRead) {
  const std::string path = CANDELA_SHARED_DATA "/mitsuba/reference/participating_media/textures/sigmat.vol";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  WarningList warnings;
  const auto grid = read_volume(path, warnings);
  EXPECT_EQ(grid->cells, glm::ivec3(16));
  EXPECT_EQ(text_of(warnings.warnings()), "");
  EXPECT_GT(grid->density[0], 0.4f);
}

/// What the files of data/ hold, voxels of 1/4 unit.
float known_density(glm::ivec3 p) {
  const glm::ivec3 q = p - glm::ivec3(0, 0, 3);
  if (p.x > 16 || p.z < 3) return 0;
  return static_cast<float>((q.x + 17 * (q.y + 9 * q.z)) % 97) / 64;
}
float known_temperature(glm::ivec3 p) {
  const glm::ivec3 q = p - glm::ivec3(0, 0, 3);
  const int k = q.x + 17 * (q.y + 9 * q.z);
  return p.x > 16 || p.z < 3 || k % 3 == 0 ? 0 : static_cast<float>(k % 31) / 16;
}

void expect_known(const VolumeGrid& grid, glm::ivec3 first, bool half, bool tile) {
  const float hottest = 30.0f / 16;
  std::size_t cell = 0;
  for (int z = 0; z < grid.cells.z; ++z)
    for (int y = 0; y < grid.cells.y; ++y)
      for (int x = 0; x < grid.cells.x; ++x, ++cell) {
        const glm::ivec3 p = first + glm::ivec3(x, y, z);
        const bool in_tile = tile && p.x >= 16 && p.y <= 7 && p.z <= 7;
        const float density = in_tile ? 0.75f : known_density(p);
        ASSERT_NEAR(grid.density[cell], density, half ? 1e-3f * density : 0)
            << p.x << ' ' << p.y << ' ' << p.z;
        if (!grid.temperature.empty()) {
          ASSERT_NEAR(grid.temperature[cell], known_temperature(p) / hottest, 1e-6f);
        }
      }
}

TEST(OpenVdb, FilesOfTheLibraryAreRead) {
  WarningList warnings;
  const auto zip = read_volume(data("zip.vdb"), warnings);
  EXPECT_EQ(zip->cells, glm::ivec3(17, 9, 11));
  EXPECT_EQ(zip->bounds, (Bounds3{{0.875f, 1.875f, 3.625f}, {5.125f, 4.125f, 6.375f}}));
  EXPECT_FALSE(zip->temperature.empty());
  expect_known(*zip, {0, 0, 3}, false, false);
  const auto blosc = read_volume(data("blosc_half_tile.vdb"), warnings);
  EXPECT_EQ(blosc->cells, glm::ivec3(24, 9, 14));
  expect_known(*blosc, {0, 0, 0}, true, true);
}

TEST(NanoVdb, FilesOfTheLibraryAreRead) {
  for (const char* name : {"zip.nvdb", "blosc.nvdb"}) {
    WarningList warnings;
    const auto grid = read_volume(data(name), warnings);
    EXPECT_EQ(grid->cells, glm::ivec3(17, 9, 11));
    EXPECT_EQ(grid->bounds, (Bounds3{{0.875f, 1.875f, 3.625f}, {5.125f, 4.125f, 6.375f}}));
    expect_known(*grid, {0, 0, 3}, false, false);
  }
}

/// With another text of the same length.
std::string with(std::string bytes, const std::string& before, const std::string& after) {
  EXPECT_EQ(before.size(), after.size());
  for (std::size_t at = 0; (at = bytes.find(before, at)) != std::string::npos;)
    bytes.replace(at, before.size(), after);
  return bytes;
}

TEST(OpenVdb, WhatIsNotReadIsTold) {
  const std::string file = read_text(data("zip.vdb"));
  EXPECT_NE(
      error_of(with(file, "Tree_float_5_4_3", "Tree_int32_5_4_3")).find("grids: none of the 2 has floats"),
      std::string::npos);
  std::string level_set = file + '\0'; // as long as before
  const std::string fog("\12\0\0\0fog volume", 14);
  ASSERT_NE(level_set.find(fog), std::string::npos);
  level_set.replace(level_set.find(fog), fog.size(), std::string("\11\0\0\0level set", 13));
  EXPECT_NE(error_of(level_set).find("grid 'density': it is a level set"), std::string::npos)
      << error_of(level_set);
  std::string warned;
  EXPECT_FALSE(parsed(with(file, "density", "sparser"), &warned).density.empty());
  EXPECT_NE(warned.find("there is no grid 'density': 'temperature' is taken"), std::string::npos) << warned;
  EXPECT_NE(error_of(with(file, "UniformScaleTranslateMap", "NonlinearFrustumMap....."))
                .find("grid 'density': its voxels are turned"),
            std::string::npos);
  std::string old = file;
  old[8] = static_cast<char>(213);
  EXPECT_NE(error_of(old).find("header: the version 213 of the format"), std::string::npos);
}

TEST(Blosc, DamageIsRefused) {
  Bytes out(8);
  const auto lz4 = [&](std::initializer_list<std::uint8_t> in) {
    const Bytes bytes(in);
    return decompress_lz4(bytes, out);
  };
  EXPECT_TRUE(lz4({0x80, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(out, (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(lz4({0x21, 1, 2, 2, 0, 0x10, 9})) << "a match that overlaps itself, then a literal";
  EXPECT_EQ(out.back(), 9);
  EXPECT_FALSE(lz4({0x80, 1, 2, 3}));                   // ends early
  EXPECT_FALSE(lz4({0x13, 1, 2, 0, 0x00}));             // a match before the start
  EXPECT_FALSE(lz4({0x13, 1, 0, 0, 0x00}));             // of no distance
  EXPECT_FALSE(lz4({0x90, 1, 2, 3, 4, 5, 6, 7, 8, 9})); // more than fits
  EXPECT_FALSE(lz4({0xf0, 255, 255, 255}));             // a length without end
  EXPECT_FALSE(lz4({0x70, 1, 2, 3, 4, 5, 6, 7}));       // less than is due
  EXPECT_FALSE(decompress_blosc(Bytes{2, 1, 33, 4}, out));
}

/// Truncations and byte flips of a valid file: an error, or a valid grid.
void expect_survives(const std::string& valid, int tries) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed());
  const auto attempt = [&](const std::string& bytes) {
    try {
      EXPECT_EQ(volume_grid_problem(parsed(bytes)), "");
    } catch (const Error& error) { EXPECT_EQ(std::string(error.what()).substr(0, 1), "v"); }
  };
  for (std::size_t length = 0; length < valid.size(); length += 1 + length / 16)
    attempt(valid.substr(0, length));
  for (int i = 0; i < tries; ++i) {
    std::string bytes = valid;
    for (std::uint64_t flips = 1 + random() % 3; flips > 0; --flips) {
      const std::size_t range = random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 600) : bytes.size();
      char& byte = bytes[random() % range];
      constexpr char kValues[] = {0, 1, 127, -128, -1};
      byte = random() % 2 == 0 ? static_cast<char>(byte ^ (1 << random() % 8)) : kValues[random() % 5];
    }
    attempt(bytes);
  }
}

TEST(VolumesHostile, DamagedFilesEndInAnErrorOrAGrid) {
  expect_survives("candela volume 1\ncells 2 1 2\nbounds 0 0 0 1 1 1\nchannels density temperature\ndata\n" +
                      bytes_of<float>({0, 1, 2, 3, 0, 0.5f, 1, 0}),
                  3000);
  expect_survives(mitsuba(1, {2, 1, 2}, 1, bytes_of<float>({0, 1, 2, 3})), 3000);
  for (const char* name : {"zip.vdb", "blosc_half_tile.vdb", "zip.nvdb", "blosc.nvdb"})
    expect_survives(read_text(data(name)), 250);
}

TEST(Volumes, AMissingFileAndAFolderAreTold) {
  WarningList warnings;
  ScratchFolder folder;
  EXPECT_THROW(read_volume(folder / "none.vdb", warnings), Error);
  EXPECT_THROW(read_volume(folder.path(), warnings), Error);
  EXPECT_TRUE(is_volume_name("a.VDB"));
  EXPECT_FALSE(is_volume_name("a.obj"));
}

} // namespace
} // namespace candela::test
