// A small parameter table for tests of what reads and prints tables. <look> is shared by two parents, and two
// different types are called <key>.
#pragma once

#include "sim/base/parameters.h"

namespace rend::small_table {

inline const ElementType look{
    "look", "Colours.", {word("by", {"plain", "stress"}, "what colours show").otherwise("plain")}, {}};
inline const ElementType stretch{"stretch",
                                 "Springs along edges.",
                                 {number("k", "N/m", "stiffness").above(0).is_required(),
                                  number("damping", "N·s/m", "damping").at_least(0).otherwise("0")},
                                 {}};
inline const ElementType springs{"springs",
                                 "Mass-spring interactions.",
                                 {flag("cumulated", "whether forces are summed").otherwise("no")},
                                 {{&stretch}}};
inline const ElementType sheet{"sheet",
                               "A rectangle of cells.",
                               {integers("cells", 2, "cells each way").at_least(1).is_required(),
                                numbers("size", 2, "m", "size").above(0).otherwise("1 1")},
                               {}};
inline const ElementType tear{
    "tear",
    "What tears.",
    {text("name", "a name"), number("threshold", "N", "where it tears").is_required()},
    {}};
inline const ElementType body{
    "body", "A body.", {text("name", "its name")}, {{&sheet, 1, 1}, {&springs}, {&tear, 0, -1}, {&look}}};
inline const ElementType time{"time",
                              "How time goes on.",
                              {number_or("step", {"auto"}, "s", "time step").above(0).otherwise("auto"),
                               word("integrator", {"verlet", "rk4"}, "scheme").otherwise("verlet")},
                              {}};
inline const ElementType hud{"hud",
                             "Text over the picture.",
                             {words_of("show", {"none", "title", "time"}, "what to show").otherwise("none")},
                             {}};
inline const ElementType camera_key{
    "key", "A turn of the camera.", {number("at", "s", "when").is_required()}, {}};
inline const ElementType camera{
    "camera", "Who looks.", {numbers("eye", 3, "m", "where from").otherwise("0 -3 1")}, {{&camera_key, 0, -1}}};
inline const ElementType map_key{"key", "The legend.", {text("title", "its title & <more>").otherwise("")}, {}};
inline const ElementType map{"map", "A map.", {}, {{&map_key}, {&look, 1, 1}}};
inline const ElementType scene{
    "scene",
    "All of a scene.",
    {text("name", "its name").is_required(), word("version", {"1"}, "of the format").otherwise("1")},
    {{&body, 1, -1}, {&time}, {&hud}, {&camera}, {&map}}};

// A valid preset, over several lines.
inline constexpr const char* preset = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- A preset of the small table. -->
<scene name="small" version="1">
  <body name="left">
    <sheet cells="4 4"
           size="1 2"/>
    <springs cumulated="yes"><stretch k="60"/></springs>
    <tear name="rim" threshold="0.5"/>
    <tear threshold="1.5"/>
    <look by="stress"/>
  </body>
  <body name="right"><sheet cells="2 2"/></body>
  <time step="1e-3" integrator="rk4"/>
  <camera eye="0 0 1"><key at="1"/><key at="2"/></camera>
  <map><key title="Legend"/><look/></map>
</scene>
)";

} // namespace rend::small_table
