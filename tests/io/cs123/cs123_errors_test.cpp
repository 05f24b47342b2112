// Invalid CS123 scenes, and the locations of the errors.

#include "io/cs123/cs123_files.h"

#include <fmt/format.h>

namespace candela {
namespace {

using test::Cs123Reader;

struct XmlError {
  const char* name;
  const char* xml; ///< line 2 of the file
  const char* start;
  const char* part;
};
class Cs123Errors : public Cs123Reader, public ::testing::WithParamInterface<XmlError> {};
TEST_P(Cs123Errors, AreLocated) {
  EXPECT_TRUE(test::says(error(GetParam().xml), GetParam().start, {GetParam().part}));
}
#define CANDELA_ROOT(inside) "<object type='tree' name='root'><transblock>" inside "</transblock></object>"
const XmlError kCs123Errors[] = {
    {"NoRoot", "", "s.xml:1:1: scenefile: ", "no tree named root"},
    {"Syntax", "<object type='tree'", "s.xml:3:1: XML: ", ""},
    {"Unclosed", "<object>", "s.xml:3:3: XML: ", "mismatch"},
    {"TwoCameras", "<cameradata/><cameradata/>", "s.xml:2:14: cameradata: ", "second camera"},
    {"CameraNumber", "<cameradata><pos x='1' y='2' z='c'/></cameradata>",
     "s.xml:2:30: pos: ", "'c' is no finite number"},
    {"CameraMissing", "<cameradata><pos x='1' z='2'/></cameradata>",
     "s.xml:2:13: pos: ", "the attribute y is missing"},
    {"CameraInfinite", "<cameradata><up x='1' z='2' y = \"1e99\"/></cameradata>",
     "s.xml:2:29: up: ", "no finite number"},
    {"HeightAngle", "<cameradata><heightangle v='180'/></cameradata>",
     "s.xml:2:13: heightangle: ", "0.1 to 179"},
    {"LooksNowhere", "<cameradata><look x='0' y='0' z='0'/></cameradata>",
     "s.xml:2:1: cameradata: ", "nowhere"},
    {"UpAlongView", "<cameradata><look x='0' y='3' z='0'/></cameradata>",
     "s.xml:2:1: cameradata: ", "parallel"},
    {"Coefficient", "<globaldata><kd v='-1'/></globaldata>", "s.xml:2:13: kd: ", "negative"},
    {"SpotAngle", "<lightdata><type v='spot'/><angle v='200'/></lightdata>",
     "s.xml:2:28: angle: ", "from 0.01 to 180"},
    {"Penumbra", "<lightdata><type v='spot'/><penumbra v='-1'/></lightdata>",
     "s.xml:2:28: penumbra: ", "out of range"},
    {"SpotDirection", "<lightdata><type v='spot'/><direction x='0' y='0' z='0'/></lightdata>",
     "s.xml:2:1: lightdata: ", "no length"},
    {"AreaWidth", "<lightdata><type v='area'/><width v='0'/></lightdata>",
     "s.xml:2:28: width: ", "no length"},
    {"FunctionZero", "<lightdata><function a='0' b='0' c='0'/></lightdata>",
     "s.xml:2:12: function: ", "infinite"},
    {"FunctionNegative", "<lightdata><function a='0' b='-1' c='1'/></lightdata>",
     "s.xml:2:12: function: ", "negative"},
    {"LightType", "<lightdata><type v='sun'/></lightdata>", "s.xml:2:18: lightdata: ", "no light type 'sun'"},
    {"LightColor", "<lightdata><color r='1' g='-1' b='1'/></lightdata>", "s.xml:2:12: color: ", "negative"},
    {"LightDirection", "<lightdata><type v='directional'/><direction x='0' y='0' z='0'/></lightdata>",
     "s.xml:2:1: lightdata: ", "no length"},
    {"TopPrimitive", "<object type='primitive' name='sphere'/>", "s.xml:2:1: object: ", "only named trees"},
    {"SecondTree", "<object type='tree' name='a'/><object type='tree' name='a'/>",
     "s.xml:2:31: object: ", "second tree 'a'"},
    {"ObjectType", CANDELA_ROOT("<object type='group'/>"), "s.xml:2:53: object: ", "no object type 'group'"},
    {"Primitive", CANDELA_ROOT("<object type='primitive' name='teapot'/>"),
     "s.xml:2:70: object: ", "no primitive 'teapot'"},
    {"MeshNoFile", CANDELA_ROOT("<object type='primitive' name='mesh'/>"),
     "s.xml:2:45: object: ", "without a file"},
    {"MeshMissing", CANDELA_ROOT("<object type='primitive' name='mesh' filename='x.obj'/>"),
     "s.xml:2:82: filename: ", "no file 'x.obj'"},
    {"RotateAxis", CANDELA_ROOT("<rotate x='0' y='0' z='0' angle='1'/>"),
     "s.xml:2:45: rotate: ", "no length"},
    {"MatrixSize", CANDELA_ROOT("<matrix>1 2 3</matrix>"), "s.xml:2:45: matrix: ", "3 numbers"},
    {"MatrixRow", CANDELA_ROOT("<matrix><row a='1' b='2' c='3'/></matrix>"),
     "s.xml:2:53: row: ", "attribute d is missing"},
    {"Flat", CANDELA_ROOT("<scale x='0' y='1' z='1'/><object type='primitive' name='sphere'/>"),
     "s.xml:2:71: transblock: ", "flattens"},
    {"NoMaster", "<object type='tree' name='tree'/>" CANDELA_ROOT("<object type='master' name='tre'/>"),
     "s.xml:2:78: object: ", "did you mean 'tree'?"},
    {"Cycle", CANDELA_ROOT("<object type='master' name='root'/>"),
     "s.xml:2:45: object: ", "'root' contains itself"},
    {"LongCycle",
     "<object type='tree' name='a'><transblock><object type='master' name='b'/></transblock></object>"
     "<object type='tree' name='b'><transblock><object type='master' "
     "name='a'/></transblock></object>" CANDELA_ROOT("<object type='master' name='a'/>"),
     "s.xml:2:137: object: ", "'a' contains itself"},
    {"TextureNoFile", CANDELA_ROOT("<object type='primitive' name='sphere'><texture/></object>"),
     "s.xml:2:84: texture: ", "names no file"},
};
#undef CANDELA_ROOT
INSTANTIATE_TEST_SUITE_P(All, Cs123Errors, ::testing::ValuesIn(kCs123Errors),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(Cs123Reader, OtherXml) {
  files.write("s.xml", "<?xml version='1.0'?>\n<scene version='0.6'/>");
  EXPECT_TRUE(test::says(files.error("s.xml"), "s.xml:2:1: scene: ", {"<scene> is no CS123 scene"}));
  files.write("s.xml", "");
  EXPECT_TRUE(test::says(files.error("s.xml"), "s.xml:1:1: XML: "));
  files.write("s.xml", std::string("<\0s\0c\0", 6));
  EXPECT_TRUE(test::says(files.error("s.xml"), "s.xml:1:2: scene: ", {"NUL"}));
}

TEST_F(Cs123Reader, CapsDepthAndGrowth) {
  std::string deep, shut;
  for (int i = 0; i < 70; ++i) deep += "<object type='tree'><transblock>", shut += "</transblock></object>";
  EXPECT_TRUE(
      test::says(error(root(deep + "<object type='primitive' name='sphere'/>" + shut), ExitCode::limit),
                 "s.xml:2:", {"64 levels"}));
  // Each master object has two instances of the previous one: 2^40 spheres in 40 lines.
  auto doubling = [](const std::string& first) {
    std::string trees = "<object type='tree' name='t0'>" + first + "</object>\n";
    for (int i = 1; i <= 40; ++i) {
      std::string half =
          "<transblock><object type='master' name='t" + std::to_string(i - 1) + "'/></transblock>";
      trees += fmt::format("<object type='tree' name='t{}'>{}{}</object>\n", i, half, half);
    }
    return trees + root("<object type='master' name='t40'/>");
  };
  EXPECT_TRUE(test::says(
      error(doubling("<transblock><object type='primitive' name='sphere'/></transblock>"), ExitCode::limit),
      "s.xml:2:", {"1000000 instances"}));
  EXPECT_TRUE(test::says(error(doubling(""), ExitCode::limit), "s.xml:", {"4000000"}));
}

} // namespace
} // namespace candela
