// Projections along the axes of an object.

#include "support/patterns.h"
#include "textures/texture.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

vec3 random_unit(Random& random) {
  const float z = 2 * random() - 1, phi = 2 * kPi * random(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

TextureUse triplanar(float blend) {
  TextureUse use;
  use.mapping = TextureMapping::triplanar, use.blend = blend;
  return use;
}

TEST(Triplanar, PicturesStandUprightAndAreNotMirrored) {
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {-1.0f, 1.0f}) {
      SurfacePlace place;
      place.normal = vec3(0);
      place.normal[axis] = side;
      place.position = {0.3f, -1.2f, 2.5f};
      const auto projections = project_triplanar(place, {}, 0.5f);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(projections[static_cast<std::size_t>(k)].weight, k == axis);
      const ProjectedPoint& p = projections[static_cast<std::size_t>(axis)];
      // Seen from outside, u goes to the right and v up: they turn to the left about the outward normal.
      EXPECT_EQ(glm::cross(p.across, p.up), place.normal);
      EXPECT_EQ(p.up, axis == 1 ? vec3(0, 0, -side) : vec3(0, 1, 0));
      EXPECT_EQ(p.at.uv, vec2(glm::dot(place.position, p.across), glm::dot(place.position, p.up)));
    }
}

TEST(Triplanar, WeightsAreContinuousSharesOfTheNormal) {
  SCOPED_TRACE(seed_note());
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    SurfacePlace place;
    place.normal = random_unit(random);
    const float blend = random();
    SurfacePlace beside = place;
    beside.normal = glm::normalize(place.normal + 1e-4f * random_unit(random));
    const auto here = project_triplanar(place, {}, blend), there = project_triplanar(beside, {}, blend);
    const vec3 share = glm::abs(place.normal) / max_component(glm::abs(place.normal));
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += here[k].weight;
      ASSERT_GE(here[k].weight, 0);
      if (share[static_cast<int>(k)] < 1 - blend - 1e-3f) { ASSERT_EQ(here[k].weight, 0); }
      if (blend > 0.1f) { ASSERT_NEAR(here[k].weight, there[k].weight, 1e-2f); }
    }
    ASSERT_NEAR(sum, 1, 1e-6f);
  }
}

TEST(Triplanar, ALookupIsTheBlendOfLookupsInThePlanes) {
  SCOPED_TRACE(seed_note());
  Random random(2);
  const Texture noise{"", NoiseTexture()};
  for (int i = 0; i < 500; ++i) {
    TextureUse use = triplanar(random());
    use.uv.scale = {1 + random(), 2}, use.uv.rotation = 0.4f, use.uv.offset = {random(), 3};
    TextureUse in_plane = use;
    in_plane.mapping = TextureMapping::uv;
    TexturePoint at(random.in_square(9));
    at.place.emplace();
    at.place->position = 3.0f * random_unit(random), at.place->normal = random_unit(random);
    vec3 expected(0);
    for (const ProjectedPoint& p : project_triplanar(*at.place, {}, use.blend))
      expected += p.weight * texture_color(noise, in_plane, p.at.uv);
    const vec3 found = texture_color(noise, use, at);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], 1e-5f);
    ASSERT_NEAR(texture_number(noise, use, at), luminance(expected), 1e-5f);
  }
}

TEST(Triplanar, FootprintsAreProjectedWithTheirPlace) {
  // Over what the filter takes the mean of: by lookups in the tangent plane.
  SCOPED_TRACE(seed_note());
  Random random(3);
  CheckerTexture checker;
  checker.squares = 3;
  const Texture texture{"", checker};
  const TextureUse use = triplanar(0);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 20; ++i) {
      vec3 normal(0);
      normal[axis] = random() < 0.5f ? -1.0f : 1.0f;
      TexturePoint at(vec2(0), {{0.7f * random(), 0}, {0, 0.7f * random()}});
      at.place.emplace();
      SurfacePlace& place = *at.place;
      place.normal = normal;
      place.position = 2.0f * random_unit(random);
      // Along the axes of the plane, for which alone the checker's mean is exact.
      place.dpdu = vec3(0), place.dpdv = vec3(0);
      place.dpdu[(axis + 1) % 3] = 1.3f, place.dpdv[(axis + 2) % 3] = -0.8f;
      double mean = 0;
      constexpr int kSide = 400;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const vec2 s = (vec2(x, y) + 0.5f) / float{kSide} - 0.5f;
          mean += static_cast<double>(
              texture_number(texture, use, at.moved(s.x * at.footprint.major + s.y * at.footprint.minor)));
        }
      mean /= kSide * kSide;
      EXPECT_NEAR(luminance(vec3(*texture_filtered(texture, use, at, nullptr))), mean, 5e-3) << axis;
    }
}

TEST(MeshAttribute, IsTheSurfacesOwnColor) {
  TexturePoint at(vec2(0.3f, 0.2f));
  MeshAttributeTexture kind;
  EXPECT_EQ(texture_color({"", kind}, {}, at), vec3(1)) << "where there is none";
  at.place.emplace();
  at.place->vertex_color = {0.25f, 0.5f, 2}, at.place->face_color = {1, 0, 0.125f};
  EXPECT_EQ(texture_color({"", kind}, {}, at), vec3(0.25f, 0.5f, 2));
  TextureUse blue;
  blue.channel = TextureChannel::blue;
  EXPECT_EQ(texture_number({"", kind}, blue, at), 2);
  kind.attribute = MeshAttributeTexture::Attribute::face_color;
  EXPECT_EQ(texture_color({"", kind}, {}, at), vec3(1, 0, 0.125f));
  EXPECT_EQ(texture_color({"", kind}, triplanar(0.5f), at), vec3(1, 0, 0.125f)) << "has no coordinates";
}

TEST(MeshAttribute, TexturesThatLookAtTheSurfaceSaySo) {
  EXPECT_TRUE(asks_place({"", MeshAttributeTexture()}, {}));
  EXPECT_TRUE(asks_place({"", CheckerTexture()}, triplanar(0.2f)));
  EXPECT_FALSE(asks_place({"", CheckerTexture()}, {}));
}

} // namespace
} // namespace candela::test
