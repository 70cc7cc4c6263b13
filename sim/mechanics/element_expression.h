// A quantity that differs from element to element (a face of a sheet, a volume of a solid): an expression of
// the place of the element at rest, such as a strength (fracture/strength.h) or a density (mass.h).
//
//   rest              X [m], the middle of its vertices; its coordinates are x(rest), y(rest), z(rest)
//   u, v              where it lies in a picture on the body, 0 to 1, to the right and up: the mean of the
//                     texture coordinates of its corners, where the mesh has some; else what BodyAtRest says
//                     of X
//   picture           the brightness of a picture at (u, v), 0 black to 1 white (mask.h)
//   random            one draw for each element, between 0 and 1: a hash of X and of the seed
//   weibull(m)        (V/v)^(1/m) (−ln(1 − random))^(1/m), v: volume (area) of the element, V: of the body,
//                     both at rest; or V as given: weibull(m, V) [m³, m²]
//   in(name)          whether all vertices of the element are in this group of the mesh file; no element that
//                     is made later, and not of others, is
//
// It is evaluated when the body is built, and for elements that a rule makes of nothing when they are made.
#pragma once

#include "sim/embedding/selector.h"
#include "sim/expression/expression.h"
#include "sim/mechanics/mask.h"

#include <functional>
#include <memory>
#include <string>

namespace rend {

// What an expression needs beside its text.
struct ExpressionSettings {
  int seed = 0;                          // of random and weibull
  std::string picture = {};              // its file, as a preset names it; empty: none
  std::shared_ptr<const Mask> mask = {}; // its pixels, read by whoever builds the scene; null: it was not read
};
template <> const Fields<ExpressionSettings>& fields_of();

// Which quantity it is, for messages and bounds.
struct ElementQuantity {
  std::string element;   // of the preset: "tear"
  std::string attribute; // "strength"
  double above, most;    // bounds of its values, in its unit
  std::string hint;      // an expression that stays above it
  std::string example;   // of an expression with a picture
};

// Whose elements they are.
struct BodyAtRest {
  EmbeddedMap& map;
  const VertexGroups& groups;
  // (u, v) of a place X [m]; empty: there is none, and u, v and picture are those of the picture's middle.
  std::function<TexturePlace(const Vec3&)> in_picture = {};
};

// Whether it asks for u, v or picture, or for picture itself; false for what is no expression.
bool asks_for_picture_place(const std::string& expression);
bool asks_for_picture(const std::string& expression);

class ElementExpression {
public:
  // UserError: no such expression or group, a picture that is not used, not there or was not read, or a seed
  // without draws.
  ElementExpression(const std::string& text, const ExpressionSettings& settings, ElementQuantity quantity,
                    const BodyAtRest& body, const SettingsSource& source);
  // UserError, also in the midst of a run: not above the quantity's bound, not finite, weibull of what is not
  // above 0.
  double at(const EmbeddedMap& map, Dart element) const;
  void forget_groups() { groups_.clear(); } // their slots are those of the start

  // Where there is no expression. UserError: settings of one, a seed or a picture, are given.
  static void refuse_unused(const ElementQuantity& quantity, const SettingsSource& source);

private:
  struct Element;
  void check(const ExpressionSettings& settings) const;
  TexturePlace picture_place(const EmbeddedMap& map, const std::vector<Dart>& corners,
                             const Vec3& middle) const;
  double random_at(const Vec3& middle) const;
  Value supply(const ExpressionCall& call, std::span<const Value> arguments, const Element& element) const;

  Expression expression_;
  ElementQuantity quantity_;
  int seed_;
  std::shared_ptr<const Mask> mask_;
  std::function<TexturePlace(const Vec3&)> in_picture_; // empty: it is not asked for
  bool has_place_ = false;                              // u, v or picture are used
  double size_ = 0;                                     // [m³], of a sheet [m²]: of the body at rest
  VertexGroups groups_;
  SettingsSource source_;
};

} // namespace rend
