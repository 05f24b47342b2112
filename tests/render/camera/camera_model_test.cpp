// Cameras that reject or weight samples.

#include "render/camera/thin_lens_camera.h"
#include "render/render_testing.h"

namespace candela::test {
namespace {

/// Lets through what falls on one half of the lens, with a weight.
class HalfStoppedCamera final : public CameraModel {
public:
  HalfStoppedCamera(const Document& document, float weight)
      : inner_(
            make_camera(document.scene.camera, document.settings.film.width, document.settings.film.height)),
        weight_(weight) {}

  bool uses_lens_sample() const override { return true; }
  std::optional<float> generate(vec2 film, vec2 u_lens, Ray& ray) const override {
    if (u_lens.x < 0.5f) {
      ray = {vec3(std::numeric_limits<float>::quiet_NaN()), 0, vec3(0), kInfinity}; // has no meaning
      return std::nullopt;
    }
    inner_->generate(film, u_lens, ray);
    return weight_;
  }

private:
  std::shared_ptr<const CameraModel> inner_;
  float weight_;
};

/// Of the same radiance everywhere.
Document glowing_box(int size, int spp) {
  SceneMaker s(size, size, spp);
  s.closed_box(vec3(-1), vec3(1), s.diffuse(vec3(0), vec3(2)));
  s.camera({0.3f, 0.2f, 0.9f}, {0, 0, -1}, 60);
  return s.document;
}

PassOptions through(std::shared_ptr<const CameraModel> camera) {
  PassOptions options;
  options.camera = std::move(camera);
  return options;
}

TEST(CameraModelStatistical, ALensThatRefusesHalfOfItsSamplesHalvesTheMean) {
  Document document = glowing_box(48, 64);
  document.settings.sampler.seed = sampler_seed();
  for (float weight : {1.0f, 3.0f}) {
    const auto camera = std::make_shared<const HalfStoppedCamera>(document, weight);
    const RunningStatistics s = over_pixels(render(document, through(camera)), 0);
    expect_radiance(s, 2 * 0.5 * static_cast<double>(weight), 0.03, 2);
  }
}

TEST(CameraModel, SamplesWithoutARayAreBlackAndTheOthersKeepTheirBits) {
  SceneMaker s(24, 16, 1);
  s.closed_box(vec3(-1), vec3(1), s.diffuse(vec3(0.5f), vec3(0.1f, 0.2f, 0.3f)));
  s.sphere({0, 0, 0}, 0.4f, s.diffuse(vec3(0.7f)));
  s.camera({0.3f, 0.2f, 0.9f}, {0, 0, -1}, 60);
  for (Integrator integrator : {Integrator::path, Integrator::whitted, Integrator::ao})
    for (View view : {View::radiance, View::normal, View::bvh_cost}) {
      Document document = s.document;
      document.settings.integrator = integrator;
      document.settings.view = view;
      document.settings.ao.distance = 0.1f; // else the closed box is all occluded
      const Film all = render(document);
      const Film half = render(document, through(std::make_shared<const HalfStoppedCamera>(document, 1.0f)));
      int black = 0, same = 0;
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x) {
          EXPECT_EQ(half.tried(x, y), 1u);
          if (half.mean(x, y) == vec3(0))
            ++black;
          else if (half.mean(x, y) == all.mean(x, y))
            ++same;
        }
      EXPECT_EQ(black + same, 24 * 16);
      EXPECT_GT(black, 24 * 16 / 3);
      EXPECT_GT(same, 24 * 16 / 3);
    }
}

} // namespace
} // namespace candela::test
