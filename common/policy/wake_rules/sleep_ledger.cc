#include "common/policy/wake_rules/sleep_ledger.h"

#include <algorithm>

namespace talus {

template <int Dim>
typename SleepLedger<Dim>::Count SleepLedger<Dim>::count(const Column& column) const {
  const auto found = counts_.find(column);
  return found == counts_.end() ? Count{} : found->second;
}

template <int Dim>
void SleepLedger<Dim>::Count::add(Standing standing, int one) {
  sleeping += one;
  if (standing != Standing::settled) unchecked += one;
  if (standing == Standing::fresh) fresh = std::max(0, fresh + one);
}

template <int Dim>
bool SleepLedger<Dim>::settled(BodyIndex body) const {
  return body < std::ssize(sleepers_) && sleepers_[body] && sleepers_[body]->standing == Standing::settled;
}

template <int Dim>
void SleepLedger<Dim>::put_in(BodyIndex body, const Vec<Dim>& position, Standing standing) {
  if (std::ssize(sleepers_) <= body) sleepers_.resize(body + 1);
  if (sleepers_[body]) return;
  const Sleeper& sleeper = sleepers_[body].emplace(Sleeper{columns_.cell_of(position), standing});
  counts_[sleeper.column].add(standing, 1);
  if (standing != Standing::settled) ++unchecked_;
}

template <int Dim>
void SleepLedger<Dim>::take_out(BodyIndex body) {
  if (std::ssize(sleepers_) <= body || !sleepers_[body]) return;
  const auto entry = counts_.find(sleepers_[body]->column);
  const Standing standing = sleepers_[body]->standing;
  sleepers_[body].reset();
  entry->second.add(standing, -1);
  if (standing != Standing::settled) --unchecked_;
  if (entry->second.sleeping == 0) counts_.erase(entry);
}

template <int Dim>
void SleepLedger<Dim>::settle(const Column& column) {
  if (const auto found = counts_.find(column); found != counts_.end()) found->second.fresh = 0;
}

template <int Dim>
bool SleepLedger<Dim>::matches(const BodyStates<Dim>& states) const {
  std::map<Column, Count> recount;
  int unchecked = 0;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    const bool sleeps = states.asleep[body] != 0 && states.removed[body] == 0;
    const bool is_in = body < std::ssize(sleepers_) && sleepers_[body];
    if (sleeps != is_in) return false;
    if (!sleeps) continue;
    const Column column = columns_.cell_of(states.pose[body].position);
    if (column != sleepers_[body]->column) return false;
    recount[column].add(sleepers_[body]->standing, 1);
    if (sleepers_[body]->standing != Standing::settled) ++unchecked;
  }
  return unchecked == unchecked_ && std::ranges::equal(recount, counts_, [](const auto& counted, const auto& kept) {
           return counted.first == kept.first && counted.second.sleeping == kept.second.sleeping &&
                  counted.second.unchecked == kept.second.unchecked && kept.second.fresh >= 0 &&
                  kept.second.fresh <= counted.second.fresh;
         });
}

template class SleepLedger<2>;
template class SleepLedger<3>;

}  // namespace talus
