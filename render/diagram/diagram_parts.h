// What drawings of rules and of scripts share: the heading, and small maps in a row.
#pragma once

#include "render/diagram/drawing.h"
#include "sim/embedding/embedded_map.h"

#include <string>
#include <vector>

namespace rend::diagram {

constexpr double map_side = 230; // the width of a small map [pixels]
inline constexpr Ink text_ink{0x222222}, faint{0x666666};

// The name, and what it is about, on as many lines as that needs. Returns where it ends.
double add_heading(Drawing& page, const std::string& name, const std::string& about);
double width_of_heading(const std::string& name);

// Drawings from left to right with arrows between them, in the middle of the page.
void add_row(Drawing& page, const std::vector<Drawing>& row, double top, double height);
double width_of_row(const std::vector<Drawing>& row);

// Maps in a row, seen alike; `marked`: darts of the first to point out. Returns where they end.
double add_maps(Drawing& page, const std::vector<const EmbeddedMap*>& maps, const std::vector<Dart>& marked,
                double top);
double width_of_maps(std::size_t count);

void add_caption(Drawing& page, const std::string& text, double y);

} // namespace rend::diagram
