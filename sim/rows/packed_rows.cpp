#include "sim/rows/packed_rows.h"

#include "sim/base/bytes.h"

#include <algorithm>
#include <cstring>

namespace rend {

PackedRows::PackedRows(int indices, int places, int values, int unused)
    : places_(places), unused_(unused), index_(static_cast<std::size_t>(indices)),
      columns_(static_cast<std::size_t>(unused >= 0 ? values - 1 : values)) {}

void PackedRows::clear() {
  keys_ = end_ = 0;
  mask_.clear();
  begin_.clear();
  room_.clear();
  range_.clear();
  for (auto& column : index_) column.clear();
  value_.clear();
  dirty_.clear();
}

void PackedRows::resize(std::size_t keys) {
  if (keys <= keys_) return;
  keys_ = keys;
  const std::size_t blocks = (keys + block_size - 1) / block_size;
  mask_.resize(blocks, 0);
  begin_.resize(blocks, 0);
  room_.resize(blocks, 0);
  range_.resize(blocks);
}

// Each block may move once.
void PackedRows::reserve(std::size_t keys) {
  const std::size_t blocks = (keys + block_size - 1) / block_size, rows = end_ + blocks * block_size;
  mask_.reserve(blocks);
  begin_.reserve(blocks);
  room_.reserve(blocks);
  range_.reserve(blocks);
  for (auto& column : index_) column.reserve(rows);
  value_.reserve(rows * columns_);
}

void PackedRows::trim() {
  for (auto& column : index_) column.shrink_to_fit();
  value_.shrink_to_fit();
  dirty_.shrink_to_fit();
}

void PackedRows::lengthen(std::size_t rows) {
  end_ += rows;
  for (auto& column : index_) column.resize(end_, 0);
  value_.resize(end_ * columns_, 0);
}

// Makes room for one more row.
void PackedRows::make_room(std::size_t block) {
  const std::size_t count = rows_in(block), room = room_[block], from = begin_[block];
  if (count < room) return;
  if (room == 0 || from + room == end_) { // the last block grows in place
    if (room == 0) begin_[block] = end_;
    lengthen(lanes);
    room_[block] = static_cast<std::uint8_t>(room + lanes);
    return;
  }
  const std::size_t to = end_;
  lengthen(block_size);
  for (auto& column : index_) std::copy_n(column.begin() + from, count, column.begin() + to);
  // whole groups of four rows
  std::copy_n(value_.begin() + place(from, 0), count * columns_, value_.begin() + place(to, 0));
  begin_[block] = to;
  room_[block] = block_size;
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

// Moves rows [from, end) by `by` rows.
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
  const std::size_t block = key / block_size;
  if (!live(key)) make_room(block);
  const std::size_t at = row(key);
  if (!live(key)) {
    shift(at, begin_[block] + rows_in(block), 1);
    mask_[block] |= std::uint64_t{1} << scattered(key % block_size);
  }
  for (std::size_t c = 0; c < index_.size(); ++c) index_[c][at] = index[c];
  double* to = value_.data() + place(at, 0);
  for (int c = 0; c < static_cast<int>(columns_); ++c)
    to[static_cast<std::size_t>(c) * lanes] = value[unused_ >= 0 && c >= unused_ ? c + 1 : c];
  touch(block);
}

void PackedRows::erase(std::size_t key) {
  if (!live(key)) return;
  const std::size_t block = key / block_size, at = row(key);
  shift(at + 1, begin_[block] + rows_in(block), -1);
  mask_[block] &= ~(std::uint64_t{1} << scattered(key % block_size));
  touch(block);
}

void PackedRows::seal() {
  for (std::size_t block : dirty_) {
    const std::size_t begin = begin_[block], count = rows_in(block);
    Range range;
    for (std::size_t at = begin; at < begin + count; ++at) {
      for (int c = 0; c < places_; ++c) {
        range.low = std::min(range.low, index_[static_cast<std::size_t>(c)][at]);
        range.high = std::max(range.high, index_[static_cast<std::size_t>(c)][at]);
      }
    }
    range_[block] = range;
    for (std::size_t at = begin + count; at < begin + room_[block]; ++at) {
      const bool padding = at < begin + padded_in(block);
      for (auto& column : index_) column[at] = padding ? column[begin + count - 1] : 0;
      for (std::size_t c = 0; c < columns_; ++c) value_[place(at, static_cast<int>(c))] = 0;
    }
  }
  dirty_.clear();
}

std::size_t PackedRows::bytes() const {
  std::size_t total =
      bytes_of(mask_) + bytes_of(begin_) + bytes_of(room_) + bytes_of(range_) + bytes_of(value_);
  for (const auto& column : index_) total += bytes_of(column);
  return total;
}

bool PackedRows::same_as(const PackedRows& other) const {
  if (keys_ != other.keys_ || mask_ != other.mask_ || range_ != other.range_ || columns_ != other.columns_ ||
      index_.size() != other.index_.size())
    return false;
  for (std::size_t block = 0; block < blocks(); ++block) {
    const std::size_t count = padded_in(block), from = begin_[block], there = other.begin_[block];
    for (std::size_t c = 0; c < index_.size(); ++c)
      if (!std::equal(index_[c].begin() + from, index_[c].begin() + from + count,
                      other.index_[c].begin() + there))
        return false;
    if (!std::equal(value_.begin() + place(from, 0), value_.begin() + place(from, 0) + count * columns_,
                    other.value_.begin() + place(there, 0)))
      return false;
  }
  return true;
}

} // namespace rend
