// Open Image Denoise's way through the program, with a stand-in in its place: what it is given, how it is
// stopped, and what becomes of its errors.

#include "core/error.h"
#include "render/denoise/denoise_film.h"
#include "render/denoise/oidn_denoiser.h"
#include "render/film/render_pass.h"
#include "session/render_session.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <OpenImageDenoise/oidn.hpp>

namespace candela {
namespace {

constexpr int kWidth = 5, kHeight = 3;

NoisyImage halves(vec3 a, vec3 b) {
  const std::vector<vec3> zero(kWidth * kHeight, vec3(0));
  NoisyImage out{{Image{kWidth, kHeight, zero}, Image{kWidth, kHeight, zero}}, {kWidth, kHeight, zero}};
  for (vec3& pixel : out.half[0].pixels) pixel = a;
  for (vec3& pixel : out.half[1].pixels) pixel = b;
  return out;
}

DenoiseInput flat_input() {
  return {halves(vec3(1, 2, 30), vec3(3, 2, 10)), halves(vec3(0.2f), vec3(0.4f)),
          halves(vec3(0, -1, 0), vec3(0, -1, 0)), halves(vec3(0), vec3(0))};
}

class OidnDenoiser : public testing::Test {
protected:
  void TearDown() override { oidn::stand_in = {}; }
};

TEST_F(OidnDenoiser, IsGivenTheMeansOfTheHalves) {
  vec3 albedo(0), normal(0); // the images are gone when it is done
  oidn::stand_in.at_half = [&] {
    for (const auto& [name, image] : oidn::stand_in.images) {
      EXPECT_EQ(image.width, std::size_t{kWidth}) << name;
      EXPECT_EQ(image.height, std::size_t{kHeight}) << name;
    }
    const float* a = oidn::stand_in.images["albedo"].data;
    const float* n = oidn::stand_in.images["normal"].data;
    albedo = vec3(a[0], a[1], a[2]);
    normal = vec3(n[0], n[1], n[2]);
  };
  const auto result = oidn_denoise(flat_input(), {3, nullptr});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->width, kWidth);
  EXPECT_EQ(result->pixels, std::vector<vec3>(kWidth * kHeight, vec3(2, 2, 20)));
  EXPECT_NEAR(albedo.x, 0.3f, 1e-6f);
  EXPECT_EQ(normal, vec3(0, -1, 0));
  EXPECT_EQ(oidn::stand_in.device, oidn::DeviceType::CPU);
  EXPECT_EQ(oidn::stand_in.parameters["hdr"], 1);
  EXPECT_EQ(oidn::stand_in.parameters["numThreads"], 3);
}

TEST_F(OidnDenoiser, GetsNothingThatIsNotFinite) {
  DenoiseInput input = flat_input();
  input.color.half[1].at(2, 1).y = kInfinity;
  const auto result = oidn_denoise(input);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->at(2, 1), vec3(2, 2, 20));
}

TEST_F(OidnDenoiser, IsStoppedOnItsWay) {
  std::atomic<bool> stop{false};
  oidn::stand_in.at_half = [&] { stop = true; };
  EXPECT_FALSE(oidn_denoise(flat_input(), {0, &stop}));
  oidn::stand_in.at_half = nullptr;
  stop = false;
  EXPECT_TRUE(oidn_denoise(flat_input(), {0, &stop}));
}

TEST_F(OidnDenoiser, TellsWhatWentWrong) {
  oidn::stand_in.error = oidn::Error::UnsupportedHardware;
  try {
    oidn_denoise(flat_input());
    ADD_FAILURE() << "it went well";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(),
                 "denoiser: OIDN 0.0.0: made to fail: switch display.denoise off, or build without it");
  }
  oidn::stand_in.at_half = [] { oidn::stand_in.error = oidn::Error::OutOfMemory; };
  EXPECT_THROW(oidn_denoise(flat_input()), std::bad_alloc);
}

TEST_F(OidnDenoiser, IsWhatRendersAreDenoisedWith) {
  EXPECT_EQ(denoiser_name(), "OIDN 0.0.0");
  const Document document = test::cornell_flush(16, 12, 4, true).document;
  const auto scene = RenderScene::build(document);
  Film film(16, 12);
  const std::atomic<bool> stop{false};
  render_pass(*scene, document, {0, 4}, film, stop);
  FeatureFilm features(16, 12);
  const auto result = denoise_render(noisy_image(film), 4, *scene, document, features);
  ASSERT_TRUE(result);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result->at(x, y)[c], film.mean(x, y)[c], 1e-5f * (1 + film.mean(x, y)[c]));
  EXPECT_EQ(oidn::stand_in.images.size(), 4u);
}

TEST_F(OidnDenoiser, SessionsSayWhyThereIsNoPicture) {
  oidn::stand_in.error = oidn::Error::UnsupportedHardware; // the first time
  RenderSession session;
  Document document = test::cornell_flush(16, 12, 2, true).document;
  document.settings.display.denoise = true;
  session.submit(document);
  ASSERT_TRUE(session.wait_finished(240));
  EXPECT_NE(session.status().denoise_error.find("OIDN 0.0.0"), std::string::npos);
  EXPECT_FALSE(session.display()->denoised);
  document.settings.sampler.seed += 1;
  session.submit(document);
  ASSERT_TRUE(session.wait_finished(240));
  EXPECT_EQ(session.status().denoise_error, "");
  EXPECT_TRUE(session.display()->denoised);
}

} // namespace
} // namespace candela
