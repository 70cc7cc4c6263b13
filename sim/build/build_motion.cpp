#include "sim/build/build_motion.h"

#include "sim/build/build_load.h"
#include "sim/build/selector.h"

namespace rend {
namespace {

const ElementType& fix_type() {
  static const ElementType type = [] {
    ElementType t{"fix", "vertices that stay where they are at rest", {}, {}};
    add_selector(t.attributes);
    t.attributes.push_back(
        word("axes", {"x", "y", "z", "xy", "xz", "yz", "xyz"}, "which coordinates").otherwise("xyz"));
    return t;
  }();
  return type;
}

const ElementType& drive_type() {
  static const ElementType type = [] {
    ElementType t{"drive", "vertices that move as prescribed", {}, {}};
    add_selector(t.attributes);
    t.attributes.push_back(numbers("velocity", 3, "m/s", "constant velocity"));
    t.attributes.push_back(numbers("displacement", 3, "m",
                                   "moved by so much between from and until (at once, if until is absent)"));
    t.attributes.push_back(
        numbers("gradient", 9, "", "u = G X, row after row, reached between from and until"));
    t.attributes.push_back(numbers("rotate", 4, "degrees/s",
                                   "turned about the axis x y z at the rate that follows, from `from` on"));
    t.attributes.push_back(numbers("centre", 3, "m", "a point of the axis of rotate").otherwise("0 0 0"));
    t.attributes.push_back(number("from", "s", "held before").at_least(0).otherwise("0"));
    t.attributes.push_back(number("until", "s", "for ever, if absent").at_least(0));
    t.attributes.push_back(word("then", {"hold", "free"}, "after until").otherwise("hold"));
    t.attributes.push_back(
        word("axes", {"x", "y", "z", "xy", "xz", "yz", "xyz"}, "which coordinates").otherwise("xyz"));
    return t;
  }();
  return type;
}

void set_rotation(Motion& motion, const PresetNode& node) {
  const std::vector<double>& given = node.numbers("rotate");
  const Vec3 axis(given[0], given[1], given[2]);
  if (!(axis.norm() > 0))
    node.fail("rotate", "the axis of the rotation has no direction", "rotate=\"0 0 1 90\"");
  motion.axis = axis.normalized();
  motion.rate = given[3];
  motion.centre = node.vector("centre");
}

Motion motion_of(const PresetNode& node) {
  Motion motion;
  const std::string& axes = node.text("axes");
  for (std::size_t axis = 0; axis < 3; ++axis)
    motion.axes[axis] = axes.find(static_cast<char>('x' + axis)) != std::string::npos;
  if (node.name() == "fix") return motion;
  int given = 0;
  for (const char* name : {"velocity", "displacement", "gradient", "rotate"}) given += node.given(name);
  if (given != 1)
    throw UserError(Exit::BadInput, node.place(),
                    given == 0
                        ? "<drive> needs one of velocity, displacement, gradient, rotate"
                        : "<drive> has several of velocity, displacement, gradient, rotate: one of them");
  if (node.given("velocity")) motion.velocity = node.vector("velocity");
  if (node.given("displacement")) motion.displacement = node.vector("displacement");
  if (node.given("gradient"))
    motion.gradient =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(node.numbers("gradient").data());
  if (node.given("rotate")) set_rotation(motion, node);
  if (node.given("centre") && !node.given("rotate"))
    node.fail("centre", "has no use without rotate", "rotate=\"0 0 1 90\" turns by 90 degrees a second");
  motion.from = node.number("from");
  if (node.given("until")) motion.until = node.number("until");
  if (motion.until < motion.from) node.fail("until", "the drive ends before it starts");
  motion.then_free = node.text("then") == "free";
  return motion;
}

void build_constraints(Body& body, const PresetNode& node) {
  for (const auto& child : node.children()) {
    if (child->name() != "fix" && child->name() != "drive") continue;
    if (body.constraints.motions().size() == 64)
      throw UserError(Exit::BadInput, child->place(), "a body takes at most 64 <fix> and <drive>");
    body.constraints.add(*body.map, motion_of(*child), select_vertices(body, *child));
  }
}

} // namespace

std::vector<ChildType> motion_types() {
  return {{&fix_type(), 0, -1}, {&drive_type(), 0, -1}, {&load_type(), 0, -1}};
}

void build_motion(Body& body, const PresetNode& node) {
  build_constraints(body, node);
  if (body.constraints.motions().empty()) body.left_out.emplace_back("prescribed motions: no fix and no drive");
  build_loads(body, node);
}

} // namespace rend
