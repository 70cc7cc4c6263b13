#include "sim/integrate/load_tangent.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr std::size_t most_directions = 30;
constexpr double most_wanted = 1e-4; // relative to |r|
// relative to the size of the body: balances rounding and truncation errors
constexpr double small_motion = 1.0e-5;

void scale(double s, Records& x) {
  for (Record& r : x) store(r, splat(s) * load(r));
}

} // namespace

void LoadTangent::at(System& system, double time, const Records& position, const Records& velocity,
                     const std::vector<std::uint8_t>& held, const Scales& scales) {
  system_ = &system;
  parts_ = system.load ? system.pattern()->parts : 1;
  time_ = time;
  position_ = &position;
  velocity_ = &velocity;
  held_ = &held;
  scales_ = scales;
  size_ = system.load ? largest_coordinate(position) : 0;
  matrix_ = nullptr;
  shift_ = 0;
}

void LoadTangent::with_forces(const BlockMatrix& matrix, double shift) {
  matrix_ = &matrix;
  shift_ = shift;
  parts_ = system_->pattern()->parts;
  size_ = largest_coordinate(*position_);
}

void LoadTangent::move(double epsilon, const Records& along) {
  moved_ = *position_;
  moved_velocity_ = *velocity_;
  add_scaled(parts_, epsilon * scales_.by_position, along, moved_);
  if (scales_.by_velocity != 0) add_scaled(parts_, epsilon * scales_.by_velocity, along, moved_velocity_);
}

// Forces at moved_.
void LoadTangent::evaluate_forces(Records& out) {
  out.resize(moved_.size());
  if (matrix_)
    system_->forces(time_, moved_.data(), moved_velocity_.data(), out.data());
  else
    system_->update_loads(time_, moved_.data(), moved_velocity_.data());
  if (!system_->load) return;
  if (matrix_)
    for (std::size_t i = 0; i < out.size(); ++i) store(out[i], load(out[i]) + load(system_->load[i]));
  else
    std::copy_n(system_->load, out.size(), out.begin());
}

bool LoadTangent::multiply(const Records& along, Records& out) {
  const double most = system_->load || matrix_ ? largest_coordinate(along) : 0;
  if (most == 0 || size_ == 0) return false;
  const double epsilon = small_motion * size_ / (most * scales_.by_position);
  move(epsilon, along);
  evaluate_forces(force_[0]);
  move(-epsilon, along);
  evaluate_forces(force_[1]);
  out.assign(along.size(), Record{});
  if (matrix_) matrix_->multiply(along.data(), out.data());
  const Double4 share = splat(0.5 * scales_.share / epsilon);
  Double4 sum{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool there = system_->inverse_mass[i] != 0;
    const Double4 kept = splat(shift_ == 0 ? 0 : shift_ / system_->inverse_mass[i]) * load(along[i]);
    const Double4 change = share * (load(force_[0][i]) - load(force_[1][i])) + load(out[i]) - kept;
    const Double4 part = there ? free_axes((*held_)[i]) * change : Double4{};
    sum += part * part;
    store(out[i], part);
  }
  return sum3(sum) != 0;
}

// The next basis vector v_{n+1}: v_n − L A⁻¹ v_n, orthogonalised against the previous ones (modified
// Gram-Schmidt). False: the system with A could not be solved.
bool LoadTangent::add_direction(LinearSolver& linear, std::size_t n, double digits) {
  if (n > 0 && !linear.solve(basis_[n], solved_[n], digits)) return false;
  basis_[n + 1].resize(basis_[n].size());
  if (matrix_)
    // the actual product, however accurate the solution
    matrix_->multiply(solved_[n].data(), basis_[n + 1].data());
  else
    basis_[n + 1] = basis_[n];
  if (multiply(solved_[n], image_)) add_scaled(parts_, -1, image_, basis_[n + 1]);
  column_[n].assign(n + 2, 0);
  for (std::size_t k = 0; k <= n; ++k) {
    column_[n][k] = dot(parts_, basis_[k], basis_[n + 1]);
    add_scaled(parts_, -column_[n][k], basis_[k], basis_[n + 1]);
  }
  column_[n][n + 1] = std::sqrt(dot(parts_, basis_[n + 1], basis_[n + 1]));
  if (column_[n][n + 1] > 0) scale(1 / column_[n][n + 1], basis_[n + 1]);
  return true;
}

// Makes column n triangular, by the previous rotations and a new one; returns the residual norm relative to
// |r|.
double LoadTangent::rotate(std::size_t n) {
  std::vector<double>& h = column_[n];
  for (std::size_t k = 0; k < n; ++k) {
    const double upper = cosine_[k] * h[k] + sine_[k] * h[k + 1];
    h[k + 1] = cosine_[k] * h[k + 1] - sine_[k] * h[k];
    h[k] = upper;
  }
  const double length = std::sqrt(h[n] * h[n] + h[n + 1] * h[n + 1]);
  cosine_[n] = length > 0 ? h[n] / length : 1;
  sine_[n] = length > 0 ? h[n + 1] / length : 0;
  h[n] = length;
  rest_[n + 1] = -sine_[n] * rest_[n];
  rest_[n] *= cosine_[n];
  return std::abs(rest_[n + 1]);
}

void LoadTangent::combine(std::size_t count, Records& update) {
  std::vector<double>& part = share_;
  part.assign(count, 0);
  for (std::size_t k = count; k-- > 0;) {
    double sum = rest_[k];
    for (std::size_t n = k + 1; n < count; ++n) sum -= column_[n][k] * part[n];
    part[k] = column_[k][k] > 0 ? sum / column_[k][k] : 0;
  }
  update.assign(update.size(), Record{});
  for (std::size_t k = 0; k < count; ++k) add_scaled(parts_, part[k], solved_[k], update);
}

bool LoadTangent::solve(LinearSolver& linear, const Records& right, Records& update, double digits) {
  if (!linear.solve(right, update, digits)) return false;
  const double whole = std::sqrt(dot(parts_, right, right)), wanted = std::max(digits, most_wanted);
  const bool matters =
      whole > 0 && multiply(update, image_) && std::sqrt(dot(parts_, image_, image_)) > wanted * whole;
  if (!matrix_) counted_ = matters;
  if (!matters) return true;
  basis_.resize(most_directions + 1);
  solved_.resize(most_directions);
  column_.resize(most_directions);
  for (auto* each : {&cosine_, &sine_, &rest_}) each->assign(most_directions + 1, 0);
  basis_[0] = right;
  solved_[0] = update;
  scale(1 / whole, basis_[0]);
  scale(1 / whole, solved_[0]);
  rest_[0] = whole;
  std::size_t n = 0;
  double left = whole;
  while (n < most_directions && left > wanted * whole) {
    if (!add_direction(linear, n, digits)) return false;
    left = rotate(n++);
  }
  combine(n, update);
  return true;
}

std::size_t LoadTangent::bytes() const {
  std::size_t sum = bytes_of(moved_) + bytes_of(moved_velocity_) + bytes_of(image_) + bytes_of(force_[0]) +
                    bytes_of(force_[1]);
  for (const Records& one : basis_) sum += bytes_of(one);
  for (const Records& one : solved_) sum += bytes_of(one);
  return sum;
}

} // namespace rend
