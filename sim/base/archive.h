// Numbers to bytes and back, both ways by one function, so that what is written is what is read:
//
//   void Sphere::store(Archive& a) { a(centre, velocity); }      // writes, or takes what was written
//
// Arrays of numbers are copied as they lie in memory: a few gigabytes a second, and for machines that store
// numbers alike (all that rend runs on). Marks between parts are met again when reading; what is out of step
// with them was written by another program or of another scene, and is refused before it does harm.
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

// Types whose bytes are their value, without padding.
template <class T> struct IsPlain : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T>> {};
template <class Tag> struct IsPlain<Id<Tag>> : std::true_type {};
template <> struct IsPlain<Record> : std::true_type {};
template <> struct IsPlain<Vec3> : std::true_type {};
template <class T, std::size_t N> struct IsPlain<std::array<T, N>> : IsPlain<T> {};
template <class T>
concept Plain = IsPlain<T>::value && !std::is_same_v<T, bool>;

class Archive {
public:
  using Sink = std::function<void(std::span<const std::uint8_t>)>;
  static constexpr std::size_t piece = std::size_t{1} << 20U; // [bytes]

  Archive() = default;                                    // writes into bytes()
  explicit Archive(Sink sink) : sink_(std::move(sink)) {} // writes pieces of this size, the last by end()
  explicit Archive(std::span<const std::uint8_t> from) : from_(from) {} // reads; `from` must stay

  bool reading() const { return from_.has_value(); }
  std::vector<std::uint8_t>& bytes() { return bytes_; } // that were written

  // Writes them, or reads into them. Throws ArchiveError where there is too little to read.
  template <class... T> void operator()(T&... each) { (one(each), ...); }

  void mark(std::string_view name);                 // throws ArchiveError where another stands there
  void same(std::uint64_t value, const char* what); // a number that is the same in both: throws where it is not
  void raw(void* data, std::size_t bytes);
  void end(); // nothing more comes; reading: throws ArchiveError where something is left

private:
  template <class T> void one(T& value) {
    if constexpr (Plain<T>)
      raw(&value, sizeof value);
    else
      value.store(*this);
  }
  void write(const std::uint8_t* from, std::size_t bytes);
  void one(bool& value);
  void one(std::string& value);

  template <class T> void one(std::vector<T>& list) {
    list.resize(count(list.size(), Plain<T> ? sizeof(T) : 1));
    if constexpr (Plain<T>)
      raw(list.data(), list.size() * sizeof(T));
    else
      for (T& each : list) one(each);
  }
  template <class T> void one(std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (reading()) there ? void(value.emplace()) : value.reset();
    if (there) one(*value);
  }
  template <class K, class V> void one(std::map<K, V>& all) {
    std::vector<K> keys;
    std::vector<V> values;
    for (const auto& [key, value] : all) {
      keys.push_back(key);
      values.push_back(value);
    }
    (*this)(keys, values);
    if (!reading()) return;
    all.clear();
    for (std::size_t n = 0; n < keys.size() && n < values.size(); ++n) all.emplace(keys[n], values[n]);
  }

  // Of a list with so many elements of at least so many bytes each.
  std::size_t count(std::size_t present, std::size_t bytes_each);

  std::optional<std::span<const std::uint8_t>> from_; // what is left to be read; none: it writes
  std::vector<std::uint8_t> bytes_;                   // with a sink: what it has not taken yet
  Sink sink_;
};

} // namespace rend
