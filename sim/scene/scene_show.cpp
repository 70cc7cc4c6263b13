// States that are shown once it is certain that they are of the run (kept_state.h).
#include "sim/guard/guard.h"
#include "sim/scene/scene.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rend {

bool Scene::is_settled() const {
  return guard_->settled();
}

void Scene::show_when_settled(std::function<void()> show) {
  if (is_settled()) return show();
  kept_.push_back({.step = steps_done_, .show = std::move(show)});
  keep_again();
}

// The current state, where it is to be shown.
void Scene::keep_again() {
  for (KeptState& one : kept_) {
    if (one.step != steps_done_) continue;
    one.state.copy(world_, bodies_);
    one.account = account_;
  }
}

// Not those of later steps, which are being redone.
bool Scene::has_states_to_show() const {
  return !kept_.empty() && kept_.front().step <= steps_done_;
}

void Scene::show_settled() {
  if (!has_states_to_show()) return;
  const auto exchange = [&](KeptState& one) {
    one.state.exchange(world_, bodies_);
    std::swap(one.account, account_);
    std::swap(one.step, steps_done_);
  };
  const auto later =
      std::find_if(kept_.begin(), kept_.end(), [&](const KeptState& one) { return one.step > steps_done_; });
  std::vector<KeptState> all(std::make_move_iterator(kept_.begin()), std::make_move_iterator(later));
  kept_.erase(kept_.begin(), later);
  for (KeptState& one : all) {
    exchange(one);
    one.show();
    exchange(one);
  }
}

void Scene::settle() {
  const long end = steps_done_;
  for (StepFailure failure; (failure = guard_->end_stretch(end)) != StepFailure::None;) {
    redo(failure, end - 1);
    reach(end);
  }
  show_settled();
}

void Scene::return_to_settled() {
  if (kept_.empty()) return;
  kept_.clear();
  return_to(guard_->restore_start());
}

} // namespace rend
