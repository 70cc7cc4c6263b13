#include "sim/build/read_body.h"

#include "sim/base/wording.h"
#include "sim/build/read_settings.h"

#include <fmt/format.h>

#include <algorithm>

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

ContactPairSettings read_contact_pair(const PresetNode& node) {
  ContactPairSettings pair;
  for (const Field<ContactPairSettings>& field : fields_of<ContactPairSettings>())
    if (node.given(field.type.name)) field.take(pair, *node.find(field.type.name));
  pair.source = source_of(node);
  for (const char* of_all : {"not", "thickness", "overlap"})
    if (node.given(of_all))
      node.fail(of_all, fmt::format("{} counts for all that the body touches, not for a single thing", of_all),
                "write it in the <contact> whose with= names no single thing");
  return pair;
}

[[noreturn]] void refuse_without_kinds(const ContactPairSettings& pair, const std::vector<std::string>& kinds) {
  const std::string near = suggestion(pair.with.front(), kinds);
  pair.source.fail("with",
                   fmt::format("{} is none of {}, and the body has no <contact> with one of these beside it",
                               in_quotes(pair.with.front()), listed(kinds)),
                   (near.empty() ? "" : near + " ") +
                       "add <contact with=\"obstacles\"/>, or with=\"fragments\" for other bodies");
}

// One <contact> for all, and any number for single things, which name these.
std::optional<ContactSettings> read_contact(const PresetNode& body) {
  const std::vector<std::string>& kinds = fields_of<ContactSettings>().front().type.words;
  const auto is_kind = [&](const std::string& word) {
    return std::find(kinds.begin(), kinds.end(), word) != kinds.end();
  };
  std::optional<ContactSettings> contact;
  std::vector<ContactPairSettings> pairs;
  for (const PresetNode* node : body.all("contact")) {
    const std::vector<std::string>& with = node->words("with");
    const auto of_kind = std::count_if(with.begin(), with.end(), is_kind);
    if (of_kind == 0) {
      pairs.push_back(read_contact_pair(*node));
      continue;
    }
    if (static_cast<std::size_t>(of_kind) < with.size()) {
      const std::string& name = *std::find_if_not(with.begin(), with.end(), is_kind);
      const std::string near = suggestion(name, kinds);
      node->fail("with", in_quotes(name) + " is no kind of thing, as what stands beside it is",
                 (near.empty() ? "" : near + " ") + "names have a <contact> of their own");
    }
    if (contact)
      throw UserError(Exit::BadInput, node->place(), "the body has two <contact> for all that it touches",
                      "write one; others name bodies, spheres or boxes, as in with=\"ball\"");
    contact = read_settings<ContactSettings>(*node);
  }
  if (contact) contact->pairs = pairs;
  if (!contact && !pairs.empty()) refuse_without_kinds(pairs.front(), kinds);
  return contact;
}

} // namespace

BodySettings read_body(const PresetNode& node) {
  BodySettings body = read_settings<BodySettings>(node);
  body.shape = read_shape(node);
  for (const auto& child : node.children())
    if (child->name() == "apply" || child->name() == "subdivide") body.applies.push_back(read_apply(*child));
  read_all(node, "slit", body.slits);
  read_child(node, "pieces", body.pieces);
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
  body.contact = read_contact(node);
  read_all(node, "probe", body.probes);
  read_all(node, "answer", body.answers);
  return body;
}

} // namespace rend
