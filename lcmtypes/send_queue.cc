#include "lcmtypes/send_queue.h"

#include <algorithm>
#include <lcm/lcm-cpp.hpp>

namespace talus {
namespace {

// Sent at once, with a pause after. The receive buffers of listeners at default settings hold some 180 kB or 100 small
// packets, so the pauses spread what is queued over `spread_time`: a receiver that gets no processor time for some tens
// of milliseconds loses nothing. The fuller the queue, the shorter the pauses.
constexpr std::size_t burst_bytes = 8192;
constexpr int burst_packets = 8;
constexpr auto spread_time = std::chrono::microseconds(100'000);
constexpr auto longest_pause =
    std::chrono::microseconds(2000);  // longer, the end of a run would wait for the last ones
constexpr auto shortest_pause = std::chrono::microseconds(100);
// For which the thread lets packets gather. Each time that it wakes costs the run a few microseconds.
constexpr auto gather_time = std::chrono::milliseconds(10);
constexpr std::size_t max_packets = 4096;
constexpr auto farewell = std::chrono::milliseconds(200);

/// How a run goes and how it ended must get through before all else.
bool is_essential(Channel channel) { return channel == Channel::run || channel == Channel::stats; }

}  // namespace

SendQueue::SendQueue(std::unique_ptr<lcm::LCM> lcm, std::size_t capacity) : state_(std::make_shared<State>()) {
  state_->lcm = lcm.get();
  state_->owned = std::move(lcm);
  state_->capacity = capacity;
  start();
}

SendQueue::SendQueue(lcm::LCM& lcm, std::size_t capacity) : state_(std::make_shared<State>()) {
  state_->lcm = &lcm;
  state_->capacity = capacity;
  start();
}

SendQueue::~SendQueue() { close(farewell); }

void SendQueue::start() {
  thread_ = std::thread([state = state_] { send_all(*state); });
}

void SendQueue::push(Packet packet) {
  bool first = false;
  {
    const std::lock_guard lock(state_->mutex);
    if (state_->closing || !has_room(*state_, packet)) {
      ++state_->dropped;
      return;
    }
    first = state_->packets.empty();
    state_->bytes += packet.bytes.size();
    state_->packets.push_back(std::move(packet));
  }
  if (first) state_->changed.notify_one();
}

bool SendQueue::has_room(const State& state, const Packet& packet) {
  const std::size_t eighths = is_essential(packet.channel) ? 8 : 7;
  return state.packets.size() < max_packets / 8 * eighths &&
         state.bytes + packet.bytes.size() <= state.capacity / 8 * eighths;
}

void SendQueue::close(std::chrono::milliseconds patience) {
  if (!thread_.joinable()) return;
  std::unique_lock lock(state_->mutex);
  state_->closing = true;
  state_->changed.notify_all();
  bool finished = state_->changed.wait_for(lock, patience, [this] { return state_->done; });
  if (!finished) {
    const auto left_out =
        std::erase_if(state_->packets, [](const Packet& packet) { return !is_essential(packet.channel); });
    state_->dropped += static_cast<std::int64_t>(left_out);
    finished = state_->changed.wait_for(lock, farewell, [this] { return state_->done; });
  }
  state_->dropped += static_cast<std::int64_t>(state_->packets.size());
  state_->packets.clear();
  state_->bytes = 0;
  lock.unlock();
  if (finished || !state_->owned)
    thread_.join();
  else
    thread_.detach();
}

std::size_t SendQueue::queued_bytes() const {
  const std::lock_guard lock(state_->mutex);
  return state_->bytes;
}

std::int64_t SendQueue::dropped() const {
  const std::lock_guard lock(state_->mutex);
  return state_->dropped;
}

void SendQueue::send_all(State& state) {
  std::unique_lock lock(state.mutex);
  for (;;) {
    state.changed.wait(lock, [&] { return state.closing || !state.packets.empty(); });
    state.changed.wait_for(lock, gather_time, [&] { return state.closing; });
    if (state.packets.empty()) break;
    while (!state.packets.empty()) send_burst(state, lock);
  }
  state.done = true;
  state.changed.notify_all();
}

/// Sends without the lock; holds it before and after.
void SendQueue::send_burst(State& state, std::unique_lock<std::mutex>& lock) {
  std::size_t bytes = 0;
  for (int sent = 0; sent < burst_packets && bytes < burst_bytes && !state.packets.empty(); ++sent) {
    const Packet packet = std::move(state.packets.front());
    state.packets.pop_front();
    state.bytes -= packet.bytes.size();
    bytes += packet.bytes.size();
    lock.unlock();
    const int failed = state.lcm->publish(name_of(packet.channel), packet.bytes.data(),
                                          static_cast<unsigned int>(packet.bytes.size()));
    lock.lock();
    if (failed != 0) ++state.dropped;
  }
  const auto left = static_cast<long>(1 + std::max(state.packets.size() / burst_packets, state.bytes / burst_bytes));
  lock.unlock();
  std::this_thread::sleep_for(std::clamp(spread_time / left, shortest_pause, longest_pause));
  lock.lock();
}

}  // namespace talus
