#include "materials/material_choice.h"

#include <algorithm>
#include <vector>

namespace candela {

namespace {

template <class Model, std::size_t Row>
void* value_of(MaterialChoice& choice) {
  static constexpr auto rows = Model::rows();
  return std::visit(
      [&](auto member) -> void* {
        auto& value = std::get<Model>(choice.models).*member;
        if constexpr (requires { value.value; })
          return &value.value;
        else
          return &value;
      },
      rows[Row].member);
}

struct ChoiceFields {
  std::vector<Field<MaterialChoice>> rows;
  std::vector<std::string_view> parameters;

  template <class Model, std::size_t... Row>
  void add(std::index_sequence<Row...>) {
    static constexpr auto all = Model::rows();
    auto add_row = [&](const FieldInfo& info, auto address, bool is_parameter) {
      if (std::ranges::find(rows, info.key, &FieldInfo::key) != rows.end()) return;
      rows.push_back({info, address});
      if (is_parameter) parameters.push_back(info.key);
    };
    (add_row(all[Row], value_of<Model, Row>, all[Row].member.index() < 2), ...);
  }
};

const ChoiceFields& choice_fields() {
  static const ChoiceFields all = [] {
    ChoiceFields fields;
    [&]<class... Models>(std::type_identity<std::variant<Models...>>) {
      (fields.add<Models>(std::make_index_sequence<Models::rows().size()>()), ...);
    }(std::type_identity<ScatteringModel>());
    return fields;
  }();
  return all;
}

} // namespace

std::span<const Field<MaterialChoice>> material_choice_fields() { return choice_fields().rows; }

bool is_parameter_key(std::string_view key) {
  return std::ranges::find(choice_fields().parameters, key) != choice_fields().parameters.end();
}

Material chosen_material(const MaterialChoice& choice, bool all) {
  Material material = default_material(choice.type);
  auto& values = const_cast<MaterialChoice&>(choice);
  for (const auto& from : material_choice_fields()) {
    const MaterialField* to = find_material_field(choice.type, from.key);
    if (to == nullptr || !(all || to->kept) || to->type != from.type) continue;
    if (field_problem(*to, from.address(values)).empty())
      field_copy(*to, to->address(material), from.address(values));
  }
  return material;
}

} // namespace candela
