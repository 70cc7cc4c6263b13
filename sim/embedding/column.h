// Embeddings: a value on every orbit of one kind, and how it follows changes of the orbit.
//
// An embedding is a small type that declares its orbit and its policies; no operator ever updates one by hand.
//
//   struct CornerMass {
//     using Value = double;                                 // [kg]
//     std::string name = "corner mass";
//     Orbit orbit = VertexOfFace;                  // the orbit that carries the value
//     Orbit support = FaceOfVolume;                // the orbit whose shape it depends on
//     Value birth(const EmbeddedMap&, Dart) const; // a new orbit, or one whose support changed its links
//     Value split(const Value& whole) const;       // of a new fragment; the kept slot keeps its value
//     Value merge(const Value& kept, const Value& absorbed) const; // if absent, birth() is called instead
//   };
//
// `support` must contain the orbit: when any link of the support orbit changes, all values on its darts are
// initialised again by birth(). A separation (α2 of a sheet, α3 of a solid) changes no element, so that a value
// with support <0,1> (<0,1,2>) is not affected by it. support = SingleDart, which has no links: only splits and
// merges of the orbit itself count, whatever its shape becomes.
#pragma once

#include "sim/base/record.h"
#include "sim/embedding/cell_index.h"

#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rend {

class EmbeddedMap;

class ColumnBase {
public:
  virtual ~ColumnBase() = default;
  virtual const std::string& name() const = 0;
  virtual Orbit orbit() const = 0;
  virtual Orbit support() const = 0;
  virtual std::size_t bytes() const = 0;

  // For EmbeddedMap only.
  virtual std::span<std::byte> raw() = 0; // the bytes of the values, one value per slot
  virtual void resize(std::size_t slots) = 0;
  virtual void reserve(std::size_t slots) = 0;
  virtual void apply(const EmbeddedMap& map, const CellIndex& cells, const SlotEvents& events) = 0;
  virtual void initialise(const EmbeddedMap& map, const CellIndex& cells, Slot slot) = 0;
  // slot s takes the value of from[s]; resizes to from.size()
  virtual void gather(std::span<const Slot> from) = 0;
};

template <class E> class Column final : public ColumnBase {
public:
  using Value = typename E::Value;

  explicit Column(E embedding) : embedding_(std::move(embedding)) {}

  const E& embedding() const { return embedding_; }
  const std::string& name() const override { return embedding_.name; }
  Orbit orbit() const override { return embedding_.orbit; }
  Orbit support() const override { return embedding_.support; }
  std::size_t bytes() const override { return values_.size() * sizeof(Value); }

  // One value per slot of the orbit; those of free slots are unspecified.
  Value& operator[](Slot slot) { return values_[slot]; }
  const Value& operator[](Slot slot) const { return values_[slot]; }
  std::vector<Value>& values() { return values_; }
  const std::vector<Value>& values() const { return values_; }

  // So every column can be stored without code of its own.
  static_assert(std::is_trivially_copyable_v<Value>, "a value is stored as it lies in memory");
  std::span<std::byte> raw() override { return std::as_writable_bytes(std::span(values_)); }
  void resize(std::size_t slots) override { values_.resize(slots); }
  void reserve(std::size_t slots) override { values_.reserve(slots); }

  void apply(const EmbeddedMap& map, const CellIndex& cells, const SlotEvents& events) override {
    resize(cells.slots());
    for (auto [whole, fragment] : events.splits) values_[fragment] = embedding_.split(values_[whole]);
    for (auto [kept, absorbed] : events.merges) {
      if constexpr (requires { embedding_.merge(values_[kept], values_[absorbed]); })
        values_[kept] = embedding_.merge(values_[kept], values_[absorbed]);
      else
        initialise(map, cells, kept);
    }
    for (Slot slot : events.deaths) values_[slot] = Value{};
    for (Slot slot : events.births) initialise(map, cells, slot);
  }

  void initialise(const EmbeddedMap& map, const CellIndex& cells, Slot slot) override {
    values_[slot] = embedding_.birth(map, cells.first_dart(slot));
  }

  void gather(std::span<const Slot> from) override {
    const std::vector<Value> was = values_;
    values_.resize(from.size());
    for (std::size_t s = 0; s < from.size(); ++s) values_[s] = was[from[s]];
  }

private:
  E embedding_;
  std::vector<Value> values_; // one per slot
};

} // namespace rend
