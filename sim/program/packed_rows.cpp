#include "sim/program/packed_rows.h"

#include <algorithm>
#include <cstring>

namespace rend {

PackedRows::PackedRows(int indices, int places, int values)
    : places_(places), index_(static_cast<std::size_t>(indices)), columns_(static_cast<std::size_t>(values)) {}

void PackedRows::resize(std::size_t keys) {
  if (keys <= keys_) return;
  keys_ = keys;
  const std::size_t blocks = (keys + block_size - 1) / block_size;
  mask_.resize(blocks, 0);
  range_.resize(blocks);
  for (auto& column : index_) column.resize(blocks * block_size, 0);
  value_.resize(blocks * block_size * columns_, 0);
}

void PackedRows::reserve(std::size_t keys) {
  const std::size_t blocks = (keys + block_size - 1) / block_size;
  mask_.reserve(blocks);
  range_.reserve(blocks);
  for (auto& column : index_) column.reserve(blocks * block_size);
  value_.reserve(blocks * block_size * columns_);
}

std::size_t PackedRows::live_count() const {
  std::size_t count = 0;
  for (std::uint64_t mask : mask_) count += std::popcount(mask);
  return count;
}

void PackedRows::copy_values(std::size_t from, std::size_t to) {
  const double* source = value_.data() + place(from, 0);
  double* target = value_.data() + place(to, 0);
  for (std::size_t c = 0; c < columns_; ++c) target[c * lanes] = source[c * lanes];
}

// Moves rows [from, end) by one place.
void PackedRows::shift(std::size_t from, std::size_t end, int by) {
  if (from >= end) return;
  for (auto& column : index_)
    std::memmove(column.data() + from + by, column.data() + from, (end - from) * sizeof(std::uint32_t));
  if (by > 0)
    for (std::size_t at = end; at-- > from;) copy_values(at, at + 1);
  else
    for (std::size_t at = from; at < end; ++at) copy_values(at, at - 1);
}

void PackedRows::touch(std::size_t block) {
  if (dirty_.empty() || dirty_.back() != block) dirty_.push_back(block);
}

void PackedRows::set(std::size_t key, const std::uint32_t* index, const double* value) {
  const std::size_t block = key / block_size, at = row(key);
  if (!live(key)) {
    shift(at, block * block_size + rows_in(block), 1);
    mask_[block] |= std::uint64_t{1} << scattered(key % block_size);
  }
  for (std::size_t c = 0; c < index_.size(); ++c) index_[c][at] = index[c];
  double* to = value_.data() + place(at, 0);
  for (std::size_t c = 0; c < columns_; ++c) to[c * lanes] = value[c];
  touch(block);
}

void PackedRows::erase(std::size_t key) {
  if (!live(key)) return;
  const std::size_t block = key / block_size, at = row(key);
  shift(at + 1, block * block_size + rows_in(block), -1);
  mask_[block] &= ~(std::uint64_t{1} << scattered(key % block_size));
  touch(block);
}

void PackedRows::seal() {
  for (std::size_t block : dirty_) {
    const std::size_t begin = block * block_size, count = rows_in(block);
    Range range;
    for (std::size_t at = begin; at < begin + count; ++at) {
      for (int c = 0; c < places_; ++c) {
        range.low = std::min(range.low, index_[static_cast<std::size_t>(c)][at]);
        range.high = std::max(range.high, index_[static_cast<std::size_t>(c)][at]);
      }
    }
    range_[block] = range;
    for (std::size_t at = begin + count; at < begin + block_size; ++at) { // gaps too: rows are a pure function
      const bool padding = at < begin + padded_in(block);
      for (auto& column : index_) column[at] = padding ? column[begin + count - 1] : 0;
      for (std::size_t c = 0; c < columns_; ++c) value_[place(at, static_cast<int>(c))] = 0;
    }
  }
  dirty_.clear();
}

std::size_t PackedRows::bytes() const {
  std::size_t total = mask_.size() * sizeof(std::uint64_t) + range_.size() * sizeof(Range);
  for (const auto& column : index_) total += column.size() * sizeof(std::uint32_t);
  return total + value_.size() * sizeof(double);
}

} // namespace rend
