#pragma once
// The numbers and colours of a material.

#include "textures/texture_use.h"

#include <type_traits>

namespace candela {

/// A constant, or a texture's value * texel + offset, clamped to the range of the parameter's row. T is float
/// or vec3.
template <class T>
struct Parameter {
  T value{};   ///< the constant, or the factor of the texture
  T offset{0}; ///< added to a texture
  TextureUse use = standard_use();

  Parameter() = default;
  Parameter(T constant) : value(constant) {} // a material is mostly made of constants
  bool operator==(const Parameter&) const = default;

  bool is_textured() const { return use.texture >= 0; }
  /// The default use of a texture: colours are sRGB, numbers are linear.
  static TextureUse standard_use() {
    TextureUse standard;
    if constexpr (std::is_same_v<T, float>) standard.color_space = ColorSpace::linear;
    return standard;
  }
};

/// Of a field's value (core/model_fields.h): the constant.
template <class T>
void* value_address(Parameter<T>& parameter) {
  return &parameter.value;
}

using NumberParameter = Parameter<float>;
using ColorParameter = Parameter<vec3>;

/// A parameter of either type, found by its key (materials/material.h); null if there is none.
struct ParameterRef {
  NumberParameter* number = nullptr;
  ColorParameter* color = nullptr;

  explicit operator bool() const { return number != nullptr || color != nullptr; }
  TextureUse& use() const { return number != nullptr ? number->use : color->use; }
  void* value() const { return number != nullptr ? static_cast<void*>(&number->value) : &color->value; }
  void* offset() const { return number != nullptr ? static_cast<void*>(&number->offset) : &color->offset; }
  TextureUse standard_use() const {
    return number != nullptr ? NumberParameter::standard_use() : ColorParameter::standard_use();
  }
  /// Both of one type; false if not.
  bool copy_from(const ParameterRef& other) const {
    if (number != nullptr && other.number != nullptr) return *number = *other.number, true;
    if (color != nullptr && other.color != nullptr) return *color = *other.color, true;
    return false;
  }
  bool equals(const ParameterRef& other) const {
    if (number != nullptr && other.number != nullptr) return *number == *other.number;
    return color != nullptr && other.color != nullptr && *color == *other.color;
  }
};

} // namespace candela
