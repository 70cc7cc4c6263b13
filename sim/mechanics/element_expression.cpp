#include "sim/mechanics/element_expression.h"

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/wording.h"
#include "sim/embedding/cell_size.h"
#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>

namespace rend {
namespace {

enum class Known : std::size_t { Rest, U, V, Picture, Random, Weibull, In };

const std::vector<ExpressionFunction>& words_of_elements() {
  constexpr auto S = ValueType::Scalar;
  static const std::vector<ExpressionFunction> all{
      {"rest", {}, ValueType::Vector, "the middle of the element at rest [m]"},
      {"u", {}, S, "its place in a picture on the body, to the right, 0 to 1"},
      {"v", {}, S, "likewise, up"},
      {"picture", {}, S, "the brightness of a picture there, 0 to 1"},
      {"random", {}, S, "one draw for each element, between 0 and 1"},
      {"weibull", {S, S}, S, "a draw of Weibull's distribution; of its modulus, and of a volume or area", 1},
      {"in", {ValueType::Name}, ValueType::Condition, "whether the element is in a group of the mesh file"}};
  return all;
}

Expression read_expression(const std::string& text, const ElementQuantity& quantity,
                           const SettingsSource& source) {
  try {
    return {text, words_of_elements(), ValueType::Scalar};
  } catch (const ExpressionError& error) {
    source.fail(quantity.attribute, error.what(), error.hint);
  }
}

bool calls_any(const Expression& expression, std::initializer_list<Known> functions) {
  return std::ranges::any_of(expression.calls(), [&](const ExpressionCall& call) {
    return std::ranges::find(functions, static_cast<Known>(call.function)) != functions.end();
  });
}

// Of each vertex of an element one dart.
const std::vector<Dart>& vertices_of_element(const EmbeddedMap& map, Dart element) {
  thread_local IndexSet seen;
  thread_local std::vector<Dart> darts;
  seen.clear();
  darts.clear();
  collect(map.map(), element_orbit(map.dimension()), element, darts);
  const CellIndex& vertices = map.cells(Vertex);
  std::erase_if(darts, [&](Dart d) { return !seen.insert(vertices.slot(d)); });
  return darts;
}

double size_at_rest(const EmbeddedMap& map, Dart element) { // [m³], [m²]
  return map.dimension() == 3 ? rest_volume(map, element) : rest_area(map, element);
}

void refuse_seed(const ElementQuantity& quantity, const SettingsSource& source) {
  source.fail(
      "seed",
      fmt::format("<{}> has a seed, and no {} that draws anything", quantity.element, quantity.attribute),
      "1 + 0.3*random is an expression that does");
}

void refuse_picture(const ElementQuantity& quantity, const SettingsSource& source) {
  source.fail(
      "picture",
      fmt::format("<{}> names a picture that its {} does not use", quantity.element, quantity.attribute),
      quantity.example + " does");
}

} // namespace

template <> const Fields<ExpressionSettings>& fields_of() {
  using S = ExpressionSettings;
  static const Fields<S> fields{
      field(&S::seed, integer("seed", "of random and weibull: another one gives other draws").at_least(0)),
      field(&S::picture,
            text("picture",
                 "a PNG or JPEG file, relative to the preset, and in its folder or below: its brightness is "
                 "`picture` in the expression, 0 where it is black, 1 where it is white or transparent, in "
                 "linear light. It lies on a sheet, or a mesh with texture coordinates, as a texture of <look> "
                 "does; "
                 "on other bodies it lies across the side along which they are thinnest"))};
  return fields;
}

namespace {

bool asks_for(const std::string& expression, std::initializer_list<Known> functions) {
  try {
    return calls_any({expression, words_of_elements(), {}}, functions);
  } catch (const ExpressionError&) {
    return false;
  }
}

} // namespace

bool asks_for_picture_place(const std::string& expression) {
  return asks_for(expression, {Known::U, Known::V, Known::Picture});
}

bool asks_for_picture(const std::string& expression) {
  return asks_for(expression, {Known::Picture});
}

struct ElementExpression::Element {
  Vec3 middle;                       // [m], at rest
  double size;                       // [m³], of a sheet [m²], at rest
  std::vector<Slot> corners;         // increasing
  std::optional<TexturePlace> place; // none: nothing asks for it
};

ElementExpression::ElementExpression(const std::string& text, const ExpressionSettings& settings,
                                     ElementQuantity quantity, const BodyAtRest& body,
                                     const SettingsSource& source)
    : expression_(read_expression(text, quantity, source)), quantity_(std::move(quantity)),
      seed_(settings.seed), mask_(settings.mask),
      has_place_(calls_any(expression_, {Known::U, Known::V, Known::Picture})), source_(source) {
  check(settings);
  if (has_place_) in_picture_ = body.in_picture;
  for (const ExpressionCall& call : expression_.calls())
    for (const std::string& name : call.names)
      groups_[name] = vertices_of_group(body.groups, name, quantity_.attribute, source);
  const CellIndex& elements = body.map.use(element_orbit(body.map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e)
    if (elements.alive(e)) size_ += size_at_rest(body.map, elements.first_dart(e));
}

void ElementExpression::check(const ExpressionSettings& settings) const {
  const bool shows = calls_any(expression_, {Known::Picture});
  if (source_.given("seed") && !calls_any(expression_, {Known::Random, Known::Weibull}))
    refuse_seed(quantity_, source_);
  if (!settings.picture.empty() && !shows) refuse_picture(quantity_, source_);
  if (!shows || mask_) return;
  if (settings.picture.empty())
    source_.fail(
        quantity_.attribute,
        fmt::format("the {} is that of a picture, and <{}> names none", quantity_.attribute, quantity_.element),
        "picture=\"mask.png\" names one");
  source_.fail("picture",
               in_quotes(settings.picture) + " was not read: this program builds scenes without pictures",
               "give its pixels as ExpressionSettings::mask, or a MaskReader to read_scene()");
}

void ElementExpression::refuse_unused(const ElementQuantity& quantity, const SettingsSource& source) {
  if (source.given("seed")) refuse_seed(quantity, source);
  if (source.given("picture")) refuse_picture(quantity, source);
}

double ElementExpression::at(const EmbeddedMap& map, Dart element) const {
  const std::vector<Dart>& corners = vertices_of_element(map, element);
  Element there{Vec3::Zero(), size_at_rest(map, element), {}, {}};
  for (Dart d : corners) {
    there.middle += map.rest_of(d);
    there.corners.push_back(map.cells(Vertex).slot(d));
  }
  there.middle /= static_cast<double>(there.corners.size());
  if (has_place_) there.place = picture_place(map, corners, there.middle);
  std::sort(there.corners.begin(), there.corners.end());
  const auto where = [&] {
    return fmt::format("at ({:.6g}, {:.6g}, {:.6g})", there.middle.x(), there.middle.y(), there.middle.z());
  };
  try {
    const double value =
        expression_
            .evaluate([&](const ExpressionCall& call, std::size_t, std::span<const Value> arguments) {
              return supply(call, arguments, there);
            })
            .scalar();
    if (value > quantity_.above && value <= quantity_.most) return value;
    const bool low = value <= quantity_.above;
    source_.fail(quantity_.attribute,
                 fmt::format("the {} is {:g} {}, and must be {} {:g}", quantity_.attribute, value, where(),
                             low ? "above" : "at most", low ? quantity_.above : quantity_.most),
                 low ? quantity_.hint : "");
  } catch (const ExpressionError& error) {
    source_.fail(quantity_.attribute, fmt::format("{} ({})", error.what(), where()), error.hint);
  }
}

// Texture coordinates belong to the corners of faces: `corners` are darts of the element's own, in a sheet.
TexturePlace ElementExpression::picture_place(const EmbeddedMap& map, const std::vector<Dart>& corners,
                                              const Vec3& middle) const {
  const Column<TextureCoordinates>* const places =
      map.dimension() == 2 ? find_texture_coordinates(map) : nullptr;
  if (!places) return in_picture_ ? in_picture_(middle) : TexturePlace{};
  TexturePlace mean{0, 0};
  for (Dart d : corners) {
    const TexturePlace& corner = (*places)[map.slot(VertexOfFace, d)];
    mean.u += corner.u / static_cast<double>(corners.size());
    mean.v += corner.v / static_cast<double>(corners.size());
  }
  return mean;
}

double ElementExpression::random_at(const Vec3& middle) const {
  const std::array<double, 3> place{middle.x() + 0.0, middle.y() + 0.0, middle.z() + 0.0}; // no -0
  const std::uint64_t hash = hash_bytes(place.data(), sizeof place, static_cast<std::uint64_t>(seed_));
  return (static_cast<double>(hash >> 12) + 0.5) * 0x1p-52;
}

Value ElementExpression::supply(const ExpressionCall& call, std::span<const Value> arguments,
                                const Element& there) const {
  switch (static_cast<Known>(call.function)) {
  case Known::Rest:
    return vector_value(there.middle.x(), there.middle.y(), there.middle.z());
  case Known::U:
    return scalar_value(there.place->u);
  case Known::V:
    return scalar_value(there.place->v);
  case Known::Picture:
    return scalar_value(mask_->at(*there.place));
  case Known::Random:
    return scalar_value(random_at(there.middle));
  case Known::Weibull: {
    const double modulus = arguments[0].scalar(), whole = arguments.size() > 1 ? arguments[1].scalar() : size_;
    if (!(modulus > 0) || !(whole > 0))
      throw ExpressionError(call.column, "'weibull' is of a modulus above 0, and of a volume or area above 0",
                            "weibull(8) is one of modulus 8");
    return scalar_value(power(whole / there.size * -logarithm(1 - random_at(there.middle)), 1 / modulus));
  }
  case Known::In:
    break;
  }
  const auto group = groups_.find(call.names.front());
  return condition_value(group != groups_.end() && std::includes(group->second.begin(), group->second.end(),
                                                                 there.corners.begin(), there.corners.end()));
}

} // namespace rend
