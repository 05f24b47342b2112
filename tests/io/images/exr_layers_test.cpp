// Selection of the part and layer of an EXR.

#include "core/error.h"
#include "io/images/image_codec.h"
#include "io/images/panorama_reader.h"
#include "io/images/texels_reader.h"
#include "support/scratch_folder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <gtest/gtest.h>

#include <Imath/half.h>

namespace candela {
namespace {

struct Part {
  std::string name;
  std::vector<std::string> channels; ///< the values of the k-th in all parts is k + 1
};

struct ExrLayers : ::testing::Test {
  test::ScratchFolder folder;
  WarningList warnings;

  std::string write(const std::vector<Part>& parts) const {
    std::vector<Imf::Header> headers;
    for (const Part& part : parts) {
      Imf::Header header(2, 1);
      header.setType(Imf::SCANLINEIMAGE);
      if (parts.size() > 1) header.setName(part.name);
      for (const std::string& name : part.channels) header.channels().insert(name, Imf::Channel(Imf::HALF));
      headers.push_back(header);
    }
    std::string path = folder / "a.exr";
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    float value = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::vector<std::vector<half>> data;
      Imf::FrameBuffer frame;
      for (std::size_t k = 0; k < parts[i].channels.size(); ++k) data.emplace_back(2, half(++value));
      for (std::size_t k = 0; k < data.size(); ++k)
        frame.insert(parts[i].channels[k],
                     Imf::Slice(Imf::HALF, reinterpret_cast<char*>(data[k].data()), 2, 4));
      Imf::OutputPart out(file, static_cast<int>(i));
      out.setFrameBuffer(frame);
      out.writePixels(1);
    }
    return path;
  }
  vec3 pixel(const std::vector<Part>& parts) {
    warnings = WarningList();
    const Bytes bytes = read_file_bytes(write(parts), "image");
    return decode_exr(bytes, {"a.exr"}, nullptr, &warnings).pixels[1];
  }
  std::string warning() const { return warnings.warnings().empty() ? "" : warnings.warnings()[0].text; }
};

TEST_F(ExrLayers, ThePartWithColour) {
  EXPECT_EQ(pixel({{"depth", {"Z"}}, {"picture", {"R", "G", "B"}}}), vec3(2, 3, 4));
  EXPECT_EQ(warning(), "");
  EXPECT_EQ(pixel({{"depth", {"Z"}}, {"grey", {"Y"}}}), vec3(2));
}

TEST_F(ExrLayers, OfSeveralPartsTheOneOfThatName) {
  EXPECT_EQ(pixel({{"diffuse", {"R", "G", "B"}}, {"Beauty", {"R", "G", "B"}}, {"z", {"Z"}}}), vec3(4, 5, 6));
  EXPECT_EQ(warning(), "a.exr: of its layers 'Beauty' is taken; the others are 'diffuse'");
  EXPECT_EQ(pixel({{"a", {"R", "G", "B"}}, {"b", {"R", "G", "B"}}}), vec3(1, 2, 3));
  EXPECT_EQ(warning(), "a.exr: of its layers 'a' is taken; the others are 'b'");
}

TEST_F(ExrLayers, OfSeveralLayersOfOnePart) {
  EXPECT_EQ(pixel({{"", {"diffuse.R", "diffuse.G", "diffuse.B", "beauty.R", "beauty.G", "beauty.B"}}}),
            vec3(4, 5, 6));
  EXPECT_NE(warning().find("'diffuse'"), std::string::npos);
  // The channels of the layer without a name are not adjacent.
  EXPECT_EQ(pixel({{"", {"B", "D.B", "D.G", "D.R", "G", "R"}}}), vec3(6, 5, 1));
  EXPECT_EQ(pixel({{"", {"Layer.Combined.b", "Layer.Combined.g", "Layer.Combined.r", "Layer.Emit.R"}}}),
            vec3(3, 2, 1));
}

TEST_F(ExrLayers, CoordinatesAreNoLuminance) {
  EXPECT_EQ(pixel({{"", {"Layer.Normal.X", "Layer.Normal.Y", "Layer.Normal.Z", "Layer.Shadow.R"}}}),
            vec3(4, 0, 0));
  EXPECT_THROW(pixel({{"", {"N.X", "N.Y", "N.Z"}}}), Error);
}

TEST_F(ExrLayers, PanoramasAndTexturesAlike) {
  const std::string path = write({{"depth", {"Z"}}, {"x", {"R", "G", "B"}}, {"rgba", {"R", "G", "B"}}});
  EXPECT_EQ(read_panorama(std::span(&path, 1), warnings)->image.pixels[0], vec3(5, 6, 7));
  read_texels(path, warnings);
  ASSERT_EQ(warnings.warnings().size(), 1u);
  EXPECT_EQ(warnings.warnings()[0].count, 2);
}

} // namespace
} // namespace candela
