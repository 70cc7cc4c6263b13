#include "sim/build/scene_types.h"

#include "sim/build/body_settings.h"
#include "sim/build/body_types.h"
#include "sim/build/read_settings.h"
#include "sim/scene/definition.h"

namespace rend {

const ElementType& body_type() {
  static const ElementType type = [] {
    ElementType t{"body", "a body that deforms", attributes_of<BodySettings>(), {}};
    for (const auto& part : {shape_types(), matter_types(), motion_types(), law_types(), probe_types()})
      t.children.insert(t.children.end(), part.begin(), part.end());
    t.children.push_back({&contact_type(), 0, -1});
    return t;
  }();
  return type;
}

const ElementType& time_type() {
  static const ElementType type{
      "time", "time step, integrator and duration", attributes_of<TimeSettings>(), {}};
  return type;
}

double duration_of(const PresetNode& time) {
  return duration_of(read_settings<TimeSettings>(time));
}

} // namespace rend
