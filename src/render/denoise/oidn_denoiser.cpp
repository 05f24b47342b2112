#include "render/denoise/oidn_denoiser.h"

#include "core/error.h"
#include "render/denoise/denoise_input.h"

#include <fmt/format.h>

#include <OpenImageDenoise/oidn.hpp>
#include <new>

namespace candela {

namespace {

static_assert(sizeof(vec3) == 3 * sizeof(float)); // as Format::Float3 is laid out

/// The filter calls it from time to time; false cancels it.
bool goes_on(void* stop, double) {
  return !static_cast<const std::atomic<bool>*>(stop)->load(std::memory_order_relaxed);
}

/// Whether all is well; false: it was cancelled. Throws anything else that went wrong since the last call.
bool check(oidn::DeviceRef& device) {
  const char* message = nullptr;
  switch (device.getError(message)) {
  case oidn::Error::None: return true;
  case oidn::Error::Cancelled: return false;
  case oidn::Error::OutOfMemory: throw std::bad_alloc();
  default:
    throw Error(ExitCode::limit,
                fmt::format("denoiser: {}: {}: switch display.denoise off, or build without it", oidn_name(),
                            message ? message : "unknown error"));
  }
}

/// The mean of the halves; where it is not finite, of the neighbours.
Image finite_mean(const NoisyImage& color) {
  const denoising::Halves halves = denoising::prepare_color(color);
  const std::size_t n = halves.variance.size();
  Image out{color.variance.width, color.variance.height, std::vector<vec3>(n)};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.pixels[i][static_cast<glm::length_t>(c)] =
          0.5f * (halves.mean[0].values[c * n + i] + halves.mean[1].values[c * n + i]);
  return out;
}

Image feature_mean(const NoisyImage& feature, float lo) {
  Image out = feature.half[0];
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = glm::clamp(0.5f * (out.pixels[i] + feature.half[1].pixels[i]), vec3(lo), vec3(1));
  return out;
}

} // namespace

std::string_view oidn_name() { return "OIDN " OIDN_VERSION_STRING; }

std::optional<Image> oidn_denoise(const DenoiseInput& input, const DenoiseOptions& options) {
  oidn::DeviceRef device = oidn::newDevice(oidn::DeviceType::CPU);
  check(device); // of a null device, too: why there is none
  if (options.threads > 0) device.set("numThreads", options.threads);
  device.set("setAffinity", false); // pinned threads would fight with those that render
  device.commit();
  check(device);

  Image color = finite_mean(input.color);
  Image albedo = feature_mean(input.albedo, 0), normal = feature_mean(input.normal, -1);
  Image output{color.width, color.height, std::vector<vec3>(color.pixels.size())};
  oidn::FilterRef filter = device.newFilter("RT");
  auto set_image = [&](const char* name, Image& image) {
    filter.setImage(name, image.pixels.data(), oidn::Format::Float3, static_cast<std::size_t>(image.width),
                    static_cast<std::size_t>(image.height));
  };
  set_image("color", color);
  set_image("albedo", albedo);
  set_image("normal", normal);
  set_image("output", output);
  filter.set("hdr", true);
  if (options.stop) filter.setProgressMonitorFunction(goes_on, const_cast<std::atomic<bool>*>(options.stop));
  filter.commit();
  check(device);
  filter.execute();
  if (!check(device) || (options.stop && *options.stop)) return std::nullopt;
  return output;
}

} // namespace candela
