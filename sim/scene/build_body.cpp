#include "sim/scene/build_body.h"

#include "sim/base/math.h"
#include "sim/mesh/sheet.h"
#include "sim/scene/selector.h"

#include <fmt/format.h>

#include <stdexcept>

namespace rend {
namespace {

SheetShape sheet_shape(const Node& node) {
  SheetShape shape;
  const std::string& pattern = node.text("pattern");
  shape.pattern = pattern == "quads"       ? SheetPattern::Quads
                  : pattern == "triangles" ? SheetPattern::Triangles
                  : pattern == "crossed"   ? SheetPattern::Crossed
                                           : SheetPattern::Mixed;
  const std::string& close = node.text("close");
  shape.closure = close == "none"   ? SheetClosure::None
                  : close == "loop" ? SheetClosure::Loop
                                    : SheetClosure::Twist;
  shape.nx = static_cast<int>(node.integers("cells")[0]);
  shape.ny = static_cast<int>(node.integers("cells")[1]);
  if (24.0 * shape.nx * shape.ny >= Dart::none_value) // the most darts that a cell can have
    node.fail("cells",
              fmt::format("{} x {} cells are more than a map of 2^32 darts holds", shape.nx, shape.ny));
  const bool size = node.given("size"), corners = node.given("corners");
  if (size == corners)
    throw UserError(Exit::BadInput, node.place(),
                    size ? "<sheet> has both a size and corners" : "<sheet> has neither a size nor corners",
                    "give one of them: size=\"1 1\"");
  if (shape.closure != SheetClosure::None && corners)
    node.fail("corners", "a band has no corners", "give its size: around and across");
  if (shape.closure != SheetClosure::None && shape.nx < 3)
    node.fail("cells", "a band needs at least 3 cells around");
  if (size) {
    shape.lx = node.numbers("size")[0];
    shape.ly = node.numbers("size")[1];
    shape.corners = rectangle(shape.lx, shape.ly);
  } else {
    for (std::size_t c = 0; c < 4; ++c) {
      const double* x = node.numbers("corners").data() + 3 * c;
      shape.corners[c] = Vec3(x[0], x[1], x[2]);
    }
  }
  return shape;
}

Eigen::Matrix3d rotation_about(int axis, double degrees) {
  const double c = cosine_of_degrees(degrees), s = sine_of_degrees(degrees);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(j, j) = r(k, k) = c;
  r(j, k) = -s;
  r(k, j) = s;
  return r;
}

void place(PolygonMesh& mesh, const Node* node) {
  if (!node) return;
  const Vec3 angles = node->vector("rotate"), shift = node->vector("translate");
  const Eigen::Matrix3d turn = node->number("scale") * rotation_about(2, angles.z()) *
                               rotation_about(1, angles.y()) * rotation_about(0, angles.x());
  for (Vec3& x : mesh.points) x = (turn * x).eval() + shift;
}

void build_mesh(Body& body, const Node& node) {
  const Node& sheet = *node.child("sheet");
  PolygonMesh mesh = sheet_polygons(sheet_shape(sheet));
  place(mesh, node.child("place"));
  body.map = sheet_from(mesh);
  for_each_face(*body.map, [&](Dart d) {
    if (rest_area(*body.map, d) > 0) return;
    const Vec3 x = body.map->rest_of(d);
    throw UserError(
        Exit::BadInput, sheet.place(),
        fmt::format("a cell of the sheet at ({:.4g}, {:.4g}, {:.4g}) has no area", x.x(), x.y(), x.z()),
        "move the corners apart");
  });
}

void build_mass(Body& body, const Node& node) {
  const bool total = node.given("total"), density = node.given("density");
  if (total == density)
    throw UserError(Exit::BadInput, node.place(), "<mass> needs either total or density",
                    "total=\"0.1\", or density=\"300\" with thickness=\"0.001\"");
  if (density && !node.given("thickness"))
    throw UserError(Exit::BadInput, node.place(), "the density of a sheet needs its thickness",
                    "thickness=\"0.001\"");
  if (total && node.given("thickness"))
    node.fail("thickness", "has no use where the total mass is given", "leave it out, or give the density");
  CornerMass embedding;
  if (density) {
    embedding.density = node.number("density") * node.number("thickness");
  } else {
    double area = 0;
    for_each_face(*body.map, [&](Dart d) { area += rest_area(*body.map, d); });
    embedding.density = node.number("total") / area;
  }
  body.mass = &body.map->add(embedding);
}

// How far a material's formulas can be trusted on the cells that there are.
void note_exactness(Body& body, const SpringMaterial& material) {
  bool triangles = false, quads = false;
  for_each_face(*body.map, [&](Dart d) {
    const int sides = sides_of_face(body.map->map(), d);
    triangles = triangles || sides == 3;
    quads = quads || sides == 4;
  });
  const double nu = material.poisson;
  if (quads && std::abs(nu - 1.0 / 3) > 1e-3)
    body.notes.push_back(fmt::format(
        "springs on rectangles keep the shear modulus, but behave as with poisson {:.4g} and young {:.4g} "
        "(exact at poisson 1/3 alone)",
        1 / (3 * nu + 2), 3 * material.young * (1 + 3 * nu) / (2 * (2 + 3 * nu))));
  if (triangles)
    body.notes.push_back(
        "springs on triangles give young and poisson back for equilateral ones at poisson 1/3 alone: squares "
        "halved "
        "along one diagonal then behave, along their sides, as with poisson 0 and 1.125 times young");
}

void build_springs(Body& body, const Node& node) {
  std::optional<SpringMaterial> material;
  if (node.given("young")) {
    if (!node.given("thickness"))
      node.fail("young", "stiffness from young needs the thickness of the sheet", "thickness=\"0.001\"");
    material = SpringMaterial{node.number("young"), node.number("poisson"), node.number("thickness")};
    note_exactness(body, *material);
  }
  for (const char* name : {"poisson", "thickness"})
    if (!material && node.given(name))
      node.fail(name, "has no use without young", "give young, or leave it out");
  const std::string& fold = node.text("cumulated");
  body.cumulated = fold == "auto" ? Cumulated::Auto : fold == "yes" ? Cumulated::Yes : Cumulated::No;
  for (const auto& child : node.children()) {
    for (const InteractionType& type : all_interactions()) {
      if (type.element != child->name() || (!type.kind.empty() && child->text("kind") != type.kind)) continue;
      std::vector<std::string> why_not;
      if (auto made = type.make(*body.map, {*child, material, why_not}))
        body.interactions.push_back(std::move(made));
      for (auto* list : {&body.left_out, &body.notes})
        list->insert(list->end(), why_not.begin(), why_not.end());
    }
  }
}

void build_viscosity(Body& body, const Node& node) {
  const double value = node.number("value");
  if (value == 0) return;
  if (node.text("per") == "body") { // as the mass is spread: one rate for all, and no array
    body.uniform_drag = value / total_mass(*body.map, *body.mass);
    return;
  }
  CornerDrag embedding;
  embedding.per_vertex = value;
  body.drag = &body.map->add(embedding);
}

Motion motion_of(const Node& node) {
  Motion motion;
  const std::string& axes = node.text("axes");
  for (std::size_t axis = 0; axis < 3; ++axis)
    motion.axes[axis] = axes.find(static_cast<char>('x' + axis)) != std::string::npos;
  if (node.name() == "fix") return motion;
  int given = 0;
  for (const char* name : {"velocity", "displacement", "gradient"}) given += node.given(name);
  if (given != 1)
    throw UserError(Exit::BadInput, node.place(), "<drive> needs one of velocity, displacement, gradient");
  if (node.given("velocity")) motion.velocity = node.vector("velocity");
  if (node.given("displacement")) motion.displacement = node.vector("displacement");
  if (node.given("gradient"))
    motion.gradient =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(node.numbers("gradient").data());
  motion.from = node.number("from");
  if (node.given("until")) motion.until = node.number("until");
  if (motion.until < motion.from) node.fail("until", "the drive ends before it starts");
  motion.then_free = node.text("then") == "free";
  return motion;
}

void build_constraints(Body& body, const Node& node) {
  for (const auto& child : node.children()) {
    if (child->name() != "fix" && child->name() != "drive") continue;
    if (body.constraints.motions().size() == 64)
      throw UserError(Exit::BadInput, child->place(), "a body takes at most 64 <fix> and <drive>");
    body.constraints.add(*body.map, motion_of(*child), select_vertices(*body.map, *child));
  }
}

LawSettings law_settings(const Node& node) {
  LawSettings law;
  for (const CriterionType& type : all_criteria())
    if (type.name == node.text("criterion")) law.criterion = &type;
  const std::string& change = node.given("change") ? node.text("change") : law.criterion->default_change;
  std::string fitting;
  for (const ChangeType& type : all_changes()) {
    const bool fits = std::find(type.cells.begin(), type.cells.end(), law.criterion->cell) != type.cells.end();
    if (fits) fitting += (fitting.empty() ? "" : ", ") + type.name;
    if (fits && type.name == change) law.change = &type;
  }
  if (!law.change)
    node.fail("change", fmt::format("'{}' does not fit the criterion '{}'", change, law.criterion->name),
              "these do: " + fitting);
  law.threshold = node.number("threshold");
  law.from = node.number("from");
  if (node.given("until")) law.until = node.number("until");
  if (law.until < law.from) node.fail("until", "the law ends before it starts");
  law.max_per_step = node.integer("max-per-step");
  return law;
}

void build_laws(Body& body, const Node& node) {
  const std::vector<const Node*> laws = node.all("tear");
  if (laws.empty()) {
    body.left_out.push_back("tearing: no law, so no criterion is bound and no border is remembered");
    return;
  }
  body.border = &body.map->add(BornBorder{});
  for (const Node* law : laws) {
    body.laws.emplace_back(*body.map, law_settings(*law));
    if (body.laws.back().settings().criterion->elementary && body.cumulated == Cumulated::Yes)
      law->fail("criterion", "looks at each spring by itself, and cumulated=\"yes\" folds them",
                "leave cumulated at auto");
  }
}

void build_contact(Body& body, const Node& node, std::optional<double> floor) {
  const Node* contact = node.child("contact");
  if (!contact) {
    if (!floor) return;
    body.left_out.push_back("contact: the floor is drawn, and this body falls through it (no <contact>)");
    body.notes.push_back(body.left_out.back());
    return;
  }
  if (!floor)
    throw UserError(Exit::BadInput, contact->place(), "there is no floor to be in contact with",
                    "add <world><floor z=\"0\"/></world>");
  body.floor_contact = FloorContact{*floor + contact->number("thickness"), contact->number("friction")};
}

} // namespace

std::unique_ptr<Body> build_body(const Node& node, const Vec3& gravity, std::optional<double> floor) {
  auto body = std::make_unique<Body>();
  body->name = node.text("name");
  body->node = &node;
  body->gravity = Record(gravity);
  build_mesh(*body, node);
  build_mass(*body, *node.child("mass"));
  if (const Node* springs = node.child("springs")) build_springs(*body, *springs);
  if (const Node* viscosity = node.child("viscosity")) build_viscosity(*body, *viscosity);
  if (!body->drag) body->left_out.push_back("viscosity per particle: none, so no array of it");
  build_constraints(*body, node);
  if (body->constraints.motions().empty()) body->left_out.push_back("prescribed motions: no fix and no drive");
  build_laws(*body, node);
  build_contact(*body, node, floor);
  return body;
}

} // namespace rend
