#pragma once
// Marko Dabrovic's Sponza as Mitsuba keeps it: a .serialized file is a zlib stream for each of its shapes, a
// table of their offsets, and their number (Mitsuba documentation, section 8.1.2).

#include "bench_scenes.h"

#include <cstring>
#include <iterator>
#include <zlib.h>

namespace candela::bench {

/// The decompressed zlib stream that begins at `data`; empty on errors.
inline std::vector<unsigned char> inflate_all(const unsigned char* data, std::size_t size) {
  std::vector<unsigned char> out(1 << 16);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return {};
  stream.next_in = const_cast<unsigned char*>(data);
  stream.avail_in = static_cast<uInt>(size);
  int status = Z_OK;
  while (status == Z_OK) {
    if (stream.total_out == out.size()) out.resize(2 * out.size());
    stream.next_out = out.data() + stream.total_out;
    stream.avail_out = static_cast<uInt>(out.size() - stream.total_out);
    status = inflate(&stream, Z_NO_FLUSH);
  }
  out.resize(status == Z_STREAM_END ? stream.total_out : 0);
  inflateEnd(&stream);
  return out;
}

/// Appends a shape of version 3: flags, numbers of vertices and triangles, positions, normals and texture
/// coordinates where the flags name them, indices.
inline void append_shape(TriangleMesh& mesh, const std::vector<unsigned char>& bytes) {
  std::size_t at = 0;
  auto read = [&](auto& value) {
    if (at + sizeof(value) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(value));
    at += sizeof(value);
  };
  std::uint32_t flags = 0;
  std::uint64_t vertices = 0, triangles = 0;
  read(flags), read(vertices), read(triangles);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint64_t i = 0; i < vertices; ++i) read(mesh.vertices.emplace_back());
  at += vertices * sizeof(float) * ((flags & 1 ? 3u : 0u) + (flags & 2 ? 2u : 0u) + (flags & 8 ? 3u : 0u));
  for (std::uint64_t i = 0; i < triangles; ++i) {
    uvec3 t{0};
    read(t);
    mesh.triangles.push_back(t + first);
  }
}

/// Without triangles if the file is missing. The shapes' transforms are the same small translation, which is
/// ignored.
inline BenchScene sponza() {
  BenchScene scene{
      "sponza", {}, {{14.45f, 6.894f, -1.185f}, {13.456f, 6.784f, -1.159f}, radians(70), {0, 14, 0}, 3}};
  std::ifstream file(std::string(CANDELA_SHARED_DATA) + "/mitsuba/sponza/sponza.serialized",
                     std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  std::uint32_t shapes = 0;
  if (text.size() < 8) return scene;
  std::memcpy(&shapes, text.data() + text.size() - 4, 4);
  const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
  for (std::size_t i = 0; i < shapes && 4 * (shapes - i) + 4 <= text.size(); ++i) {
    std::uint32_t offset = 0;
    std::memcpy(&offset, bytes + text.size() - 4 * (shapes - i) - 4, 4);
    if (offset + 4 < text.size())
      append_shape(scene.mesh, inflate_all(bytes + offset + 4, text.size() - offset - 4));
  }
  return scene;
}

} // namespace candela::bench
