// The rate at which the value of a function or an operator changes, where its arguments change: f' = Σ ∂f/∂a_k
// a_k'.
//
// Where there is no derivative, it is that of one side or the mean of both: 0 of abs and norm at 0; of min, max
// and clamp, that of the argument whose value they have. An argument that does not change contributes nothing,
// whatever the derivative: sqrt of a constant 0 has the rate 0. Conditions, floor, step and the seed of noise
// change in jumps, and have the rate 0.
#pragma once

#include "sim/expression/value.h"

namespace rend::rates {

// Operators; of scalars and vectors alike where both are possible.
Value of_sum(const Value* a, const Value* rates, std::size_t);
Value of_difference(const Value* a, const Value* rates, std::size_t);
Value of_opposite(const Value* a, const Value* rates, std::size_t);
Value of_product(const Value* a, const Value* rates, std::size_t); // of scalars
Value of_scalar_times_vector(const Value* a, const Value* rates, std::size_t);
Value of_vector_times_scalar(const Value* a, const Value* rates, std::size_t);
Value of_quotient(const Value* a, const Value* rates, std::size_t);
Value of_power(const Value* a, const Value* rates, std::size_t);

// Functions of one number.
Value of_sine(const Value* a, const Value* rates, std::size_t);
Value of_cosine(const Value* a, const Value* rates, std::size_t);
Value of_tangent(const Value* a, const Value* rates, std::size_t);
Value of_exponential(const Value* a, const Value* rates, std::size_t);
Value of_logarithm(const Value* a, const Value* rates, std::size_t);
Value of_square_root(const Value* a, const Value* rates, std::size_t);
Value of_size(const Value* a, const Value* rates, std::size_t); // abs

Value of_minimum(const Value* a, const Value* rates, std::size_t);
Value of_maximum(const Value* a, const Value* rates, std::size_t);
Value of_clamp(const Value* a, const Value* rates, std::size_t);
Value of_point(const Value* a, const Value* rates, std::size_t);
Value of_dot(const Value* a, const Value* rates, std::size_t);
Value of_cross(const Value* a, const Value* rates, std::size_t);
Value of_norm(const Value* a, const Value* rates, std::size_t);
Value of_noise(const Value* a, const Value* rates, std::size_t count);

template <int axis> Value of_component(const Value*, const Value* rates, std::size_t) {
  return scalar_value(rates->number[axis]);
}

} // namespace rend::rates
