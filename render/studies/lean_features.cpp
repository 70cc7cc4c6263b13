#include "render/studies/lean_features.h"

namespace rend {
namespace {

const char* cloth = R"(<scene name="cloth">
  <body name="cloth">
    <sheet cells="48 48" size="1 1"/>
    <mass total="0.1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="40"/><bend kind="provot" k="2"/></springs>
    <fix near="0 0 0"/> <fix near="1 0 0"/>
  </body>
  <world gravity="0 0 -9.81"><floor z="-100"/></world>
  <time step="1e-4" integrator="symplectic" duration="100"/>
  <camera eye="0.5 -2.6 0.3" target="0.5 0.4 -0.3"/>
</scene>)";

const char* bar = R"(<scene name="bar">
  <body name="bar">
    <bar pattern="mixed" cells="12 4 4" size="1.2 0.2 0.2"/>
    <mass density="1000"/>
    <elasticity model="corotational" young="4e5" poisson="0.3"/>
    <fix side="-x"/>
  </body>
  <world gravity="0 0 -9.81"><floor z="-100"/></world>
  <time step="1e-5" integrator="symplectic" duration="100"/>
  <camera eye="0.6 -2.6 0.5" target="0.6 0 0"/>
</scene>)";

LeanFeature element(const std::string& name, const std::string& what, const std::string& text,
                    LeanSame same = LeanSame::State) {
  return {name, what, {}, {text, {}}, same};
}

LeanFeature law(const std::string& criterion, const std::string& more = {}) {
  return element("law " + criterion + (more.empty() ? "" : " " + more),
                 "compares in every step, never exceeded",
                 "<tear criterion=\"" + criterion + "\" " + more + " threshold=\"1e30\"/>", LeanSame::Pixels);
}

// Both sides get `world`, what there is to touch; one of them gets <contact> as well.
LeanFeature contact(const std::string& with, const std::string& name, const std::string& what,
                    const std::string& world) {
  const std::string element = "<contact with=\"" + with + "\" thickness=\"0.0001\"/>";
  return {.name = "contact with " + name,
          .what = what,
          .off = {.element = "", .world_element = world},
          .on = {.element = element, .world_element = world},
          .may_change_other_scenes = true};
}

// At a time step that is stable for either.
LeanFeature scheme(const std::string& name) {
  const Setting step{"time.step", "1e-6"};
  return {"scheme " + name,
          "against symplectic: arrays and evaluations",
          {"", {{"time.integrator", "symplectic"}, step}},
          {"", {{"time.integrator", name}, step}},
          LeanSame::Free};
}

std::vector<LeanFeature> all_features() {
  const std::string never = "<tear criterion=\"global-border\" threshold=\"1e30\"/>";
  const LeanSide births{.element = never, .count_fragments = true}, walks{.walk = true}, bare{.bare = true};
  return {
      {"all that is not asked for",
       "the loop of every scene, with its checks, against one that knows nothing but forces",
       bare,
       {}},
      {"nothing", "twice the same, for comparison", {}, {}},
      law("global-border"),
      law("atomic-border"),
      law("atomic-vertex"),
      law("cumulative-vertex"),
      law("atomic-spring", "kind=\"stretch\""),
      law("strain"),
      law("atomic-element"),
      law("vertex-stress"),
      {"births", "fragments told at each change, of which there is none", {never, {}}, births},
      element("viscosity 0 per particle", "an element that asks for nothing",
              R"(<viscosity value="0" per="particle"/>)"),
      {"viscosity per particle",
       "against none: an array of rates",
       {},
       {R"(<viscosity value="1e-3" per="particle"/>)", {}},
       LeanSame::Free},
      contact("floor", "the floor", "which is out of reach", ""),
      contact("obstacles", "obstacles", "which are out of reach", R"(<sphere centre="0 0 -90" radius="1"/>)"),
      contact("fragments", "fragments", "of which there is one", ""),
      contact("self", "itself", "faces that do not meet", ""),
      {"wind",
       "of no drag, over all faces",
       {},
       {"", {{"world.wind.velocity", "1 0 0"}, {"world.wind.drag", "0"}}}},
      element("load of no force", "constant: summed up once", R"(<load all="yes" force="0 0 0"/>)"),
      element("probe", "read when it is asked for", R"(<probe name="lean" all="yes"/>)"),
      {.name = "a row for each spring",
       .what = "against parallel ones folded into one (cumulated)",
       .off = {},
       .on = {.settings = {{"body.springs.cumulated", "no"}}},
       .same = LeanSame::Pixels,
       .needs = "springs"},
      {"walking the map", "--kernels walk against flat arrays", {}, walks, LeanSame::Pixels},
      scheme("explicit"),
      scheme("verlet"),
      scheme("midpoint"),
      scheme("rk4"),
      scheme("implicit"),
  };
}

} // namespace

const std::vector<LeanFeature>& lean_features() {
  static const std::vector<LeanFeature> all = all_features();
  return all;
}

const std::vector<LeanScene>& lean_scenes() {
  static const std::vector<LeanScene> all{{"cloth", cloth, ""}, {"bar", bar, ""}};
  return all;
}

} // namespace rend
