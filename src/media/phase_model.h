#pragma once
// The interface of phase functions. One model is one file of this folder, and an entry of the list in
// media/phase_function.h.
//
//   kName      what files call it
//   kHelp      what scatters so, in a few words
//   rows()     a std::array of PhaseRow, one for each of its values
//   closure()  its PhaseClosure, which rendering uses
//
// All depend on the angle theta alone between the directions of travel before and after; theta = 0: straight
// on.

#include "core/fields.h"
#include "core/math.h"

#include <array>
#include <concepts>
#include <variant>

namespace candela {

/// By how much light turns. Near straight on and straight back, where narrow functions have their peaks, the
/// cosine as a float says nothing of the angle.
struct Turn {
  float forward;  ///< 1 - cos(theta), in [0, 2]
  float backward; ///< 1 + cos(theta)

  static Turn from_forward(float one_minus_cos) { return {one_minus_cos, 2 - one_minus_cos}; }
  /// Between the directions of travel before and after. Both unit directions point away from the point, as
  /// those of a BsdfModel do.
  static Turn between(vec3 wo, vec3 wi) {
    return {std::min(0.5f * length_squared(wo + wi), 2.0f), std::min(0.5f * length_squared(wo - wi), 2.0f)};
  }
  Turn reversed() const { return {backward, forward}; }
  /// From whichever is the more accurate.
  float cosine() const { return forward < backward ? 1 - forward : backward - 1; }
  float sine() const { return std::sqrt(forward * backward); }
};

/// - eval: density of directions, 1/sr; over the sphere it integrates to 1. There is no cosine in it.
/// - sample: the turn for u and choice in [0, 1), distributed as eval().
/// - mean_cosine: of that distribution ("g").
template <class P>
concept PhaseClosure = requires(const P& p, Turn turn, float u, float choice) {
  { p.eval(turn) } -> std::same_as<float>;
  { p.sample(u, choice) } -> std::same_as<Turn>;
  { p.mean_cosine() } -> std::same_as<float>;
};

/// The row of one value of a model.
template <class Model>
struct PhaseRow : FieldInfo {
  std::variant<float Model::*> member;
};

} // namespace candela
