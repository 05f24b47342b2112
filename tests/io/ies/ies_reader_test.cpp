// Photometric files: handmade ones of each symmetry against closed forms, and malformed ones.

#include "core/error.h"
#include "io/ies/ies_reader.h"
#include "support/scratch_folder.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

struct File {
  std::string head = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] nobody\nTILT=NONE\n";
  double multiplier = 1, ballast = 1, lamp = 1;
  int type = 1;
  std::vector<double> vertical, horizontal;

  /// value(vertical, horizontal) in degrees.
  template <class Value>
  std::string text(Value value) const {
    std::string t = head + fmt::format("1 1000 {} {} {} {} 2 0.1 0.2 0.3\r\n{} {} 40\n", multiplier,
                                       vertical.size(), horizontal.size(), type, ballast, lamp);
    for (double v : vertical) t += fmt::format("{} ", v);
    t += "\n";
    for (double h : horizontal) t += fmt::format("{},", h);
    t += "\n";
    for (double h : horizontal) {
      for (double v : vertical) t += fmt::format("{}\n", value(v, h));
      t += "\n";
    }
    return t;
  }
};

std::vector<double> range(double first, double last, double step) {
  std::vector<double> out;
  for (double x = first; x <= last + 1e-9; x += step) out.push_back(x);
  return out;
}

IesProfile parse(const std::string& text, std::size_t warnings = 0) {
  WarningList list;
  IesProfile p = parse_ies(text, "lamps/a.ies", list);
  EXPECT_EQ(list.warnings().size(), warnings) << (list.warnings().empty() ? "" : list.warnings()[0].text);
  EXPECT_STREQ(ies_profile_problem(p), "");
  return p;
}

/// Away from a luminaire, type C, degrees.
vec3 direction_c(double v, double h) {
  const double t = v * std::numbers::pi / 180, p = h * std::numbers::pi / 180;
  return vec3(glm::dvec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), -std::cos(t)));
}

/// Flux by brute force, over directions.
double summed_flux(const IesProfile& p, int n = 400) {
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      const double z = -1 + (2 * j + 1.0) / n, phi = std::numbers::pi * (i + 0.5) / n,
                   r = std::sqrt(1 - z * z);
      sum += static_cast<double>(p.intensity(vec3(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z))));
    }
  return sum * 4 * std::numbers::pi / (2.0 * n * n);
}

TEST(IesReader, UniformIntensityHasTheFluxOfASphere) {
  const std::vector<double> whole = range(0, 180, 10);
  for (const std::vector<double>& horizontal : {std::vector<double>{0}, range(0, 90, 30), range(0, 180, 45),
                                                range(0, 360, 60), range(90, 270, 30), range(0, 330, 30)}) {
    const File f{.vertical = whole, .horizontal = horizontal};
    const IesProfile p = parse(f.text([](double, double) { return 100; }));
    EXPECT_NEAR(p.flux(), 4 * std::numbers::pi * 100, 1e-3) << horizontal.back();
    EXPECT_EQ(p.maximum(), 100);
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 1000; ++i) {
      const vec3 d(normal(random), normal(random), normal(random));
      ASSERT_FLOAT_EQ(p.intensity(d), 100);
      ASSERT_FLOAT_EQ(p.relative_intensity(d), 1);
    }
  }
}

TEST(IesReader, HalfSpaceHasHalfTheFluxAndNothingAbove) {
  const File down{.vertical = range(0, 90, 5), .horizontal = {0}};
  const IesProfile p = parse(down.text([](double, double) { return 7; }));
  EXPECT_NEAR(p.flux(), 2 * std::numbers::pi * 7, 1e-4);
  EXPECT_EQ(p.intensity({0, 0, -1}), 7) << "nadir";
  EXPECT_EQ(p.intensity({0.3f, 0.3f, -0.1f}), 7);
  EXPECT_EQ(p.intensity({0.3f, 0.3f, 0.1f}), 0);
  const File up{.vertical = range(90, 180, 5), .horizontal = {0}};
  const IesProfile q = parse(up.text([](double, double) { return 7; }));
  EXPECT_NEAR(q.flux(), 2 * std::numbers::pi * 7, 1e-4);
  EXPECT_EQ(q.intensity({0, 0, 1}), 7);
  EXPECT_EQ(q.intensity({0, 0.3f, -0.1f}), 0);
}

TEST(IesReader, LambertianFluxIsPiTimesItsPeak) {
  const File f{.vertical = range(0, 90, 0.5), .horizontal = {0}};
  const IesProfile p =
      parse(f.text([](double v, double) { return 500 * std::cos(v * std::numbers::pi / 180); }));
  EXPECT_NEAR(p.flux() / (std::numbers::pi * 500), 1, 5e-5);
}

TEST(IesReader, SymmetriesAreCompleted) {
  // cos^2 of half the horizontal angle to the direction in which the profile is brightest.
  auto lobe = [](double v, double h, double towards, double times) {
    return 10 + 90 * std::sin(v * std::numbers::pi / 180) *
                    std::pow(std::cos(times * (h - towards) * std::numbers::pi / 360), 2);
  };
  struct Case {
    std::vector<double> horizontal;
    double towards, times;
  };
  for (const Case& c : {Case{range(0, 360, 5), 40, 1},
                        {range(0, 355, 5), 40, 1},
                        {range(0, 180, 5), 0, 1},
                        {range(90, 270, 5), 90, 1},
                        {range(90, 270, 5), 270, 1},
                        {range(0, 90, 5), 0, 2}}) {
    const File f{.vertical = range(0, 180, 5), .horizontal = c.horizontal};
    const IesProfile p = parse(f.text([&](double v, double h) { return lobe(v, h, c.towards, c.times); }));
    for (double h = -355; h < 720; h += 12.5)
      for (double v = 2; v < 180; v += 11)
        EXPECT_NEAR(p.intensity(direction_c(v, h)), lobe(v, h, c.towards, c.times), 0.4)
            << c.horizontal.front() << ' ' << c.horizontal.back() << ": " << v << ' ' << h;
    EXPECT_NEAR(p.flux() / summed_flux(p), 1, 1e-3);
    // Closed form: 4 pi 10 + 90 (integral of sin^2 v = pi/2) (integral of cos^2 = pi).
    EXPECT_NEAR(p.flux() / (4 * std::numbers::pi * 10 + 45 * std::numbers::pi * std::numbers::pi), 1, 2e-3);
  }
}

TEST(IesReader, ValuesAreBilinearBetweenAngles) {
  const File f{.vertical = {0, 60, 180}, .horizontal = {0, 90, 360}};
  const IesProfile p = parse(f.text([](double v, double h) { return v + 2 * h * (h < 360); }));
  EXPECT_NEAR(p.intensity(direction_c(30, 0)), 30, 1e-3);
  EXPECT_NEAR(p.intensity(direction_c(30, 45)), 120, 1e-3);
  EXPECT_NEAR(p.intensity(direction_c(120, 90)), 300, 1e-3);
  EXPECT_NEAR(p.intensity(direction_c(60, 225)), 60 + 90, 1e-3);
  EXPECT_NEAR(p.intensity(5.0f * direction_c(60, 225)), 60 + 90, 1e-3) << "of any length";
  EXPECT_NEAR(p.flux() / summed_flux(p), 1, 1e-3);
}

TEST(IesReader, TypesAAndBTurnAboutOtherAxes) {
  for (int type : {2, 3}) {
    const File whole{.type = type, .vertical = range(-90, 90, 10), .horizontal = range(-90, 90, 10)};
    const IesProfile half = parse(whole.text([](double, double) { return 100; }));
    EXPECT_EQ(half.type, type == 2 ? PhotometricType::b : PhotometricType::a);
    EXPECT_NEAR(half.flux(), 2 * std::numbers::pi * 100, 1e-3) << "half of all directions";
    EXPECT_NEAR(half.flux() / summed_flux(half), 1, 5e-3);
    // Type A looks along +x, type B along -z.
    const vec3 ahead = type == 3 ? vec3(1, 0, 0) : vec3(0, 0, -1), side(0, -1, 0);
    EXPECT_EQ(half.intensity(ahead), 100);
    EXPECT_EQ(half.intensity(-ahead), 0);
    const IesProfile horizontal = parse(whole.text([](double, double h) { return 90 + h; }));
    EXPECT_NEAR(horizontal.intensity(ahead), 90, 1e-3);
    EXPECT_NEAR(horizontal.intensity(ahead + side), 135, 1e-3) << "clockwise from above";
    EXPECT_NEAR(horizontal.intensity(ahead - side), 45, 1e-3);
    const IesProfile vertical = parse(whole.text([](double v, double) { return 90 + v; }));
    const vec3 up = type == 3 ? vec3(0, 0, 1) : vec3(1, 0, 0);
    EXPECT_NEAR(vertical.intensity(ahead + up), 135, 1e-3);
    EXPECT_NEAR(vertical.intensity(ahead - up), 45, 1e-3);
    // A quarter, mirrored twice.
    const File quarter{.type = type, .vertical = range(0, 90, 10), .horizontal = range(0, 90, 10)};
    const IesProfile p = parse(quarter.text([](double v, double h) { return 200 - v - h; }));
    for (vec3 at : {ahead + side, ahead - side}) EXPECT_NEAR(p.intensity(at), 155, 1e-3);
    for (vec3 at : {ahead + up, ahead - up}) EXPECT_NEAR(p.intensity(at), 155, 1e-3);
  }
}

TEST(IesReader, FactorsAreInTheValues) {
  File f{.multiplier = 2.5, .ballast = 0.8, .lamp = 3, .vertical = {0, 180}, .horizontal = {0}};
  auto ten = [](double, double) { return 10; };
  EXPECT_FLOAT_EQ(parse(f.text(ten)).maximum(), 20) << "the last factor is for future use";
  for (const char* head : {"IESNA91\n[TEST]\nTILT=NONE\n", "a lamp\nof the first edition\nTILT = NONE\r\n"}) {
    f.head = head;
    EXPECT_FLOAT_EQ(parse(f.text(ten)).maximum(), 60) << head;
  }
  for (const char* head : {"IESNA:LM-63-1995\r\nTILT=NONE\r\n", "IES:LM-63-2019\rTILT=NONE\r"}) {
    f.head = head;
    EXPECT_FLOAT_EQ(parse(f.text(ten)).maximum(), 20) << head;
  }
}

TEST(IesReader, TiltIsReadPast) {
  File f{.vertical = {0, 180}, .horizontal = {0}};
  f.head = "IESNA:LM-63-1995\nTILT=INCLUDE\n1\n3\n0 45 90\n1.0 .95 0.9\n";
  EXPECT_EQ(parse(f.text([](double, double) { return 10; }), 1).maximum(), 10);
  f.head = "IESNA:LM-63-1995\nTILT=../../etc/passwd\n";
  EXPECT_EQ(parse(f.text([](double, double) { return 10; }), 1).maximum(), 10);
}

TEST(IesReader, OddButReadableFiles) {
  // Commas, lone CRs, numbers without digits before the point, a plus, Latin-1 in a keyword.
  const std::string text = "IESNA91\r[LUMINAIRE] Stra\xdf"
                           "e, 40\xb0\rTILT=NONE\r1,-1,1,3,1,1,2,-.1,0,0\r1 1 0\r"
                           "0,90,180\r0\r+1. .5e1,1E-400";
  const IesProfile p = parse(text);
  EXPECT_EQ(p.candela, (std::vector<float>{1, 5, 0}));
  EXPECT_EQ(p.name, "a.ies");
  EXPECT_EQ(p.source, "lamps/a.ies");
  File f{.vertical = {0, 180}, .horizontal = {0}};
  EXPECT_EQ(parse(f.text([](double v, double) { return v == 0 ? -1 : 1; }), 1).candela,
            (std::vector<float>{0, 1}));
  parse(f.text([](double, double) { return 1; }) + "END", 1);
  EXPECT_EQ(parse(f.text([](double, double) { return 0; })).relative_intensity({0, 0, 1}), 0) << "dark";
}

TEST(IesReader, MalformedFilesAreRefusedWithTheirPlace) {
  auto error = [](const std::string& text, ExitCode code = ExitCode::bad_input) -> std::string {
    WarningList warnings;
    try {
      parse_ies(text, "a.ies", warnings);
    } catch (const Error& e) {
      EXPECT_EQ(static_cast<int>(e.code()), static_cast<int>(code)) << e.what();
      return e.what();
    }
    ADD_FAILURE() << text << " was read";
    return "";
  };
  const std::string head = "IESNA91\nTILT=NONE\n";
  struct Case {
    std::string text, message;
    ExitCode code = ExitCode::bad_input;
  };
  for (const Case& c : {
           Case{"", "a.ies: photometry: no line TILT= is in it: "},
           {"IESNA91\n1 2 3", "a.ies: photometry: no line TILT="},
           {head, "a.ies:3:1: lamps: the file ends here: "},
           {head + "1 1000 x", "a.ies:3:8: multiplier: 'x' is no number: "},
           {"IESNA91\r\nTILT=NONE\r\n1 1000\r\nx", "a.ies:4:1: multiplier: 'x' is no number: "},
           {head + "1 1000 nan", "a.ies:3:8: multiplier: 'nan' is not finite: "},
           {head + "1 1000 0", "a.ies:3:8: multiplier: 0 is not above 0: "},
           {head + "1 inf", "a.ies:3:3: lumens per lamp: 'inf' is not finite: "},
           {head + "1 1000 1 -3", "a.ies:3:10: vertical angles: -3 is no count from 1: "},
           {head + "1 1000 1 2.5", "a.ies:3:10: vertical angles: 2.5 is no count from 1: "},
           {head + "1 1000 1 1e9", "a.ies:3:10: vertical angles: ", ExitCode::limit},
           {head + "1 1000 1 4000 4000", "a.ies:3:15: angles: 4000 x 4000 values", ExitCode::limit},
           {head + "1 1 1 2 1 4 2 0 0 0", "a.ies:3:11: photometric type: 4 is unknown: give an integer"},
           {head + "1 1 1 1000 1000 1 2 0 0 0\n1 1 0\n0 1 2",
            "a.ies:4:5: candela values: 1002000 numbers are due"},
           {head + "1 1 1 3 1 1 2 0 0 0\n1 1 0\n0 90 80\n0\n1 1 1",
            "a.ies:5:6: vertical angles: 80 follows 90: "},
           {head + "1 1 1 2 1 1 2 0 0 0\n1 1 0\n0 200\n0\n1 1",
            "a.ies:5:3: vertical angles: 200 is not in 0 to 180"},
           {head + "1 1 1 2 2 1 2 0 0 0\n1 1 0\n0 90\n0 45\n1 1 1 1",
            "a.ies: horizontal angles: from 0 to 45"},
           {head + "1 1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n1 1e39",
            "a.ies:7:3: candela values: '1e39' is not finite"},
           {head + "1 1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n1 1e30", "a.ies:7:3: candela values: 1e+30 cd"},
           {head + "1 1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n1     ",
            "a.ies:7:7: candela values: the file ends here"},
           {head + "1 1 1 2 1 3 2 0 0 0\n1 1 0\n0 90\n0\n1 1", "a.ies: horizontal angles: "},
           {"IESNA91\nTILT=INCLUDE\n1\n100000", "a.ies:4:1: tilt angles: ", ExitCode::limit},
           {"IESNA91\nTILT=INCLUDE\n1\n4000\n1 2", "a.ies:4:1: tilt angles: 8000 numbers are due"},
       })
    EXPECT_TRUE(error(c.text, c.code).starts_with(c.message))
        << error(c.text, c.code) << "\nfor " << c.message;
}

TEST(IesReader, RandomDamageEndsInAnErrorOrAProfile) {
  SCOPED_TRACE(test::seed_note());
  std::mt19937_64 random(test::fresh_seed());
  const File f{.vertical = range(0, 180, 30), .horizontal = range(0, 90, 30)};
  const std::string good = f.text([](double v, double h) { return 500 - v - h; });
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (int k = 0; k < 1 + i % 4; ++k) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
      case 0: text[at] = static_cast<char>(random()); break;
      case 1: text.resize(at + 1); break;
      case 2: text.erase(at, 1 + random() % 20); break;
      case 3: text.insert(at, std::string(1 + random() % 9, "0-9.e,\n"[random() % 7])); break;
      }
      if (text.empty()) text.push_back('0');
    }
    WarningList warnings;
    try {
      const IesProfile p = parse_ies(text, "a.ies", warnings);
      EXPECT_STREQ(ies_profile_problem(p), "");
      EXPECT_TRUE(std::isfinite(p.flux()) && std::isfinite(p.intensity({0.1f, 0.2f, 0.3f})));
    } catch (const Error& e) { EXPECT_TRUE(std::string(e.what()).starts_with("a.ies:")) << e.what(); }
  }
}

TEST(IesReader, FilesOfTheDisk) {
  const test::ScratchFolder folder;
  const File f{.vertical = {0, 180}, .horizontal = {0}};
  test::write_text(folder / "l.ies", f.text([](double, double) { return 3; }));
  WarningList warnings;
  const auto p = read_ies(folder / "l.ies", warnings);
  EXPECT_EQ(p->name, "l.ies");
  EXPECT_EQ(p->maximum(), 3);
  EXPECT_THROW(read_ies(folder / "none.ies", warnings), Error);
  EXPECT_THROW(read_ies(folder.path(), warnings), Error);
}

} // namespace
} // namespace candela
