// Elementary functions that give identical bits on every processor.
//
// glibc picks versions with or without fused multiply-add by processor, and they differ in the last bit. These
// use additions, multiplications, divisions and square roots alone, which IEEE 754 fixes.
#pragma once

namespace rend {

constexpr double pi = 3.14159265358979323846;

// The angle of (x, y) in (−π, π], to 4.5e-16; 0 for (0, 0), NaN if an argument is not finite.
double arc_tangent(double y, double x);

// Errors below 2e-16 for any number of turns; exact at multiples of 90 degrees.
double sine_of_degrees(double angle);
double cosine_of_degrees(double angle);

} // namespace rend
