// Textures keep the precision of their files.

#include "io/images/image_file.h"
#include "io/images/texels_reader.h"
#include "io/scene_files.h"
#include "support/materials.h"

#include <zlib.h>

namespace candela {
namespace {

using test::ScratchFolder;

std::string big_endian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}
std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}
/// `rows` are the texels' bytes with a 0, "no filter", before each row.
std::string png(int width, int height, int bits, int kind, const std::string& rows) {
  std::string packed(compressBound(rows.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
           rows.size());
  packed.resize(size);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(static_cast<std::uint32_t>(width)) +
                           big_endian(static_cast<std::uint32_t>(height)) +
                           std::string{static_cast<char>(bits), static_cast<char>(kind), 0, 0, 0}) +
         chunk("IDAT", packed) + chunk("IEND", "");
}

TEST(TexelsReader, SixteenBitsOfAPngAreKept) {
  ScratchFolder folder;
  constexpr int kGrey = 0, kRgb = 2, kRgba = 6;
  test::write_text(folder / "grey.png", png(2, 1, 16, kGrey, std::string("\0\x12\x34\xff\xff", 5)));
  EXPECT_EQ(*read_texels(folder / "grey.png"), (Texels{2, 1, 1, std::vector<std::uint16_t>{0x1234, 0xffff}}));
  test::write_text(folder / "rgb.png", png(1, 1, 16, kRgb, std::string("\0\x12\x34\xff\xff\0\1", 7)));
  EXPECT_EQ(*read_texels(folder / "rgb.png"),
            (Texels{1, 1, 3, std::vector<std::uint16_t>{0x1234, 0xffff, 1}}));
  test::write_text(folder / "alpha.png", png(1, 1, 8, kRgba, std::string("\0\1\2\3\4", 5)));
  EXPECT_EQ(*read_texels(folder / "alpha.png"), (Texels{1, 1, 4, std::vector<std::uint8_t>{1, 2, 3, 4}}));
  test::write_text(folder / "opaque.png", png(1, 1, 8, kRgba, std::string("\0\1\2\3\xff", 5)));
  EXPECT_EQ(*read_texels(folder / "opaque.png"), (Texels{1, 1, 3, std::vector<std::uint8_t>{1, 2, 3}}));
}

TEST(TexelsReader, PnmKeepsItsBits) {
  ScratchFolder folder;
  auto read = [&](const std::string& content) {
    test::write_text(folder / "a.pgm", content);
    return *read_texels(folder / "a.pgm");
  };
  EXPECT_EQ(read("P2 2 1 255 7 200"), (Texels{2, 1, 1, std::vector<std::uint8_t>{7, 200}}));
  EXPECT_EQ(read("P2 2 1 15 0 15"), (Texels{2, 1, 1, std::vector<std::uint8_t>{0, 255}}));
  EXPECT_EQ(read("P2 2 1 65535 258 65535"), (Texels{2, 1, 1, std::vector<std::uint16_t>{258, 65535}}));
  EXPECT_EQ(read("P2 1 1 1023 1023"), (Texels{1, 1, 1, std::vector<std::uint16_t>{65535}}));
}

TEST(TexelsReader, FloatsAreNotClipped) {
  ScratchFolder folder;
  write_linear_image({1, 1, {vec3(1000, 0.5f, -1)}}, folder / "a.exr");
  EXPECT_EQ(*read_texels(folder / "a.exr"), (Texels{1, 1, 3, std::vector<float>{1000, 0.5f, -1}}));
  write_linear_image({1, 1, {vec3(1000, 0.5f, 0)}}, folder / "a.hdr");
  EXPECT_EQ(read_texels(folder / "a.hdr")->data.index(), 2u);
}

TEST(Textures, AreSharedByContent) {
  test::SceneFiles files;
  files.write("a.png", test::tiny_png());
  files.write("b/copy.png", test::tiny_png());
  files.write("s.json", R"({"candela": 1, "materials": [
    {"diffuse": {"texture": "a.png"}, "emission": {"texture": "b/copy.png", "factor": 3}},
    {"type": "ggx", "specular": 0.5, "roughness": {"texture": "a.png", "channel": "red"}}]})");
  const SceneDesc scene = files.read("s.json").document.scene;
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_NE(scene.textures[0]->image()->source, scene.textures[1]->image()->source);
  EXPECT_EQ(scene.textures[0]->image()->texels, scene.textures[1]->image()->texels) << "the same memory";
  EXPECT_EQ(test::use_of(scene.materials[1], "roughness").texture, 0);
  EXPECT_EQ(test::use_of(scene.materials[1], "roughness").color_space, ColorSpace::linear);
  EXPECT_EQ(scene.materials[0].emission.value, vec3(3));
  EXPECT_EQ(test::color(scene.materials[0], "diffuse"), vec3(1)) << "a texture as it is";
}

TEST(Textures, AreNamedByFileNameOrIndex) {
  test::SceneFiles files;
  files.write("a.png", test::tiny_png());
  files.write("s.json", R"({"candela": 1,
    "textures": [{"type": "checker", "name": "tiles", "even": [1, 0, 0]}, {"file": "a.png", "name": "wood"}],
    "materials": [{"diffuse": {"texture": "tiles"}}, {"diffuse": {"texture": 1}},
                  {"diffuse": {"texture": "wood"}}, {"diffuse": {"texture": "a.png"}},
                  {"diffuse": [0.25, 0.5, 1], "diffuse_texture": "a.png", "diffuse_uv_scale": [2, 3]}]})");
  const SceneDesc scene = files.read("s.json").document.scene;
  const int expected[] = {0, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(test::use_of(scene.materials[i]).texture, expected[i]) << i;
  EXPECT_EQ(std::get<CheckerTexture>(scene.textures[0]->model).even, vec3(1, 0, 0));
  EXPECT_EQ(scene.textures[1]->name, "wood");
  EXPECT_EQ(test::use_of(scene.materials[4]).uv.scale, vec2(2, 3));
  EXPECT_EQ(test::color(scene.materials[4], "diffuse"), vec3(0.25f, 0.5f, 1));
}

TEST(Textures, MtlMapsMultiplyWhatTheyBelongTo) {
  test::SceneFiles files;
  files.write("t.png", test::tiny_png());
  files.write("x.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  auto material = [&](const std::string& statements) {
    files.write("x.mtl", "newmtl a\n" + statements);
    return files.read("x.obj").document.scene.materials.at(0);
  };
  Material m = material(
      "Kd 0.5 0.5 0.5\nKs 1 1 1\nKe 2 2 2\nd 0.75\nmap_Ks t.png\nmap_Ke -s 2 2 t.png\nmap_d t.png\n");
  EXPECT_EQ(material_type_name(m), "phong");
  EXPECT_EQ(test::use_of(m, "specular").texture, 0);
  EXPECT_EQ(m.emission.value, vec3(2));
  EXPECT_EQ(m.emission.use.texture, 0);
  EXPECT_EQ(m.emission.use.uv.scale, vec2(2));
  EXPECT_EQ(m.opacity.value, 0.75f);
  EXPECT_EQ(m.opacity.use.texture, 0);
  EXPECT_EQ(m.opacity.use.color_space, ColorSpace::linear);
  EXPECT_EQ(material("map_Ke t.png\n").emission.value, vec3(1)) << "where it is missing";
  EXPECT_EQ(material("Ni 1.5\nillum 7\nmap_d t.png\n").opacity.use.texture, -1) << "glass is not invisible";
}

} // namespace
} // namespace candela
