#include "core/error.h"
#include "core/fields.h"
#include "core/hash.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <bit>

namespace {

using namespace candela;
using namespace candela::test;

constexpr std::string_view kNames[] = {"red", "green", "blue"};
enum class Name : int { red, green, blue };

FieldInfo info(FieldType type, double lo = -INFINITY, double hi = INFINITY) {
  FieldInfo f;
  f.key = "thing";
  f.type = type;
  f.minimum = lo;
  f.maximum = hi;
  if (type == FieldType::choice) f.choices = kNames;
  return f;
}

/// The message of the usage error that reading gives, and proof that it left the value alone.
template <class T>
std::string refusal(const FieldInfo& field, T value, std::string_view text) {
  T kept = value;
  try {
    field_from_text(field, &value, text);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_TRUE(field_equal(field, &value, &kept));
    return e.what();
  }
  ADD_FAILURE() << "'" << text << "' was taken";
  return {};
}

TEST(Fields, FloatsReadBackToTheSameBits) {
  FieldInfo real = info(FieldType::real), angle = info(FieldType::angle), point = info(FieldType::point);
  SCOPED_TRACE(seed_note());
  for (std::uint64_t i = 0; i < 20000; ++i) {
    auto x = std::bit_cast<float>(static_cast<std::uint32_t>(hash_combine(fresh_seed(), i)));
    if (!std::isfinite(x)) continue;
    float back = 0;
    field_from_text(real, &back, field_to_text(real, &x));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(back), std::bit_cast<std::uint32_t>(x));
    vec3 v(x, -x, 1), w;
    field_from_text(point, &w, field_to_text(point, &v));
    ASSERT_EQ(v, w);
    float theta = kPi * to_unit_float(std::bit_cast<std::uint32_t>(x));
    field_from_text(angle, &back, field_to_text(angle, &theta));
    ASSERT_EQ(back, theta) << field_to_text(angle, &theta);
  }
}

TEST(Fields, TextIsAsShortAsItMayBe) {
  float x = 0.1f, quarter = radians(45.0f);
  vec3 v(0.1f, 2, -3);
  EXPECT_EQ(field_to_text(info(FieldType::real), &x), "0.1");
  EXPECT_EQ(field_to_text(info(FieldType::angle), &quarter), "45");
  EXPECT_EQ(field_to_text(info(FieldType::point), &v), "0.1 2 -3");
}

TEST(Fields, EveryTypeIsRead) {
  bool b = false;
  for (auto [text, value] :
       {std::pair{"true", true}, {"off", false}, {"on", true}, {"false", false}, {"1", true}, {"0", false}}) {
    field_from_text(info(FieldType::boolean), &b, text);
    EXPECT_EQ(b, value) << text;
  }
  int n = 0;
  field_from_text(info(FieldType::integer), &n, "-12");
  EXPECT_EQ(n, -12);
  field_from_text(info(FieldType::integer), &n, "+7");
  EXPECT_EQ(n, 7);
  float x = 0;
  field_from_text(info(FieldType::real), &x, "1e-3");
  EXPECT_EQ(x, 1e-3f);
  field_from_text(info(FieldType::angle), &x, "180");
  EXPECT_EQ(x, kPi);
  Name name = Name::red;
  field_from_text(info(FieldType::choice), &name, "blue");
  EXPECT_EQ(name, Name::blue);
  EXPECT_EQ(field_to_text(info(FieldType::choice), &name), "blue");
  vec3 v;
  field_from_text(info(FieldType::color), &v, "0.5");
  EXPECT_EQ(v, vec3(0.5f));
  field_from_text(info(FieldType::color), &v, " 1,2,\t3 ");
  EXPECT_EQ(v, vec3(1, 2, 3));
}

TEST(Fields, WhatDoesNotFitIsRefusedAndNothingChanges) {
  EXPECT_EQ(refusal(info(FieldType::integer, 1, 9), 3, "12"),
            "thing: '12' does not fit: give an integer from 1 to 9");
  for (const char* text : {"", "1.5", "x", "3 4", "99999999999999999999", " 3", "0x3"})
    refusal(info(FieldType::integer), 3, text);
  for (const char* text : {"", "nan", "inf", "-inf", "1e99", "1,5", "1 2", "abc"})
    refusal(info(FieldType::real), 2.0f, text);
  refusal(info(FieldType::real, 0, 1), 0.5f, "1.0001");
  refusal(info(FieldType::angle, 0.1, 179), 0.5f, "180");
  refusal(info(FieldType::boolean), true, "yes");
  for (const char* text : {"", "1 2", "1 2 3 4", "1 2 x", "1 nan 2"})
    refusal(info(FieldType::color, 0, 1), vec3(0.5f), text);
  refusal(info(FieldType::color, 0, 1), vec3(0.5f), "0 0 1.5");
  EXPECT_NE(refusal(info(FieldType::choice), 1, "bleu").find("one of red, green, blue"), std::string::npos);
}

TEST(Fields, ProblemsOfValues) {
  float nan = NAN, inf = INFINITY, two = 2;
  EXPECT_EQ(field_problem(info(FieldType::real), &nan), "is not a number");
  EXPECT_EQ(field_problem(info(FieldType::real), &inf), "is not finite");
  EXPECT_EQ(field_problem(info(FieldType::real, 0, 1), &two), "2 is out of range");
  EXPECT_EQ(field_problem(info(FieldType::real, 0, 2), &two), "");
  const float tenth = 0.1f, millionth = 1e-6f; // above and below what the limits are in double
  EXPECT_EQ(field_problem(info(FieldType::real, 1e-6, 0.1), &tenth), "");
  EXPECT_EQ(field_problem(info(FieldType::real, 1e-6, 0.1), &millionth), "");
  float half_turn = kPi;
  EXPECT_EQ(field_problem(info(FieldType::angle, 0, 180), &half_turn), "");
  for (int value : {-1, 3}) EXPECT_NE(field_problem(info(FieldType::choice), &value), "");
  vec3 v(0, 0, NAN);
  EXPECT_NE(field_problem(info(FieldType::color), &v), "");
}

TEST(Fields, EqualAndCopyLookAtTheWholeValue) {
  vec3 a(1, 2, 3), b(1, 2, 4);
  FieldInfo point = info(FieldType::point);
  EXPECT_FALSE(field_equal(point, &a, &b));
  field_copy(point, &a, &b);
  EXPECT_TRUE(field_equal(point, &a, &b));
  bool x = true, y = false;
  EXPECT_FALSE(field_equal(info(FieldType::boolean), &x, &y));
  field_copy(info(FieldType::boolean), &y, &x);
  EXPECT_TRUE(y);
  Name n = Name::red, m = Name::blue;
  EXPECT_FALSE(field_equal(info(FieldType::choice), &n, &m));
  field_copy(info(FieldType::choice), &n, &m);
  EXPECT_EQ(n, Name::blue);
}

TEST(Fields, DomainSaysWhatToGive) {
  EXPECT_EQ(field_domain(info(FieldType::boolean)), "true or false");
  EXPECT_EQ(field_domain(info(FieldType::choice)), "one of red, green, blue");
  EXPECT_EQ(field_domain(info(FieldType::angle, 0.1, 179)), "a number from 0.1 to 179, in degrees");
  EXPECT_EQ(field_domain(info(FieldType::integer, 0)), "an integer from 0");
  EXPECT_EQ(field_domain(info(FieldType::real)), "a number");
}

TEST(Fields, NearestName) {
  std::string_view names[] = {"path.max_depth", "path.rr_depth", "film.width"};
  EXPECT_EQ(nearest_name("path.maxdepth", names), "path.max_depth");
  EXPECT_EQ(nearest_name("film.widht", names), "film.width");
  EXPECT_EQ(nearest_name("path.max_depth", names), "path.max_depth");
  EXPECT_EQ(nearest_name("zzzzzzzzzzzz", names), "");
  EXPECT_EQ(nearest_name("abc", {}), "");
}

TEST(Fields, RangesReadWell) {
  auto real = [](double lo, double hi) { return field_domain(info(FieldType::real, lo, hi)); };
  EXPECT_EQ(real(0, 1e9), "a number from 0 to 1e9");
  EXPECT_EQ(real(-2.5e6, 120), "a number from -2.5e6 to 120");
  EXPECT_EQ(real(0.1, 123456), "a number from 0.1 to 123456");
  EXPECT_EQ(real(0, INFINITY), "a number from 0");
  EXPECT_EQ(real(-INFINITY, 7), "a number of at most 7");
  EXPECT_EQ(real(-INFINITY, INFINITY), "a number");
  EXPECT_EQ(field_domain(info(FieldType::integer, 0, 1e9)), "an integer from 0 to 1000000000")
      << "1e9 is none";
  FieldInfo length = info(FieldType::real, 0);
  length.above_minimum = true;
  EXPECT_EQ(field_domain(length), "a number above 0");
  length.maximum = 5;
  EXPECT_EQ(field_domain(length), "a number above 0 and at most 5");
  float value = 1;
  EXPECT_NE(refusal(length, value, "0").find("above 0"), std::string::npos);
  field_from_text(length, &value, "1e-30");
  EXPECT_EQ(value, 1e-30f);
}

} // namespace
