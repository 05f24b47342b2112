// The published lenses as tables, and tables that are none.

#include "render/camera/lens_testing.h"

namespace candela::test {
namespace {

TEST(LensTable, FocalLengthsAreThePublishedOnesToThePrecisionOfTheTable) {
  for (const LensPrescription& lens : kLenses) {
    const std::vector<DoubleRow> rows = rows_of(lens.interfaces);
    const double f = system_matrix(rows).focal_length(),
                 published = static_cast<double>(lens.table_focal_length);
    // Numbers are printed to three decimals (the patent of the double Gauss has more).
    double allowance = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (double DoubleRow::*member : {&DoubleRow::radius, &DoubleRow::thickness, &DoubleRow::eta}) {
        if (rows[i].*member == 0 || (member == &DoubleRow::eta && rows[i].eta == 1)) continue;
        std::vector<DoubleRow> changed = rows;
        changed[i].*member += 0.0005;
        allowance += std::abs(system_matrix(changed).focal_length() - f);
      }
    EXPECT_NEAR(f, published, allowance + 0.5e-3 * published) << lens.name;
    EXPECT_NEAR(f, published, 2e-3 * published) << lens.name;
  }
  const AbcdMatrix gauss = system_matrix(find_lens("double_gauss")->interfaces);
  EXPECT_NEAR(gauss.focal_length(), 100, 0.1); // 0.02 %
  EXPECT_NEAR(gauss.back_focal_length(), 71.436, 0.071436);
  EXPECT_EQ(find_lens("pinhole"), nullptr);
}

TEST(LensTable, TablesThatAreNoLensSayWhy) {
  const std::vector<LensInterface> good(kDoubleGaussTable, std::end(kDoubleGaussTable));
  EXPECT_EQ(lens_problem(good), "");
  auto broken = [&](auto change) {
    std::vector<LensInterface> table = good;
    change(table);
    std::string problem = lens_problem(table);
    if (!problem.empty()) { EXPECT_THROW(LensSystem(table, {}), std::invalid_argument); }
    return problem;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(broken([](auto& t) { t.clear(); }), "");
  EXPECT_NE(broken([](auto& t) { t.resize(1000, t[0]); }), "");
  EXPECT_NE(broken([](auto& t) { t[3].curvature_radius = kNan; }), "");
  EXPECT_NE(broken([](auto& t) { t[3].thickness = -1; }), "");
  EXPECT_NE(broken([](auto& t) { t[3].eta = 0; }), "");
  EXPECT_NE(broken([](auto& t) { t[3].aperture_diameter = 0; }), "");
  EXPECT_NE(broken([](auto& t) { t[3].aperture_diameter = 1e6f; }), "");
  EXPECT_NE(broken([](auto& t) { t.back().eta = 1.5f; }), "");
  EXPECT_NE(broken([](auto& t) { t.erase(t.begin() + 5); }), "") << "no stop";
  EXPECT_NE(broken([](auto& t) { t.insert(t.begin() + 5, t[5]); }), "") << "two stops";
  EXPECT_NE(broken([](auto& t) {
              t = {{-50, 2, 1.5f, 20}, {50, 2, 1, 20}, {0, 0, 1, 10}};
            }),
            "")
      << "it diverges";
  EXPECT_EQ(broken([](auto& t) { t = {{50, 2, 1.5f, 20}, {-50, 2, 1, 20}, {0, 0, 1, 10}}; }), "");
  EXPECT_NE(broken([](auto& t) {
              for (auto& row : t) row.eta = 1;
            }),
            "")
      << "many stops, no glass";
}

} // namespace
} // namespace candela::test
