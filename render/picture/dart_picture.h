// Draws the generalized map itself: every dart as a dot in its corner, every link between two darts as a bar,
// as in the thesis (3.2): α0 black, α1 red, α2 blue, α3 green. A dart that is αi-free has no bar for αi.
#pragma once

#include "render/draw/frame.h"
#include "sim/body/body.h"

namespace rend {

// With more darts a picture of them is illegible.
constexpr std::size_t most_drawn_darts = 20000;

// Appends the triangles to `out`. CHECK: at most most_drawn_darts.
void draw_darts(const Body& body, FrameBody& out);

} // namespace rend
