#include "sim/build/read_settings.h"
#include "sim/build/shape.h"

namespace rend {
namespace {

const ElementType& create_type() {
  static const ElementType type{
      "create", "an empty shape, which the rules of <apply> build up", attributes_of<CreateSettings>(), {}};
  return type;
}

} // namespace

template <> const Fields<CreateSettings>& fields_of() {
  static const Fields<CreateSettings> fields{field(
      &CreateSettings::dimension,
      integer("dimension", "2: the rules build a sheet; 3: a solid").at_least(2).at_most(3).is_required())};
  return fields;
}

void make_map(Body& body, const CreateSettings& shape, const Placement&) {
  check_settings(shape);
  body.map = std::make_unique<EmbeddedMap>(shape.dimension);
}

ShapeType create_shape() {
  return {create_type,
          [](const PresetNode& node) -> ShapeSettings { return read_settings<CreateSettings>(node); }};
}

} // namespace rend
