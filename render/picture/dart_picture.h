// The map itself: every dart as a dot in its corner, every link between two darts as a rod, as the thesis draws
// them (3.2): α0 black, α1 red, α2 blue, α3 green. A dart that is free in a link has no rod there.
#pragma once

#include "render/draw/frame.h"
#include "sim/body/body.h"

namespace rend {

// Above this many darts a picture of them tells nothing.
constexpr std::size_t most_drawn_darts = 20000;

// Appends the triangles to `out`. CHECK: at most most_drawn_darts.
void draw_darts(const Body& body, FrameBody& out);

} // namespace rend
