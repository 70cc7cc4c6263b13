#include "sim/integrate/secants.h"

#include "sim/base/bytes.h"

#include <algorithm>

namespace rend {

void Secants::reserve(std::size_t vertices) {
  right_.reserve(vertices);
  for (Secant& one : secants_) {
    one.update.reserve(vertices);
    one.change.reserve(vertices);
  }
}

Secants::Secant& Secants::at(std::size_t age) {
  return secants_[(last_ + most - age) % most];
}

void Secants::note(const Records& v, const Records& moved, const Records& residual,
                   const Records& residual_there) {
  Secant& next = secants_[(last_ + 1) % most];
  next.update = moved;
  add_scaled(1, -1, v, next.update);
  next.change = residual;
  add_scaled(1, -1, residual_there, next.change);
  next.product = dot(1, next.update, next.change);
  if (!(next.product > 0)) {
    if (count_ == most) --count_; // its place was the oldest one's
    return;
  }
  last_ = (last_ + 1) % most;
  count_ = std::min(count_ + 1, most);
}

const Records& Secants::right_side(const Records& residual) {
  right_ = residual;
  for (std::size_t age = 0; age < count_; ++age) {
    Secant& one = at(age);
    one.share = dot(1, one.update, right_) / one.product;
    add_scaled(1, -one.share, one.change, right_);
  }
  return right_;
}

void Secants::complete(Records& update) {
  for (std::size_t age = count_; age-- > 0;) {
    const Secant& one = at(age);
    add_scaled(1, one.share - dot(1, one.change, update) / one.product, one.update, update);
  }
}

std::size_t Secants::bytes() const {
  std::size_t sum = bytes_of(right_);
  for (const Secant& one : secants_) sum += bytes_of(one.update) + bytes_of(one.change);
  return sum;
}

} // namespace rend
