// OpenEXR, through its library.

#include "io/images/exr_layers.h"
#include "io/images/image_codec.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <Imath/ImathBox.h>
#include <cstring>
#include <mutex>
#include <optional>

namespace candela {

namespace {

class MemoryInput final : public Imf::IStream {
public:
  MemoryInput(ByteView bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char c[], int n) override {
    if (n < 0 || static_cast<std::size_t>(n) > bytes_.size() - at_)
      throw Iex::InputExc("the file ends early");
    std::memcpy(c, bytes_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw Iex::InputExc("it points beyond its end");
    at_ = position;
  }
  void clear() override {}

private:
  ByteView bytes_;
  std::size_t at_ = 0;
};

class MemoryOutput final : public Imf::OStream {
public:
  explicit MemoryOutput(const std::string& name) : OStream(name.c_str()) {}

  void write(const char c[], int n) override {
    std::size_t end = at_ + static_cast<std::size_t>(n);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, c, static_cast<std::size_t>(n));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  Bytes take() { return std::move(bytes_); }

private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

bool near(const Imf::Chromaticities& a, const Imf::Chromaticities& b) {
  auto close = [](const Imath::V2f& p, const Imath::V2f& q) { return (p - q).length() < 1e-3f; };
  return close(a.red, b.red) && close(a.green, b.green) && close(a.blue, b.blue) && close(a.white, b.white);
}

/// From linear RGB of the given primaries to XYZ, white at Y = 1 (SMPTE RP 177-1993).
glm::dmat3 xyz_from_rgb(const Imf::Chromaticities& c) {
  auto xyz = [](const Imath::V2f& p) {
    double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
    return glm::dvec3(x / y, 1, (1 - x - y) / y);
  };
  glm::dmat3 primaries(xyz(c.red), xyz(c.green), xyz(c.blue));
  glm::dvec3 scale = glm::inverse(primaries) * xyz(c.white);
  return glm::dmat3(primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]);
}

/// Bradford's chromatic adaptation between the white points (Lam 1985, as in ICC.1:2010, annex E).
glm::dmat3 rec709_from(const Imf::Chromaticities& c) {
  glm::dmat3 bradford =
      glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
  glm::dmat3 source = xyz_from_rgb(c), target = xyz_from_rgb(Imf::Chromaticities());
  glm::dvec3 gain = (bradford * target * glm::dvec3(1)) / (bradford * source * glm::dvec3(1));
  glm::dmat3 adapt =
      glm::inverse(bradford) * glm::dmat3(gain[0], 0, 0, 0, gain[1], 0, 0, 0, gain[2]) * bradford;
  return glm::inverse(target) * adapt * source;
}

void to_rec709(Image& image, const Imf::Header& header, const Location& where) {
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  if (near(c, Imf::Chromaticities())) return;
  glm::dmat3 m = rec709_from(c);
  for (int i = 0; i < 9; ++i)
    if (!std::isfinite(m[i / 3][i % 3]))
      throw damaged_image(where, "its chromaticities span no colour space");
  for (vec3& pixel : image.pixels) pixel = vec3(m * glm::dvec3(pixel));
}

/// The largest expansion factor of a compression; 0 if blocks of zeros take almost no space.
std::int64_t largest_expansion(Imf::Compression compression) {
  switch (compression) {
  case Imf::NO_COMPRESSION: return 1;
  case Imf::RLE_COMPRESSION: return 64; // two bytes encode a run of 128
  case Imf::ZIPS_COMPRESSION:
  case Imf::ZIP_COMPRESSION:
  case Imf::PXR24_COMPRESSION: return 1032; // that of deflate
  default: return 0;
  }
}

/// Rejects headers that claim more pixels than the file can hold, before allocation.
void check_plausible(const Imf::Header& header, std::size_t bytes, std::int64_t width, std::int64_t height,
                     const Location& where) {
  // The table of offsets takes 8 bytes for every block of at most 256 scan lines (DWAB) or tile.
  std::int64_t blocks = height / 256;
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tile = header.tileDescription();
    blocks = (width / std::max(std::int64_t{1}, std::int64_t{tile.xSize})) *
             (height / std::max(std::int64_t{1}, std::int64_t{tile.ySize}));
  }
  std::int64_t pixel_bytes = 0; // PXR24 stores 3 bytes of a float
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
    if (i.channel().xSampling == 1 && i.channel().ySampling == 1)
      pixel_bytes += i.channel().type == Imf::HALF ? 2 : 3;
  std::int64_t expansion = largest_expansion(header.compression());
  std::int64_t size = static_cast<std::int64_t>(bytes);
  if (size / 8 < blocks || (expansion > 0 && size < width * height * pixel_bytes / expansion))
    throw damaged_image(where, "the EXR is too short for the size it claims");
}

void read_luminance_chroma(Imf::IStream& stream, Image& image, const Imath::Box2i& window,
                           ProgressPart* progress) {
  Imf::RgbaInputFile file(stream);
  std::vector<Imf::Rgba> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    if (progress) progress->reach(static_cast<double>(y) / image.height);
    // The library needs the address of pixel (0, 0); stride 0 maps all rows to this one.
    file.setFrameBuffer(row.data() - window.min.x, 1, 0);
    file.readPixels(window.min.y + y);
    for (int x = 0; x < image.width; ++x) {
      const Imf::Rgba& p = row[static_cast<std::size_t>(x)];
      image.at(x, y) = {p.r, p.g, p.b};
    }
  }
}

/// Scan lines that the library decodes together.
int block_height(const Imf::Header& header) {
  if (header.hasTileDescription()) return static_cast<int>(std::min(header.tileDescription().ySize, 8192u));
  switch (header.compression()) {
  case Imf::NO_COMPRESSION:
  case Imf::RLE_COMPRESSION:
  case Imf::ZIPS_COMPRESSION: return 1;
  case Imf::ZIP_COMPRESSION:
  case Imf::PXR24_COMPRESSION: return 16;
  case Imf::DWAB_COMPRESSION: return 256;
  default: return 32;
  }
}

void read_channels(Imf::InputPart& part, Image& image, const ExrLayer& layer, const Imath::Box2i& window,
                   ProgressPart* progress) {
  Imf::FrameBuffer frame;
  std::size_t row = sizeof(vec3) * static_cast<std::size_t>(image.width);
  auto insert = [&](const std::string& name, int component) {
    if (name.empty()) return;
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, &image.pixels[0][component], window, sizeof(vec3), row));
  };
  insert(layer.r, 0);
  if (layer.g != layer.r) insert(layer.g, 1);
  if (layer.b != layer.r) insert(layer.b, 2);
  part.setFrameBuffer(frame);
  // Bands of whole blocks, since each call decodes whole blocks.
  const int band = std::max(16, block_height(part.header()));
  for (int y = 0; y < image.height; y += band) {
    if (progress) progress->reach(static_cast<double>(y) / image.height);
    part.readPixels(window.min.y + y, window.min.y + std::min(y + band, image.height) - 1);
  }
  if (!layer.r.empty() && layer.g == layer.r)
    for (vec3& pixel : image.pixels) pixel = vec3(pixel.x);
}

Image decode(ByteView bytes, const Location& where, ProgressPart* progress, WarningList* warnings) {
  MemoryInput stream(bytes, where.file);
  Imf::MultiPartInputFile file(stream);
  const ExrLayer layer = choose_exr_layer(file, where, warnings);
  const Imf::Header& header = file.header(layer.part);
  Imath::Box2i window = header.dataWindow();
  std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_image_size(where, width, height);
  check_plausible(header, bytes.size(), width, height, where);
  if (!file.partComplete(layer.part)) throw damaged_image(where, "the EXR ends early");
  Image image{static_cast<int>(width), static_cast<int>(height),
              std::vector<vec3>(static_cast<std::size_t>(width * height), vec3(0))};
  if (layer.luminance_chroma) {
    MemoryInput again(bytes, where.file);
    read_luminance_chroma(again, image, window, progress);
  } else {
    Imf::InputPart part(file, layer.part);
    read_channels(part, image, layer, window, progress);
  }
  to_rec709(image, header, where);
  return image;
}

/// Calls the library with limits set; converts its exceptions to Error.
template <class Work>
auto guarded(Work work, const Location& where) {
  static std::once_flag limits;
  std::call_once(limits, [] { // the library then rejects larger headers before allocation
    Imf::Header::setMaxImageSize(static_cast<int>(kMaxImageSide), static_cast<int>(kMaxImageSide));
    Imf::Header::setMaxTileSize(8192, 8192);
  });
  try {
    return work();
  } catch (const Error&) { throw; } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) { // all kinds of Iex mean the same here
    throw damaged_image(where, fmt::format("it is no valid EXR ({})", problem.what()));
  }
}

} // namespace

bool is_exr(ByteView bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 && bytes[3] == 0x01;
}

Image decode_exr(ByteView bytes, const Location& where, ProgressPart* progress, WarningList* warnings) {
  return guarded([&] { return decode(bytes, where, progress, warnings); }, where);
}

std::optional<std::string> exr_text(ByteView bytes, const std::string& name, const Location& where) {
  return guarded(
      [&]() -> std::optional<std::string> {
        MemoryInput stream(bytes, where.file);
        Imf::InputFile file(stream);
        const auto* text = file.header().findTypedAttribute<Imf::StringAttribute>(name);
        return text ? std::optional(text->value()) : std::nullopt;
      },
      where);
}

Bytes encode_exr(const Image& image, const std::string& path, const ImageMetadata& metadata,
                 std::span<const ImageLayer> layers) {
  MemoryOutput stream(path);
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // Rec. 709
    Imf::FrameBuffer frame;
    auto add = [&](const std::string& prefix, const Image& picture) {
      for (int c = 0; c < 3; ++c) { // the library's slices are not const; writing only reads them
        const std::string name = prefix + "RGB"[c];
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, &const_cast<Image&>(picture).pixels[0][c],
                                            header.dataWindow(), sizeof(vec3),
                                            sizeof(vec3) * static_cast<std::size_t>(image.width)));
      }
    };
    add("", image);
    for (const ImageLayer& layer : layers) add(layer.name + ".", layer.image);
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } catch (const Iex::BaseExc& problem) { throw output_error(path, problem.what(), "check its attributes"); }
  return stream.take();
}

} // namespace candela
