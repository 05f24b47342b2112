// The texture viewer over the picture.

#include "app/harness.h"
#include "support/materials.h"
#include "support/textures.h"

#include <fmt/format.h>

#include <array>

namespace candela::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kRed = 1;

/// The room with a texture on its red wall.
Document room_with(std::shared_ptr<const Texture> texture) {
  Document document = test_document();
  document.scene.textures.push_back(std::move(texture));
  Material& red = document.scene.materials[kRed];
  std::get<DiffuseMaterial>(red.model).diffuse.use.texture = 0;
  std::get<DiffuseMaterial>(red.model).diffuse.value = vec3(1);
  return document;
}

/// 4 x 2 texels: 10 i, 20 i, 30 i.
std::shared_ptr<const Texture> small_picture() {
  Bytes texels;
  for (int i = 0; i < 8; ++i)
    for (int c = 1; c <= 3; ++c) texels.push_back(static_cast<std::uint8_t>(10 * i * c));
  auto texture = *picture_texture(4, 2, texels);
  texture.name = "small";
  return std::make_shared<const Texture>(texture);
}

struct ViewerTextureViewUi : ::testing::Test {
  std::unique_ptr<ViewerHarness> hand;

  void open(Document document, ivec2 size = {1280, 720}) {
    hand = std::make_unique<ViewerHarness>(std::move(document), HarnessOptions{.size = size});
    hand->unfold("panel.textures", "texture.view");
    hand->click("texture.view");
    wait();
  }
  const TextureViewer& view() const { return hand->viewer.texture_viewer(); }
  const TextureViewState& state() const { return hand->state().texture_view; }
  void wait() {
    hand->frame(); // what a click changes is made from the next frame on
    hand->wait_until("the texture is there", [&] { return view().complete(); });
    hand->frame(2);
  }
  /// A place of the unit square on the screen.
  vec2 at(vec2 uv) const {
    const GridRect unit = view().unit_square();
    return {unit.lo.x + uv.x * (unit.hi.x - unit.lo.x), unit.hi.y - uv.y * (unit.hi.y - unit.lo.y)};
  }
  std::array<int, 3> color(vec2 uv) const {
    const vec2 p = at(uv);
    const std::vector<std::uint8_t> screen = hand->pixels();
    const std::size_t i = 4 * (static_cast<std::size_t>(p.y) * static_cast<std::size_t>(hand->size().x) +
                               static_cast<std::size_t>(p.x));
    return {screen[i], screen[i + 1], screen[i + 2]};
  }
  vec2 uv_at(vec2 screen) const {
    const GridRect unit = view().unit_square();
    return vec2(screen.x - unit.lo.x, unit.hi.y - screen.y) / (unit.hi - unit.lo);
  }
};

TEST_F(ViewerTextureViewUi, ShowsEveryTexelAsItIs) {
  open(room_with(small_picture()));
  for (int i = 0; i < 8; ++i) {
    const vec2 uv((static_cast<float>(i % 4) + 0.5f) / 4, i < 4 ? 0.75f : 0.25f);
    EXPECT_EQ(color(uv), (std::array{10 * i, 20 * i, 30 * i})) << i;
    hand->move(at(uv));
    EXPECT_NE(view().told().find(fmt::format("raw {} {} {}", 10 * i, 20 * i, 30 * i)), std::string::npos)
        << view().told();
  }
  for (const char* fact : {"name", "kind", "space", "memory", "user"})
    EXPECT_TRUE(hand->find(std::string("texture_view.") + fact)) << fact;
  hand->choose("texture_view.channel", "G");
  wait();
  EXPECT_EQ(color({0.375f, 0.75f}), (std::array{20, 20, 20}));
}

TEST_F(ViewerTextureViewUi, IsOpenedForAParameterAndFollowsItsEdits) {
  hand = std::make_unique<ViewerHarness>(room_with(small_picture()));
  hand->unfold_all();
  hand->click(fmt::format("materials/{}", kRed));
  hand->choose("material.diffuse.texture", "view");
  ASSERT_TRUE(state().visible);
  ASSERT_TRUE(state().as_of);
  EXPECT_EQ(state().as_of->key, "diffuse");
  wait();
  hand->move(at({0.9f, 0.9f}));
  EXPECT_NE(view().told().find("value"), std::string::npos) << view().told();
  const auto before = color({0.875f, 0.25f});
  hand->unfold("material.diffuse.texture_use", "material.diffuse.texture.scale_u");
  hand->type_into("material.diffuse.texture.offset_u", "0.5");
  wait();
  EXPECT_EQ(color({0.375f, 0.25f}), before) << "the same texel, half a width further left";
  EXPECT_NE(color({0.875f, 0.25f}), before);
  hand->choose("material.diffuse.texture", "none");
  hand->frame(2);
  EXPECT_TRUE(state().visible);
  EXPECT_FALSE(state().as_of) << "no parameter uses it: the texture itself";
}

TEST_F(ViewerTextureViewUi, PansWithTheMouseAndZoomsAboutIt) {
  open(room_with(small_picture()));
  const vec2 mouse = at({0.3f, 0.6f});
  hand->scroll(mouse, 4);
  hand->frame(2);
  EXPECT_LT(glm::length(uv_at(mouse) - vec2(0.3f, 0.6f)), 3e-3f) << "rounded to a pixel";
  const GridRect before = view().unit_square();
  EXPECT_GT(before.hi.x - before.lo.x, 1.5f * 600);
  hand->drag(mouse, mouse + vec2(-40, 25));
  hand->frame();
  EXPECT_LT(glm::length(view().unit_square().lo - before.lo - vec2(-40, 25)), 1.5f);
  hand->click("texture_view.one");
  hand->frame(2);
  EXPECT_EQ(view().unit_square().hi.x - view().unit_square().lo.x, 16) << "not below what can be seen";
  hand->click("texture_view.fit");
  hand->frame(2);
  const auto canvas = hand->find("texture_view.canvas");
  ASSERT_TRUE(canvas);
  EXPECT_GT(view().unit_square().lo.x, canvas->lo.x);
  EXPECT_LT(view().unit_square().hi.x, canvas->hi.x);
}

TEST_F(ViewerTextureViewUi, EscapeClosesIt) {
  open(room_with(small_picture()));
  const Camera before = hand->document().scene.camera;
  hand->key(Key::w); // belongs to the texture now
  hand->frame(2);
  EXPECT_EQ(hand->document().scene.camera, before);
  hand->key(Key::escape);
  hand->frame(2);
  EXPECT_FALSE(state().visible);
  EXPECT_FALSE(hand->find("texture_view.canvas"));
  hand->wait_until("nothing is in work", [&] { return !view().running(); });
  EXPECT_EQ(view().tiles().memory_bytes(), 0u);
}

TEST_F(ViewerTextureViewUi, ShowsLevelsAndCopies) {
  open(room_with(small_picture()));
  hand->choose("texture_view.level", "1: 2 x 1");
  wait();
  // The mean light of 0, 1, 4, 5.
  float light = 0;
  for (int i : {0, 1, 4, 5}) light += 0.25f * linear_from_srgb(static_cast<float>(10 * i) / 255);
  EXPECT_NEAR(color({0.25f, 0.5f})[0], 255 * srgb_from_linear(light), 1);
  hand->choose("texture_view.level", "0: 4 x 2");
  hand->click("texture_view.tiled");
  wait();
  EXPECT_EQ(color({1.375f, 1.75f}), (std::array{10, 20, 30})) << "repeated";
  hand->screenshot("texture_view_tiled");
}

TEST_F(ViewerTextureViewUi, PatternsAreEvaluated) {
  open(room_with(std::make_shared<const Texture>(Texture{"tiles", CheckerTexture{{1, 0, 0}, {0, 0, 1}, 2}})));
  EXPECT_EQ(color({0.25f, 0.25f}), (std::array{255, 0, 0}));
  EXPECT_EQ(color({0.75f, 0.25f}), (std::array{0, 0, 255}));
  hand->choose("texture_view.resolution", "2048");
  wait();
  EXPECT_EQ(color({0.75f, 0.25f}), (std::array{0, 0, 255}));
  EXPECT_EQ(view().tiles().grid()->size(), ivec2(2048));
}

/// What 16 million texels show comes from another thread, a part at a time, and is kept within bounds.
TEST_F(ViewerTextureViewUi, LargePicturesAreMadeInTiles) {
  constexpr int kSide = 4096;
  Bytes texels(static_cast<std::size_t>(kSide) * kSide);
  for (std::size_t i = 0; i < texels.size(); ++i)
    texels[i] = static_cast<std::uint8_t>((i % kSide) / 16 + (i / kSide) / 64);
  open(room_with(picture_texture(kSide, kSide, std::move(texels), 1)));
  const std::size_t made = view().tiles().made();
  EXPECT_LT(made, 40u) << "no more than is seen";
  hand->click("texture_view.one");
  wait();
  EXPECT_EQ(color({0.5f, 0.5f})[0], (2048 / 16 + 2048 / 64) % 256);
  for (int i = 0; i < 12; ++i) {
    hand->drag({700, 350}, {300, 120});
    wait();
  }
  EXPECT_GT(view().tiles().made(), made + 20);
  EXPECT_LE(view().tiles().memory_bytes(), TextureTiles::kMostBytes);
}

TEST_F(ViewerTextureViewUi, ALayoutAndAScreenshotOfAMesh) {
  Document document = room_with(std::make_shared<const Texture>(Texture{"clouds", NoiseTexture()}));
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh->uvs = {{0.1f, 0.1f}, {0.9f, 0.1f}, {0.1f, 0.9f}};
  mesh->triangles = {{0, 1, 2}};
  auto& instances = document.scene.instances;
  instances.insert(instances.begin(), {"sheet", std::shared_ptr<const Mesh>(mesh), mat4(1), {kRed}});
  open(std::move(document));
  const auto before = color({0.5f, 0.1f});
  hand->unfold("panel.objects", "list.objects");
  hand->click("objects/0");
  hand->click("texture_view.uv_layout");
  hand->frame(2);
  const auto edge = color({0.5f, 0.1f});
  EXPECT_NE(edge, before);
  EXPECT_GT(edge[0], edge[2] + 60) << "orange";
  hand->screenshot("texture_view");
}

TEST_F(ViewerTextureViewUi, NothingIsCutOffAndTheLabComesToTheFront) {
  open(room_with(small_picture()), {1280, 720});
  for (const WidgetRecord& widget : hand->viewer.widgets()) {
    if (!widget.name.starts_with("texture_view.")) continue;
    SCOPED_TRACE(widget.name);
    EXPECT_GE(widget.lo.x, widget.clip_lo.x - 1);
    EXPECT_LE(widget.hi.x, widget.clip_hi.x + 1);
  }
  hand->key(Key::f2);
  hand->frame(2);
  EXPECT_FALSE(state().visible);
  EXPECT_TRUE(hand->state().lab_visible);
  hand->resize({300, 200}); // no room for panels: it still draws
  hand->frame(3);
}

} // namespace
} // namespace candela::test
