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
//
// An embedding may inherit, where an edit says what its new darts come from (Edit::inherit):
//
//     Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const;
//     static constexpr Inheritance inheritance = Inheritance::Share;   // if absent: Mean
//     static constexpr bool carries_momentum = true;                   // of masses alone
//
// It then takes the place of birth() and, for the parts of a split orbit, of split(), in edits that recorded
// parents, wherever parents are found: how, and what their weights mean, is told in inheritance.h. The dart is
// the smallest of the orbit; the map is as after the edit, with slots and rest positions; the values are those
// from before. Without parents, and in all other edits, there is birth().
#pragma once

#include "sim/base/record.h"
#include "sim/embedding/cell_index.h"
#include "sim/embedding/inheritance.h"

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rend {

class EmbeddedMap;

// An orbit from before the edit, of which another one is a heir.
template <class Value> struct Inherited {
  Value value;
  double weight;
  Dart dart; // the smallest that it had
};

// Σ weight · value
inline double sum_of(std::span<const Inherited<double>> parents) {
  double sum = 0;
  for (const Inherited<double>& parent : parents) sum += parent.weight * parent.value;
  return sum;
}

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
  virtual std::optional<Inheritance> inheritance() const = 0; // nullopt: it does not inherit
  virtual std::span<const double> masses() const = 0; // its values, if it carries momentum; otherwise empty
  virtual void note_parents(const Heirs& heirs) = 0;  // while the values are still those from before the edit
  // Splits, merges, deaths, births; but for heirs (null: there are none), which follow by inherit().
  virtual void apply(const EmbeddedMap& map, const CellIndex& cells, const SlotEvents& events,
                     const Heirs* heirs) = 0;
  virtual void inherit(const EmbeddedMap& map, const CellIndex& cells, const Heirs& heirs) = 0;
  virtual void initialise(const EmbeddedMap& map, const CellIndex& cells, Slot slot) = 0;
  // Takes back, to the last byte, all changes since apply() began; or gives up what that needs, which is
  // nothing if there were only splits into slots that are new.
  virtual void rollback() noexcept = 0;
  virtual void commit() noexcept = 0;
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

  static constexpr bool can_inherit =
      requires(const E& e, const EmbeddedMap& map, std::span<const Inherited<Value>> parents) {
    { e.inherit(map, Dart{}, parents) } -> std::convertible_to<Value>;
  };

  std::optional<Inheritance> inheritance() const override {
    if constexpr (!can_inherit)
      return {};
    else if constexpr (requires { embedding_.inheritance; })
      return embedding_.inheritance;
    else
      return Inheritance::Mean;
  }

  std::span<const double> masses() const override {
    if constexpr (requires { E::carries_momentum; }) return values_;
    return {};
  }

  void note_parents(const Heirs& heirs) override {
    old_.clear();
    for (const Slot slot : heirs.old_slots()) old_.push_back(values_[slot]);
  }

  void apply(const EmbeddedMap& map, const CellIndex& cells, const SlotEvents& events,
             const Heirs* heirs) override {
    overwritten_.clear();
    size_before_ = values_.size();
    resize(cells.slots());
    for (auto [whole, fragment] : events.splits) write(fragment, embedding_.split(values_[whole]));
    for (auto [kept, absorbed] : events.merges) {
      if constexpr (requires { embedding_.merge(values_[kept], values_[absorbed]); })
        write(kept, embedding_.merge(values_[kept], values_[absorbed]));
      else
        initialise(map, cells, kept);
    }
    for (Slot slot : events.deaths) write(slot, Value{});
    for (Slot slot : events.births)
      if (!heirs || !heirs->has(slot)) initialise(map, cells, slot);
  }

  void inherit(const EmbeddedMap& map, const CellIndex& cells, const Heirs& heirs) override {
    if constexpr (can_inherit) {
      std::vector<Inherited<Value>> parents;
      heirs.each([&](Slot slot, std::span<const Heirs::Source> sources) {
        if (sources.empty()) return initialise(map, cells, slot);
        parents.clear();
        for (const auto& [cell, weight] : sources)
          parents.push_back({old_[cell], weight, heirs.old_darts()[cell]});
        write(slot,
              embedding_.inherit(map, cells.first_dart(slot), std::span<const Inherited<Value>>(parents)));
      });
    }
  }

  void initialise(const EmbeddedMap& map, const CellIndex& cells, Slot slot) override {
    write(slot, embedding_.birth(map, cells.first_dart(slot)));
  }

  // Replaces a value while an edit is being closed.
  void write(Slot slot, const Value& value) {
    if (slot < size_before_) [[unlikely]]
      keep(slot);
    values_[slot] = value;
  }

  void rollback() noexcept override {
    for (std::size_t n = overwritten_.size(); n-- > 0;) values_[overwritten_[n].first] = overwritten_[n].second;
    values_.resize(size_before_);
    commit();
  }

  void commit() noexcept override {
    if (!overwritten_.empty()) overwritten_ = {};
    if (!old_.empty()) old_ = {};
    size_before_ = 0;
  }

  void gather(std::span<const Slot> from) override {
    const std::vector<Value> was = values_;
    values_.resize(from.size());
    for (std::size_t s = 0; s < from.size(); ++s) values_[s] = was[from[s]];
  }

private:
  [[gnu::noinline]] void keep(Slot slot) { overwritten_.push_back({slot, values_[slot]}); }

  E embedding_;
  std::vector<Value> values_; // one per slot

  // Of the edit that is being closed.
  std::size_t size_before_ = 0; // 0: none is
  std::vector<std::pair<Slot, Value>>
      overwritten_;        // values from before, in the order in which they were replaced
  std::vector<Value> old_; // those from which somebody inherits, as Heirs lists them
};

} // namespace rend
