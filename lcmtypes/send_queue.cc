#include "lcmtypes/send_queue.h"

#include <lcm/lcm-cpp.hpp>

namespace talus {
namespace {

constexpr auto pause = std::chrono::microseconds(100);
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
  {
    const std::lock_guard lock(state_->mutex);
    if (state_->closing || !has_room(*state_, packet)) {
      ++state_->dropped;
      return;
    }
    state_->bytes += packet.bytes.size();
    state_->packets.push_back(std::move(packet));
  }
  state_->changed.notify_one();
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
    if (state.packets.empty()) break;
    const Packet packet = std::move(state.packets.front());
    state.packets.pop_front();
    state.bytes -= packet.bytes.size();
    lock.unlock();
    const int failed = state.lcm->publish(name_of(packet.channel), packet.bytes.data(),
                                          static_cast<unsigned int>(packet.bytes.size()));
    std::this_thread::sleep_for(pause);
    lock.lock();
    if (failed != 0) ++state.dropped;
  }
  state.done = true;
  state.changed.notify_all();
}

}  // namespace talus
