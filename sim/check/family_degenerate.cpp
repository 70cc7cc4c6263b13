// Elements without area, springs without length, coincident points: refused with a place and a hint, or
// simulated without harm.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

namespace rend {
namespace {

struct Odd {
  std::string name, body, world = {}, others = {};
  std::pair<std::string, std::string> file = {};
};

const char* some_springs = "    <mass total=\"0.1\"/>\n    <springs><stretch k=\"60\"/></springs>\n";
const char* plastic =
    "    <mass density=\"100\"/>\n    <elasticity model=\"corotational\" young=\"1e4\" poisson=\"0.3\"/>\n";

Odd mesh(const std::string& name, const std::string& matter, const std::string& file,
         const std::string& content) {
  return {name, fmt::format("    <mesh file=\"{}\"/>\n", file) + matter, {}, {}, {file, content}};
}

std::string msh(const std::string& nodes, int node_count, const std::string& elements, int element_count) {
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      node_count, nodes, element_count, elements);
}

std::vector<Odd> meshes() {
  const std::string cloth = std::string(some_springs) + "";
  return {
      mesh("triangle without area", cloth, "odd-line.obj",
           "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"),
      mesh("triangle with two corners in one place", cloth, "odd-twin.obj",
           "v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"),
      mesh("triangle that names a corner twice", cloth, "odd-twice.obj",
           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\nf 1 2 3\n"),
      mesh("two points in one place, apart", cloth, "odd-apart.obj",
           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n"),
      mesh("the same triangle twice", cloth, "odd-same.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n"),
      mesh("tetrahedron in a plane", plastic, "odd-flat.msh",
           msh("1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n", 4, "1 4 2 0 1 1 2 3 4\n", 1)),
      mesh("tetrahedron inside out", plastic, "odd-turned.msh",
           msh("1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", 4, "1 4 2 0 1 1 3 2 4\n", 1)),
      mesh("sliver: a tetrahedron of 1e-9 of its size", plastic, "odd-sliver.msh",
           msh("1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.3 0.3 1e-9\n", 4, "1 4 2 0 1 1 2 3 4\n", 1)),
      mesh("hexahedron folded over", plastic, "odd-folded.msh",
           msh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 0.2 0.2 -0.5\n8 0 1 1\n", 8,
               "1 5 2 0 1 1 2 3 4 5 6 7 8\n", 1)),
      mesh("numbers that are not finite", cloth, "odd-nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"),
  };
}

std::vector<Odd> generated() {
  const std::string cloth = some_springs;
  return {
      {"sheet folded to a line", "    <sheet cells=\"2 2\" corners=\"0 0 0  1 0 0  1 0 0  0 0 0\"/>\n" + cloth},
      {"sheet with a side of no length",
       "    <sheet cells=\"3 3\" corners=\"0 0 0  1 0 0  0.5 1 0  0.5 1 0\"/>\n" + cloth},
      {"sheet whose area rounds to nothing", "    <sheet cells=\"2 2\" size=\"1e-200 1e-200\"/>\n" + cloth},
      {"bar whose volume rounds to nothing",
       std::string("    <bar cells=\"1 1 1\" size=\"1 1 1e-320\"/>\n") + plastic},
      {"thin bar: 1e-6 of its length",
       std::string("    <bar cells=\"2 1 1\" size=\"1 1e-6 1e-6\"/>\n") + plastic},
      {"scaled to nothing", "    <sheet cells=\"2 2\" size=\"1 1\"/>\n    <place scale=\"0\"/>\n" + cloth},
      {"mass of 0", "    <sheet cells=\"2 2\" size=\"1 1\"/>\n    <mass total=\"0\"/>\n    <springs><stretch "
                    "k=\"1\"/></springs>\n"},
      {"mass that rounds to nothing", "    <sheet cells=\"2 2\" size=\"1 1\"/>\n    <mass total=\"1e-320\"/>\n "
                                      "   <springs><stretch k=\"1\"/></springs>\n"},
      {"stiffness of 1e300", "    <sheet cells=\"2 2\" size=\"1 1\"/>\n    <mass total=\"1\"/>\n    "
                             "<springs><stretch k=\"1e300\"/></springs>\n"},
      {"two bodies in one place",
       "    <sheet cells=\"2 2\" size=\"1 1\"/>\n" + cloth +
           "    <contact with=\"fragments\" thickness=\"0.01\"/>\n",
       "",
       "  <body name=\"other\">\n    <sheet cells=\"2 2\" size=\"1 1\"/>\n" + cloth +
           "    <contact with=\"fragments\" thickness=\"0.01\"/>\n  </body>\n"},
      {"within a sphere",
       "    <sheet cells=\"2 2\" size=\"1 1\"/>\n" + cloth + "    <contact with=\"obstacles\"/>\n",
       "<sphere centre=\"0.5 0.5 0\" radius=\"3\"/>"},
      {"moved out of a sphere",
       "    <sheet cells=\"2 2\" size=\"1 1\"/>\n" + cloth +
           "    <contact with=\"obstacles\" overlap=\"push\"/>\n",
       "<sphere centre=\"0.5 0.5 0\" radius=\"3\"/>"},
      {"contact thicker than its elements",
       "    <sheet cells=\"4 4\" size=\"1 1\"/>\n    <place translate=\"0 0 0.1\"/>\n" + cloth +
           "    <contact with=\"floor fragments\" thickness=\"1\"/>\n",
       "<floor z=\"0\"/>"},
  };
}

CheckCase odd_case(const Odd& odd) {
  Sketch sketch;
  sketch.body = odd.body;
  sketch.world = odd.world;
  sketch.others = odd.others;
  sketch.time = time_of("symplectic", "auto", 1);
  CheckCase one;
  one.name = "degenerate/" + odd.name;
  one.expectation = "refused, with the place and what would work; or simulated: shaken (not in the preset "
                    "file), 2000 steps, all "
                    "numbers finite and no more than 19 times the energy";
  one.preset = sketch.text();
  one.row = odd.name;
  if (!odd.file.first.empty()) one.files.push_back(odd.file);
  one.quick = odd.name.starts_with("t");
  one.run = [](const Bench& bench, Finding& finding) {
    Trial trial;
    try {
      trial = bench.open();
    } catch (const UserError& error) {
      if (error.code != Exit::BadInput) throw;
      finding.verdict = Verdict::Refused;
      finding.what = error.what();
      finding.why = error.hint;
      return;
    }
    const double step = trial->step_size();
    for (const auto& body : trial->bodies()) shake(*body, 1e-3 * least_side(*body) / step, 5);
    const Course course = run(*trial.scene, 2000, 20);
    finding.what = course.stopped ? course.why : fmt::format("2000 steps of {:.3g} s", step);
    finding.at_most("stopped as unstable", course.stopped, 0);
    finding.at_least("finite", is_finite(*trial.scene), 1);
    finding.at_most("energy over its start", course.most_energy / course.first_energy, 19);
  };
  return one;
}

std::vector<CheckCase> degenerate_cases() {
  std::vector<CheckCase> all;
  for (const Odd& odd : meshes()) all.push_back(odd_case(odd));
  for (const Odd& odd : generated()) all.push_back(odd_case(odd));
  return all;
}

} // namespace

CheckFamily degenerate_family() {
  return {"degenerate", "Without length, area, volume or mass",
          "Elements that are flat, folded or inside out, springs without length, points in one place, masses "
          "of nothing. "
          "Either they are refused by name, or they do no harm.",
          degenerate_cases};
}

} // namespace rend
