#include "textures/texture.h"

#include <fmt/format.h>

#include <array>

namespace candela {

namespace {

template <std::size_t... I>
constexpr auto kind_names(std::index_sequence<I...>) {
  return std::array{std::string_view(std::variant_alternative_t<I, TextureModel>::kName)...};
}
template <std::size_t... I>
constexpr bool all_are_kinds(std::index_sequence<I...>) {
  return (TextureKind<std::variant_alternative_t<I, TextureModel>> && ...);
}
using Kinds = std::make_index_sequence<std::variant_size_v<TextureModel>>;
static_assert(all_are_kinds(Kinds()));
constexpr auto kNames = kind_names(Kinds());

} // namespace

std::span<const std::string_view> texture_kind_names() { return kNames; }

std::optional<TextureModel> texture_of_kind(std::string_view name) {
  std::optional<TextureModel> found;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((name == kNames[I] ? void(found = std::variant_alternative_t<I, TextureModel>()) : void()), ...);
  }
  (Kinds());
  return found;
}

std::string texture_problem(const Texture& texture) {
  std::string problem;
  visit_texture(texture, [&](const auto& kind, const auto& rows) {
    auto copy = kind;
    for (const auto& row : rows)
      if (auto p = field_problem(row, row.address(copy)); !p.empty() && problem.empty())
        problem = fmt::format("{}: {}; give {}", row.key, p, field_domain(row));
  });
  if (const auto* image = texture.image(); image != nullptr && problem.empty())
    problem = texels_problem(*image->texels);
  return problem;
}

} // namespace candela
