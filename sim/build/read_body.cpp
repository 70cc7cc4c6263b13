#include "sim/build/read_body.h"

#include "sim/base/wording.h"
#include "sim/build/read_settings.h"

#include <fmt/format.h>

namespace rend {
namespace {

ShapeSettings read_shape(const PresetNode& body) {
  std::vector<std::string> names;
  const PresetNode* chosen = nullptr;
  const ShapeType* how = nullptr;
  for (const ShapeType& shape : all_shapes()) {
    names.push_back(shape.type().name);
    const PresetNode* here = body.child(names.back());
    if (!here) continue;
    if (chosen)
      throw UserError(Exit::BadInput, here->place(),
                      fmt::format("the body has both a <{}> and a <{}>", chosen->name(), here->name()),
                      "a body has one shape; write two bodies");
    chosen = here;
    how = &shape;
  }
  if (!chosen)
    throw UserError(Exit::BadInput, body.place(), "<body> needs a shape", "one of: " + listed(names));
  return how->read(*chosen);
}

SpringSettings read_spring(const PresetNode& node) {
  const auto word = [&](const char* attribute) {
    return node.type().find(attribute) ? node.text(attribute) : std::string();
  };
  SpringSettings spring = read_settings<SpringSettings>(node);
  spring.type = find_interaction(node.name(), word("kind"), word("where"));
  return spring;
}

SpringsSettings read_springs(const PresetNode& node) {
  SpringsSettings springs = read_settings<SpringsSettings>(node);
  for (const auto& child : node.children()) springs.springs.push_back(read_spring(*child));
  return springs;
}

template <class S> void read_child(const PresetNode& node, const char* name, S& settings) {
  if (const PresetNode* child = node.child(name)) settings = read_settings<S>(*child);
}

template <class S> void read_child(const PresetNode& node, const char* name, std::optional<S>& settings) {
  if (const PresetNode* child = node.child(name)) settings = read_settings<S>(*child);
}

template <class S> void read_all(const PresetNode& node, const char* name, std::vector<S>& settings) {
  for (const PresetNode* child : node.all(name)) settings.push_back(read_settings<S>(*child));
}

} // namespace

BodySettings read_body(const PresetNode& node) {
  BodySettings body = read_settings<BodySettings>(node);
  body.shape = read_shape(node);
  for (const auto& child : node.children())
    if (child->name() == "apply" || child->name() == "subdivide") body.applies.push_back(read_apply(*child));
  read_child(node, "place", body.place);
  read_child(node, "mass", body.mass);
  if (const PresetNode* springs = node.child("springs")) body.springs = read_springs(*springs);
  read_child(node, "elasticity", body.elasticity);
  read_child(node, "viscosity", body.viscosity);
  for (const auto& child : node.children()) { // in the order in which they stand there
    if (child->name() == "fix") body.motions.emplace_back(read_settings<FixSettings>(*child));
    if (child->name() == "drive") body.motions.emplace_back(read_settings<DriveSettings>(*child));
  }
  read_all(node, "load", body.loads);
  read_all(node, "tear", body.tears);
  read_child(node, "contact", body.contact);
  read_all(node, "probe", body.probes);
  read_all(node, "answer", body.answers);
  return body;
}

} // namespace rend
