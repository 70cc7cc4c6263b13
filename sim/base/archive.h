// Numbers to bytes and back, both ways by one function, so that what is written is what is read:
//
//   void Sphere::store(Archive& a) { a(centre, velocity); }      // writes, or takes what was written
//
// Arrays of numbers are copied as they lie in memory: a few gigabytes a second, and for machines that store
// numbers alike (all that rend runs on). Marks between parts are met again when reading; what is out of step
// with them was written by another program or of another scene, and is refused before it does harm.
//
// Who reads trusts nothing: bytes may have been made by somebody who means harm. What can be said of a number
// by itself is refused here: a NaN, an infinity where none is expected, a flag that is neither 0 nor 1, a list
// that is longer than the bytes that are left. What hangs on the scene is said by the store() that read it,
// with refuse_unless(): that an index is in range, that a list is as long as what it lies along. A list whose
// length the archive tells is read by list(), with the most that it may be, so that no number alone takes
// memory.
#pragma once

#include "sim/base/id.h"
#include "sim/base/record.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rend {

// What was read is not what was asked for.
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// For those who look at what they have read: throws ArchiveError where it does not hold. `what` is wrong then,
// such as "a link leads to no dart".
inline void refuse_unless(bool holds, const char* what) {
  if (!holds) throw ArchiveError(what);
}

// A number of things, as far as a double counts them: no sum of two of them is too large for its type.
inline bool is_count(long value) {
  return value >= 0 && value <= (1L << 53);
}

// Types whose bytes are their value, without padding.
template <class T> struct IsPlain : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T>> {};
template <class Tag> struct IsPlain<Id<Tag>> : std::true_type {};
template <> struct IsPlain<Record> : std::true_type {};
template <> struct IsPlain<Vec3> : std::true_type {};
template <class T, std::size_t N> struct IsPlain<std::array<T, N>> : IsPlain<T> {};
template <class T>
concept Plain = IsPlain<T>::value && !std::is_same_v<T, bool>;

// Of them, those that are made of doubles or floats.
template <class T> struct IsReal : std::is_floating_point<T> {};
template <> struct IsReal<Record> : std::true_type {};
template <> struct IsReal<Vec3> : std::true_type {};
template <class T, std::size_t N> struct IsReal<std::array<T, N>> : IsReal<T> {};

// Throw ArchiveError where one is NaN or infinite, or a record's fourth number is not 0.
void refuse_unless_finite(std::span<const double> numbers);
void refuse_unless_finite(std::span<const float> numbers);
void refuse_unless_finite(std::span<const Record> records);

class Archive {
public:
  using Sink = std::function<void(std::span<const std::uint8_t>)>;
  using Source =
      std::function<std::span<const std::uint8_t>()>; // the next piece, which stays until the call after
  static constexpr std::size_t piece = std::size_t{1} << 20U; // [bytes]

  Archive() = default;                                    // writes into bytes()
  explicit Archive(Sink sink) : sink_(std::move(sink)) {} // writes pieces of this size, the last by end()
  explicit Archive(std::span<const std::uint8_t> from) : from_(from) {} // reads; `from` must stay
  // Reads so many bytes, piece after piece.
  Archive(Source source, std::size_t size)
      : from_(std::span<const std::uint8_t>()), source_(std::move(source)), beyond_(size) {}

  bool reading() const { return from_.has_value(); }
  std::vector<std::uint8_t>& bytes() { return bytes_; } // that were written

  // Writes them, or reads into them. Throws ArchiveError where there is too little to read, or a number that
  // never was written: doubles are finite.
  template <class... T> void operator()(T&... each) { (one(each), ...); }

  // The same of doubles that may be infinite.
  template <class... T> void unbounded(T&... each) { (one_unbounded(each), ...); }

  // The same of a list of at most so many elements. Throws ArchiveError where more are said to be there, before
  // there is room for them.
  template <class T> void list(std::vector<T>& elements, std::size_t most, const char* what) {
    const std::size_t number = count(elements.size(), Plain<T> ? sizeof(T) : 1);
    if (reading()) refuse_unless(number <= most, what);
    take(elements, number);
  }

  // The same of a table, by increasing key.
  template <class K, class V> void table(std::map<K, V>& all, std::size_t most, const char* what) {
    std::vector<K> keys;
    std::vector<V> values;
    for (const auto& [key, value] : all) {
      keys.push_back(key);
      values.push_back(value);
    }
    list(keys, most, what);
    list(values, most, what);
    if (!reading()) return;
    refuse_unless(keys.size() == values.size(), what);
    all.clear();
    for (std::size_t n = 0; n < keys.size(); ++n) refuse_unless(all.emplace(keys[n], values[n]).second, what);
  }

  // The same of a list that is as long here as there: throws ArchiveError where it is not.
  template <class T> void fixed(std::vector<T>& elements, const char* what) {
    same(elements.size(), what);
    if constexpr (Plain<T>) {
      take(elements, elements.size());
    } else {
      for (T& each : elements) one(each);
    }
  }

  void mark(std::string_view name);                 // throws ArchiveError where another stands there
  void same(std::uint64_t value, const char* what); // a number that is the same in both: throws where it is not
  void raw(void* data, std::size_t bytes);
  void end(); // nothing more comes; reading: throws ArchiveError where something is left

private:
  template <class T> void one(T& value) {
    if constexpr (Plain<T>) {
      raw(&value, sizeof value);
      look(std::span(&value, 1));
    } else {
      value.store(*this);
    }
  }
  // At what was read.
  template <class T> void look(std::span<T> list) const {
    if constexpr (IsReal<T>::value) {
      if (!reading()) return;
      if constexpr (std::is_same_v<T, Record> || std::is_floating_point_v<T>)
        refuse_unless_finite(std::span<const T>(list));
      else
        for (const T& each : list) look(std::span(each.data(), static_cast<std::size_t>(each.size())));
    }
  }
  void one_unbounded(double& value);
  void one_unbounded(std::optional<double>& value);
  std::size_t left() const { return from_->size() + beyond_; } // [bytes], to be read
  void write(const std::uint8_t* from, std::size_t bytes);
  void one(bool& value);
  void one(std::string& value);

  template <class T> void one(std::vector<T>& list) {
    take(list, count(list.size(), Plain<T> ? sizeof(T) : 1));
  }
  // What is no plain number may take more room in memory than bytes here: it is made as it is read.
  template <class T> void take(std::vector<T>& list, std::size_t number) {
    if constexpr (Plain<T>) {
      list.resize(number);
      raw(list.data(), list.size() * sizeof(T));
      look(std::span(list));
    } else {
      if (reading()) list.clear();
      for (std::size_t n = 0; n < number; ++n) one(reading() ? list.emplace_back() : list[n]);
    }
  }
  template <class T> void one(std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (reading()) there ? void(value.emplace()) : value.reset();
    if (there) one(*value);
  }
  // Of a list with so many elements of at least so many bytes each.
  std::size_t count(std::size_t present, std::size_t bytes_each);

  std::optional<std::span<const std::uint8_t>> from_; // what is left of the piece that is read; none: it writes
  Source source_;
  std::size_t beyond_ = 0;          // [bytes], of the pieces to come
  std::vector<std::uint8_t> bytes_; // with a sink: what it has not taken yet
  Sink sink_;
};

} // namespace rend
