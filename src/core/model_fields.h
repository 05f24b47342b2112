#pragma once
// Field tables of structs that hold one of several models, such as materials and lights. Such an Owner has a
// `name` and a `model`, a std::variant. Each alternative of the variant offers
//
//   kName   what files call it
//   rows()  a std::array of rows: a FieldInfo with a `member`, a std::variant of pointers to data members

#include "core/fields.h"

#include <array>
#include <utility>
#include <variant>
#include <vector>

namespace candela {

template <class Owner, std::size_t Type>
using ModelOf = std::variant_alternative_t<Type, decltype(Owner::model)>;
template <class Owner>
using ModelTypes = std::make_index_sequence<std::variant_size_v<decltype(Owner::model)>>;

/// The models' names, in the order of the variant.
template <class Owner>
constexpr auto model_names() {
  return []<std::size_t... Type>(std::index_sequence<Type...>) {
    return std::array<std::string_view, sizeof...(Type)>{ModelOf<Owner, Type>::kName...};
  }
  (ModelTypes<Owner>());
}

/// A default Owner with the default model of the type.
template <class Owner>
Owner with_model(int type) {
  Owner owner;
  [&]<std::size_t... Type>(std::index_sequence<Type...>) {
    ((static_cast<int>(Type) == type ? void(owner.model.template emplace<Type>()) : void()), ...);
  }
  (ModelTypes<Owner>());
  return owner;
}

/// Where a field's value is stored in a member. Types that hold more than the value overload it.
template <class T>
void* value_address(T& member) {
  return &member;
}

/// Calls use(member) with the member of the model that the row describes. The owner's model must be of the
/// type.
template <std::size_t Type, std::size_t Row, class Owner, class Use>
decltype(auto) with_member(Owner& owner, Use use) {
  static constexpr auto kRows = ModelOf<Owner, Type>::rows();
  auto& model = std::get<Type>(owner.model);
  return std::visit([&](auto member) -> decltype(auto) { return use(model.*member); }, kRows[Row].member);
}

/// The Field of a row.
template <class Owner, std::size_t Type, std::size_t Row>
Field<Owner> model_field() {
  static constexpr auto kRows = ModelOf<Owner, Type>::rows();
  return {kRows[Row], [](Owner& owner) {
            return with_member<Type, Row>(owner, [](auto& member) { return value_address(member); });
          }};
}

/// For each type a std::vector<Entry>: make.operator()<Type, Row>() for each of its rows, then the entries of
/// common(std::integral_constant<std::size_t, Type>()).
template <class Owner, class Entry, class Make, class Common>
std::vector<std::vector<Entry>> model_tables(Make make, Common common) {
  auto table = [&](auto type) {
    constexpr std::size_t kType = decltype(type)::value;
    std::vector<Entry> entries;
    [&]<std::size_t... Row>(std::index_sequence<Row...>) {
      (entries.push_back(make.template operator()<kType, Row>()), ...);
    }
    (std::make_index_sequence<ModelOf<Owner, kType>::rows().size()>());
    for (const Entry& entry : common(type)) entries.push_back(entry);
    return entries;
  };
  return [&]<std::size_t... Type>(std::index_sequence<Type...>) {
    return std::vector<std::vector<Entry>>{table(std::integral_constant<std::size_t, Type>())...};
  }
  (ModelTypes<Owner>());
}

/// Changes the owner's type. The name stays; all else becomes the new type's default, but that
/// copy(to row, changed, from row, owner) may copy the values of rows with the same key. `rows_of(type)` are
/// the entries of model_tables().
template <class Owner, class RowsOf, class Copy>
void change_model(Owner& owner, int type, RowsOf rows_of, Copy copy) {
  const int before = static_cast<int>(owner.model.index());
  if (before == type) return;
  Owner changed = with_model<Owner>(type);
  changed.name = owner.name;
  for (const auto& to : rows_of(type))
    for (const auto& from : rows_of(before))
      if (from.key == to.key) copy(to, changed, from, owner);
  owner = std::move(changed);
}

} // namespace candela
