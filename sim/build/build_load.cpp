#include "sim/build/build_load.h"

#include "sim/build/selector.h"

#include <fmt/format.h>

namespace rend {

const ElementType& load_type() {
  static const ElementType type = [] {
    ElementType t{
        "load",
        "a force from outside on the selected boundary: by area on the outer faces of a solid, by length on "
        "the border of a sheet; in equal parts on the vertices where no whole face or edge is selected",
        {},
        {}};
    add_selector(t.attributes);
    t.attributes.push_back(numbers("force", 3, "N", "in total"));
    t.attributes.push_back(
        numbers("moment", 3, "N m", "about the middle of the boundary, without a force in total"));
    t.attributes.push_back(number("pressure", "Pa",
                                  "on the selected faces, inwards (of a sheet: from where its cells are seen "
                                  "counterclockwise; +z, before it is placed)"));
    t.attributes.push_back(word("follows", {"world", "body"},
                                "whether force and moment keep their direction, or turn with the boundary")
                               .otherwise("world"));
    t.attributes.push_back(number("from", "s", "nothing before").at_least(0).otherwise("0"));
    t.attributes.push_back(
        number("until", "s", "grows from `from` to here; all at once, if absent").at_least(0));
    return t;
  }();
  return type;
}

namespace {

LoadSettings settings_of(const PresetNode& node) {
  using Kind = LoadSettings::Kind;
  int given = 0;
  for (const char* name : {"force", "moment", "pressure"}) given += node.given(name);
  if (given != 1)
    throw UserError(Exit::BadInput, node.place(),
                    given == 0 ? "<load> needs one of force, moment, pressure"
                               : "<load> has several of force, moment, pressure: one of them",
                    given == 0 ? "force=\"0 0 -1\"" : "write a <load> for each");
  LoadSettings settings;
  if (node.given("pressure")) {
    settings.kind = Kind::Pressure;
    settings.pressure = node.number("pressure");
    if (node.given("follows"))
      node.fail("follows", "a pressure always acts along the normals of the body's faces", "leave it out");
  } else {
    settings.kind = node.given("force") ? Kind::Force : Kind::Moment;
    settings.amount = node.vector(node.given("force") ? "force" : "moment");
  }
  settings.with_body = node.text("follows") == "body";
  settings.from = node.number("from");
  if (node.given("until")) {
    settings.until = node.number("until");
    if (settings.until < settings.from) node.fail("until", "the load is whole before it starts");
  }
  return settings;
}

Load load_of(Body& body, const PresetNode& node) {
  using Kind = LoadSettings::Kind;
  const LoadSettings settings = settings_of(node);
  const std::vector<Slot> vertices = select_vertices(body, node);
  const std::string name = fmt::format("load {}", body.loads.loads().size() + 1);
  if (settings.kind == Kind::Pressure) {
    Patch patch = Patch::faces(*body.map, name, vertices);
    if (patch.cells().size() == 0)
      node.fail("pressure", "no face has all its vertices among those selected", "select more of the body");
    return {*body.map, settings, std::move(patch)};
  }
  Load load(*body.map, settings, Patch::boundary(*body.map, name, vertices));
  if (settings.kind == Kind::Moment && !load.possible(*body.map))
    node.fail("moment", "forces on a point, or on a straight line of vertices, give no moment about it",
              "select more than a line: the last row of cells, not their border alone");
  return load;
}

} // namespace

void build_loads(Body& body, const PresetNode& node) {
  for (const PresetNode* load : node.all("load")) body.loads.add(load_of(body, *load));
  if (body.loads.empty()) body.left_out.emplace_back("external forces: no load");
}

} // namespace rend
