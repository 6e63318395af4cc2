#include "tools/monitor/listener.h"

#include <lcm/lcm-cpp.hpp>

#include "lcmtypes/decode.h"

namespace talus {

using talus_lcm::talus_piles_v1;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v2;

namespace {

// Anybody can invent runs; more than these at a time nobody watches.
constexpr std::size_t max_runs = 64;

}  // namespace

Listener::Listener(lcm::LCM& lcm) : lcm_(lcm) {
  subscribe<talus_run_v1>();
  subscribe<talus_piles_v1>();
  subscribe<talus_sleep_v1>();
  subscribe<talus_stats_v2>();
}

Listener::~Listener() {
  for (lcm::Subscription* subscription : subscriptions_) lcm_.unsubscribe(subscription);
}

template <class Message>
void Listener::subscribe() {
  subscriptions_.push_back(lcm_.subscribe(name_of(channel_of<Message>), &Listener::hear<Message>, this));
  subscriptions_.back()->setQueueCapacity(0);  // without limit: LCM's 30 lose most of what arrives in one burst
}

template <class Message>
void Listener::hear(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  Message message{};
  const auto fault = decode(std::span(static_cast<const std::uint8_t*>(buffer->data), buffer->data_size), message);
  if (!fault.empty()) {
    ++undecodable_;
    last_fault_ = channel + ": " + std::string(fault);
    return;
  }
  if (!runs_.contains(message.run_id)) {
    if (runs_.size() >= max_runs) forget_ended();
    if (runs_.size() >= max_runs) return;
  }
  RunView& view = runs_[message.run_id];
  if constexpr (std::is_same_v<Message, talus_run_v1>) {
    if (view.is_restart(message)) {
      lost_by_forgotten_ += view.lost();
      view = {};
    }
  }
  view.take(message);
}

void Listener::forget_ended() {
  std::erase_if(runs_, [this](const auto& run) {
    if (run.second.ended()) lost_by_forgotten_ += run.second.lost();
    return run.second.ended();
  });
}

std::int64_t Listener::lost() const {
  std::int64_t sum = lost_by_forgotten_;
  for (const auto& [run_id, view] : runs_) sum += view.lost();
  return sum;
}

}  // namespace talus
