// Serialisation: one store() function both writes and reads, so the two cannot disagree:
//
//   void Sphere::store(Archive& a) { a(centre, velocity); }      // writes, or reads what was written
//
// Arrays of numbers are copied byte for byte: a few gigabytes a second, and portable between machines with the
// same number formats (all that rend runs on). Named marks between sections are checked when reading; an
// archive written by another program or for another scene fails there and is refused.
//
// A reader trusts nothing: the bytes may be malicious. What can be checked of a value by itself is checked
// here: no NaN, no infinity where none is expected, a flag is 0 or 1, a list is no longer than the bytes that
// are left. What depends on the scene is checked by the store() that read it, with refuse_unless(): an index is
// in range, a list has the length of the array that it belongs to. A list whose length is stored in the archive
// is read by list() with an upper bound, so that no stored number alone can cause a large allocation.
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

// The archive does not hold what was to be read.
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// For checks of values that were read: throws ArchiveError unless `holds`. `what` says what is wrong, such as
// "a link leads to no dart".
inline void refuse_unless(bool holds, const char* what) {
  if (!holds) throw ArchiveError(what);
}

// A count that a double represents exactly; the sum of two such counts does not overflow.
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

// Those of them that consist of doubles or floats.
template <class T> struct IsReal : std::is_floating_point<T> {};
template <> struct IsReal<Record> : std::true_type {};
template <> struct IsReal<Vec3> : std::true_type {};
template <class T, std::size_t N> struct IsReal<std::array<T, N>> : IsReal<T> {};

// Throw ArchiveError if a number is NaN or infinite, or the fourth component of a record is not 0.
void refuse_unless_finite(std::span<const double> numbers);
void refuse_unless_finite(std::span<const float> numbers);
void refuse_unless_finite(std::span<const Record> records);

class Archive {
public:
  using Sink = std::function<void(std::span<const std::uint8_t>)>;
  // returns the next piece, valid until the next call
  using Source = std::function<std::span<const std::uint8_t>()>;
  static constexpr std::size_t piece = std::size_t{1} << 20U; // [bytes]

  Archive() = default; // writes into bytes()
  // writes in pieces of `piece` bytes, the last in end()
  explicit Archive(Sink sink) : sink_(std::move(sink)) {}
  // reads; `from` must outlive the archive
  explicit Archive(std::span<const std::uint8_t> from) : from_(from) {}
  // Reads `size` bytes, piece by piece.
  Archive(Source source, std::size_t size)
      : from_(std::span<const std::uint8_t>()), source_(std::move(source)), beyond_(size) {}

  bool reading() const { return from_.has_value(); }
  std::vector<std::uint8_t>& bytes() { return bytes_; } // what was written

  // Writes the values, or reads into them. Throws ArchiveError if the bytes do not suffice or a double is not
  // finite.
  template <class... T> void operator()(T&... each) { (one(each), ...); }

  // The same for doubles that may be infinite.
  template <class... T> void unbounded(T&... each) { (one_unbounded(each), ...); }

  // The same for a list of at most `most` elements. Throws ArchiveError if the stored length is larger, before
  // memory is allocated.
  template <class T> void list(std::vector<T>& elements, std::size_t most, const char* what) {
    const std::size_t number = count(elements.size(), Plain<T> ? sizeof(T) : 1);
    if (reading()) refuse_unless(number <= most, what);
    take(elements, number);
  }

  // The same for a map, in order of increasing keys.
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

  // The same for a list whose length is already known: throws ArchiveError if the stored length differs.
  template <class T> void fixed(std::vector<T>& elements, const char* what) {
    same(elements.size(), what);
    if constexpr (Plain<T>) {
      take(elements, elements.size());
    } else {
      for (T& each : elements) one(each);
    }
  }

  void mark(std::string_view name);                 // throws ArchiveError if another mark was stored
  void same(std::uint64_t value, const char* what); // throws unless the stored number is `value`
  void raw(void* data, std::size_t bytes);
  void end(); // the end of the archive; reading: throws ArchiveError if bytes are left

private:
  template <class T> void one(T& value) {
    if constexpr (Plain<T>) {
      raw(&value, sizeof value);
      check_finite(std::span(&value, 1));
    } else {
      value.store(*this);
    }
  }
  // Checks numbers that were read.
  template <class T> void check_finite(std::span<T> list) const {
    if constexpr (IsReal<T>::value) {
      if (!reading()) return;
      if constexpr (std::is_same_v<T, Record> || std::is_floating_point_v<T>)
        refuse_unless_finite(std::span<const T>(list));
      else
        for (const T& each : list) check_finite(std::span(each.data(), static_cast<std::size_t>(each.size())));
    }
  }
  void one_unbounded(double& value);
  void one_unbounded(std::optional<double>& value);
  std::size_t left() const { return from_->size() + beyond_; } // [bytes] still to be read
  void write(const std::uint8_t* from, std::size_t bytes);
  void one(bool& value);
  void one(std::string& value);

  template <class T> void one(std::vector<T>& list) {
    take(list, count(list.size(), Plain<T> ? sizeof(T) : 1));
  }
  // Elements that are no plain numbers may need more memory than bytes in the archive: they are created one by
  // one as they are read.
  template <class T> void take(std::vector<T>& list, std::size_t number) {
    if constexpr (Plain<T>) {
      list.resize(number);
      raw(list.data(), list.size() * sizeof(T));
      check_finite(std::span(list));
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
  // Writes or reads the length of a list whose elements have at least `bytes_each` bytes each.
  std::size_t count(std::size_t present, std::size_t bytes_each);

  // the unread rest of the current piece; nullopt: the archive writes
  std::optional<std::span<const std::uint8_t>> from_;
  Source source_;
  std::size_t beyond_ = 0;          // [bytes] of the pieces to come
  std::vector<std::uint8_t> bytes_; // what was written; with a sink: what was not yet passed to it
  Sink sink_;
};

} // namespace rend
