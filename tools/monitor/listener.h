#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/monitor/run_view.h"

namespace lcm {
class LCM;
class Subscription;
struct ReceiveBuffer;
}  // namespace lcm

namespace talus {

/// Hears all runs of one LCM network. Handlers only check, decode and keep the newest; lcm.handle() calls them.
class Listener {
 public:
  explicit Listener(lcm::LCM& lcm);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  /// By the runs' numbers. When these become many, those that ended are forgotten.
  const std::map<std::int64_t, RunView>& runs() const { return runs_; }
  /// Messages missing, over all runs, forgotten ones too.
  std::int64_t lost() const;

  /// Messages on our channels that were not ours or damaged, and what was wrong with the last one.
  std::int64_t undecodable() const { return undecodable_; }
  const std::string& last_fault() const { return last_fault_; }

 private:
  template <class Message>
  void subscribe();
  template <class Message>
  void hear(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void forget_ended();

  lcm::LCM& lcm_;
  std::vector<lcm::Subscription*> subscriptions_;  // belong to lcm_
  std::map<std::int64_t, RunView> runs_;
  std::int64_t lost_by_forgotten_ = 0;
  std::int64_t undecodable_ = 0;
  std::string last_fault_;
};

}  // namespace talus
