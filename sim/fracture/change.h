// Topological changes: what a law does when its criterion exceeds the threshold (thesis 7.3; sim/README.md,
// "Tearing").
//
// Every change of this list but `cut` is composed of one operation, the separation of two elements; rules are
// changes as well (rule_change.h), and a cut divides elements by rules. Embeddings are updated by their own
// policies. To add one: a file with a function `ChangeType my_change()`, and its name in all_changes().
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/fracture/criterion.h"

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

// How often a change was refused, by the reason.
using Refusals = std::map<std::string, std::uint64_t>;

// What a change keeps between its calls, where it is a rule (rule_change.h).
class ChangeMemory {
public:
  virtual ~ChangeMemory() = default;
  virtual void begin(const ForceView& view) = 0; // before the first call of an edit
  // After the calls at all places of one candidate. `otherwise`: why there was none, if there was none.
  virtual void settle_candidate(bool made, const char* otherwise) = 0;
  virtual const Refusals& refusals() const = 0;                // of candidates
  virtual void store(Archive& archive) = 0;                    // the refusals
  virtual void make_anew(const CriterionRequest& request) = 0; // the body has got further interactions
  virtual void rebind(const Changes& changes) = 0;
  virtual void reserve_for_separations() = 0; // see EmbeddedMap
  virtual std::size_t bytes() const = 0;
};

struct ChangeType {
  std::string name, what;
  Cell cell; // on which it acts; it is the default change of the criteria that measure such cells (transfer.h)
  // Applies the change if it is still possible; false: it was not, and nothing changed. Slots and positions are
  // those before the edit, links the current ones. `darts`: those of the cell, without removed ones; the cell
  // may have been split since. The finding's normal is that of the place.
  std::function<bool(Edit&, const ForceView&, const FoundPlace&, std::span<const Dart> darts)> apply;
  bool grows = false;                        // it may create darts and links (rule_change.h)
  bool keeps_matter = false;                 // it only separates: no element is created or removed
  bool has_least_part = false;               // it takes the law's smallest-part
  std::shared_ptr<ChangeMemory> memory = {}; // null: it keeps nothing
  // Gives such a body the embeddings that it needs. Null: it needs none of its own.
  void (*prepare)(EmbeddedMap&) = nullptr;
  // Makes the change of one law of such a body, where it keeps something for each law. Null: it keeps nothing.
  std::function<std::shared_ptr<const ChangeType>(const CriterionRequest&)> of_law = {};
  // Why it can't be made in such a body, a sentence that goes on after its name; empty: it can. Null: always.
  std::function<std::string(const CriterionRequest&)> lacking = {};
};

const std::vector<ChangeType>& all_changes();
const ChangeType* find_change(std::string_view name); // null: there is none

ChangeType separate();
ChangeType delete_element();
ChangeType split_vertex();
ChangeType delete_edge();
ChangeType cut();

// Separates the element of d from all its neighbours and removes it.
void remove_element_of(Edit& edit, Dart d);

} // namespace rend
