#include "core/variant.h"

#include <gtest/gtest.h>

#include <array>

namespace candela::test {
namespace {

template <int N>
struct Numbered {
  int value = N;
};

template <class>
struct Many;
template <int... N>
struct Many<std::integer_sequence<int, N...>> {
  using Type = std::variant<Numbered<N>...>;
  static inline const std::array<Type, sizeof...(N)> all{Type(Numbered<N>{})...};
};
using Forty = Many<std::make_integer_sequence<int, 40>>;

TEST(VisitVariant, CallsTheAlternativeThatThereIs) {
  for (std::size_t i = 0; i < Forty::all.size(); ++i)
    EXPECT_EQ(visit_variant([](const auto& a) { return a.value; }, Forty::all[i]), static_cast<int>(i));
}

TEST(VisitVariant, GivesReferencesThatCanBeChanged) {
  Forty::Type variant = Numbered<17>{};
  visit_variant([](auto& a) { a.value = 5; }, variant);
  EXPECT_EQ(std::get<Numbered<17>>(variant).value, 5);
  int& value = visit_variant([](auto& a) -> int& { return a.value; }, variant);
  value = 6;
  EXPECT_EQ(std::get<Numbered<17>>(variant).value, 6);
}

} // namespace
} // namespace candela::test
