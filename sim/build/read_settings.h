// Settings from a checked element of a preset.
#pragma once

#include "sim/base/settings.h"

namespace rend {

// The places of the element and its attributes. Refers to the element, which must outlive it.
inline SettingsSource source_of(const PresetNode& node) {
  return {
      [&node](std::string_view attribute) { return attribute.empty() ? node.place() : node.place(attribute); },
      [&node](std::string_view attribute) { return node.given(attribute); }};
}

template <class S> S read_settings(const PresetNode& node) {
  S settings;
  for (const Field<S>& field : fields_of<S>())
    if (const AttributeValue* value = node.find(field.type.name)) field.take(settings, *value);
  settings.source = source_of(node);
  return settings;
}

} // namespace rend
