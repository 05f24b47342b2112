#pragma once
// Dispatch on the alternative of a variant, inlined however many alternatives there are.

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace candela {

namespace detail {

template <std::size_t I, class F, class V>
[[gnu::always_inline]] inline decltype(auto) visit_from(F&& f, V&& variant) {
  auto* alternative = std::get_if<I>(&variant);
  if constexpr (I + 1 == std::variant_size_v<std::remove_cvref_t<V>>) {
    if (alternative == nullptr) __builtin_unreachable();
    return std::forward<F>(f)(*alternative);
  } else {
    if (alternative != nullptr) return std::forward<F>(f)(*alternative);
    return visit_from<I + 1>(std::forward<F>(f), variant);
  }
}

} // namespace detail

/// f(alternative) of a variant that has a value; all results of one type. libstdc++'s
/// std::visit is a switch for up to eleven alternatives and a call through a table for more, which the
/// compiler does not inline. This is a chain of comparisons of the index (clang makes a switch of it): put
/// common alternatives first.
template <class F, class V>
[[gnu::always_inline]] inline decltype(auto) visit_variant(F&& f, V&& variant) {
  return detail::visit_from<0>(std::forward<F>(f), variant);
}

} // namespace candela
