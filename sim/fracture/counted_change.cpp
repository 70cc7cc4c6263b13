#include "sim/fracture/counted_change.h"

#include "sim/base/archive.h"

namespace rend {
namespace {

// Why a change may be refused at a cell that is there.
std::string why_impossible(const ChangeType& change) {
  return change.cell == Cell::Vertices
             ? "all elements at the vertex lie on one side of the plane across the force"
             : "no two elements are connected there";
}

class Counter final : public ChangeMemory {
public:
  explicit Counter(std::string why) : why_(std::move(why)) {}

  bool tried(bool made) {
    tried_ = true;
    return made;
  }

  void begin(const ForceView&) override {}
  void make_anew(const CriterionRequest&) override {}
  void settle_candidate(bool made, const char* otherwise) override {
    if (!made) ++refusals_[tried_ ? why_ : otherwise];
    tried_ = false;
  }
  const Refusals& refusals() const override { return refusals_; }
  void store(Archive& archive) override {
    archive.table(refusals_, 3, "a change was refused for more reasons than there are");
  }
  void rebind(const Changes&) override {}
  void reserve_for_separations() override {}
  std::size_t bytes() const override { return 0; }

private:
  std::string why_;
  bool tried_ = false; // at a place of the current candidate
  Refusals refusals_;
};

} // namespace

std::shared_ptr<const ChangeType> counted(const ChangeType& change) {
  const auto counter = std::make_shared<Counter>(why_impossible(change));
  auto out = std::make_shared<ChangeType>(change);
  out->memory = counter;
  out->apply = [counter, apply = change.apply](Edit& edit, const ForceView& view, const FoundPlace& found,
                                               std::span<const Dart> darts) {
    return counter->tried(apply(edit, view, found, darts));
  };
  return out;
}

} // namespace rend
