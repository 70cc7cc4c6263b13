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

// Of an angle in radians, of any size: errors below one unit in the last place, of the tangent below three. NaN
// for an infinite one.
double sine(double x);
double cosine(double x);
double tangent(double x);

// e^x, ln x and x^y: errors below one unit in the last place. Exact where the result is a number of 53 bits.
// Limits as in C: infinite above the largest number, 0 below the smallest, ln 0 = −∞, NaN for ln of a negative
// number and for a negative x to a y that is not whole, x^0 = 1.
double exponential(double x);
double logarithm(double x);
double power(double x, double y);

} // namespace rend
