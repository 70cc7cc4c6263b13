// Elementary functions that give the same bits on every processor.
//
// glibc picks versions with or without fused multiply-add by processor, and they differ in the last bit. These use
// additions, multiplications, divisions and square roots alone, which IEEE 754 fixes.
#pragma once

namespace rend {

constexpr double pi = 3.14159265358979323846;

double arc_tangent(double y, double x); // the angle of (x, y) in (−π, π]; 0 for (0, 0), NaN where one is not finite; to 4.5e-16
double sine_of_degrees(double angle);   // to 2e-16 however many turns, exact at multiples of 90
double cosine_of_degrees(double angle);

} // namespace rend
