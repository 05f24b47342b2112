#pragma once
// A material of any type that is complete by itself, with one value for each key of any type, for the
// settings override.* and the lab's options.

#include "materials/material.h"

#include <tuple>

namespace candela {

namespace detail {

template <class Variant>
struct TupleOf;
template <class... Models>
struct TupleOf<std::variant<Models...>> {
  using Tuple = std::tuple<Models...>;
  /// How many different keys their rows have.
  static constexpr std::size_t key_count() {
    std::array<std::string_view, (Models::rows().size() + ...)> keys{};
    std::size_t count = 0;
    auto add = [&](std::string_view key) {
      for (std::size_t i = 0; i < count; ++i)
        if (keys[i] == key) return;
      keys[count++] = key;
    };
    auto add_all = [&](const auto& rows) {
      for (const auto& row : rows) add(row.key);
    };
    (add_all(Models::rows()), ...);
    return count;
  }
};

} // namespace detail

inline constexpr std::size_t kMaterialKeyCount = detail::TupleOf<ScatteringModel>::key_count();

struct MaterialChoice {
  int type = 0; ///< index into scattering_type_names()
  /// Of a key, the value is that of the first model in the list which has it.
  detail::TupleOf<ScatteringModel>::Tuple models;
  bool operator==(const MaterialChoice&) const = default;
};

/// The rows of all types' values, each key once, in the order of the list: kMaterialKeyCount of them.
std::span<const Field<MaterialChoice>> material_choice_fields();

/// The row of material_choice_fields() belongs to a parameter, which a closure may depend on.
bool is_parameter_key(std::string_view key);

/// The material that is chosen. Values that its type has no room for, or that mean something else in a type
/// (ModelRow::kept) are left at its default unless `all`.
Material chosen_material(const MaterialChoice& choice, bool all);

} // namespace candela
