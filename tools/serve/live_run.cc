#include "tools/serve/live_run.h"

#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/text/printable.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/moment_reader.h"
#include "lcmtypes/wire.h"
#include "tools/output/json_text.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;
using talus_lcm::talus_run;
using talus_lcm::talus_stats;

constexpr auto silence = std::chrono::seconds(2);

/// Of each channel on which messages came or were lost: its name, how many came, how many were lost.
Json channels_json(const MomentReader& heard) {
  Json channels = Json::array();
  for (const Channel channel : all_channels)
    if (heard.received(channel) > 0 || heard.lost(channel) > 0)
      channels.push_back({name_of(channel), heard.received(channel), heard.lost(channel)});
  return channels;
}

Json status_json(const std::string& reason, bool finished, const std::string& policy, std::int64_t step, double ms,
                 double factor) {
  return {{"kind", "status"},
          {"live", true},
          {"running", !finished && reason.empty()},
          {"finished", finished},
          {"reason", reason},
          {"pace", 0},
          {"policy", policy},
          {"policies", {policy}},
          {"step", step},
          {"ms_per_step", ms},
          {"real_time_factor", factor}};
}

}  // namespace

/// What has been heard of the run that is followed.
class LiveRun::Followed {
 public:
  Followed(const talus_run& run, PageHub& hub) : reader_(run.dimension, {}), run_id_(run.run_id), hub_(hub) {}

  bool is_of(std::int64_t run_id) const { return run_id_ == run_id; }
  bool ended() const { return run().phase == talus_run::END; }
  bool is_restart(const talus_run& message) const { return reader_.is_restart(message); }
  const talus_run& run() const { return *reader_.run(); }
  const MomentReader& reader() const { return reader_; }

  /// Relays what says something new, once the shapes are known: the poses of a moment come last of its messages.
  template <class Message>
  void take(const Message& message, std::span<const std::uint8_t> bytes) {
    constexpr Channel channel = channel_of<Message>;
    const std::int64_t received = reader_.received(channel);
    const std::int64_t form = reader_.form();
    const std::size_t done = reader_.moment().done.size();
    const bool whole = reader_.take(message);
    if (reader_.received(channel) == received) return;  // a duplicate
    constexpr bool identifies = channel == Channel::run || channel == Channel::shapes || channel == Channel::events;
    if (identifies) {
      const bool is_new = identity_.empty() || reader_.form() > form || reader_.moment().done.size() > done;
      if (!is_new) return;  // told again
      append_event(identity_, 0, message.utime, channel, bytes);
    }
    if (pending_.size() > most_pending) pending_.clear();
    append_event(pending_, 0, message.utime, channel, bytes);
    if (whole && reader_.has_all_shapes()) show();
  }

 private:
  static constexpr std::size_t most_pending = std::size_t{16} << 20U;  // [bytes] of messages before their poses

  /// A shape that was not known yet begins the run again.
  void show() {
    std::string block = std::exchange(pending_, {});
    if (shape_form_ != reader_.shape_form()) {
      hub_.begin(json_text({{"kind", "begin"}, {"box", nullptr}}));
      block.insert(0, identity_);
    }
    shape_form_ = reader_.shape_form();
    hub_.publish({.step = reader_.moment().step, .block = std::move(block)});
  }

  MomentReader reader_;
  std::int64_t run_id_;
  PageHub& hub_;
  std::string identity_;         // as log events: the run, its shapes, obstacles and events, as each was new
  std::string pending_;          // all that came since the last moment
  std::int64_t shape_form_ = 0;  // of the run as it was begun; 0: it was not
};

LiveRun::LiveRun(PageHub& hub, const std::string& waiting) : hub_(hub) {
  hub_.set_status(json_text(status_json(waiting, false, "", 0, 0.0, 0.0)));
}

LiveRun::~LiveRun() = default;

template <class Message>
void LiveRun::hear(const Datagram& datagram, Message& message, Clock::time_point now) {
  if (!decode(datagram.bytes, message).empty()) {
    ++undecodable_;
    return;
  }
  const bool followed = followed_ != nullptr && followed_->is_of(message.run_id);
  if constexpr (std::is_same_v<Message, talus_run>) {
    const bool free = followed_ == nullptr || followed_->ended() || now - heard_ > silence;
    const bool anew = followed ? followed_->is_restart(message) : free && message.phase != talus_run::END;
    if (anew) followed_ = std::make_unique<Followed>(message, hub_);
  }
  if (followed_ == nullptr || !followed_->is_of(message.run_id)) return;
  heard_ = now;
  try {
    followed_->take(message, datagram.bytes);
    if constexpr (std::is_same_v<Message, talus_run> || std::is_same_v<Message, talus_stats>) show_status();
  } catch (const std::invalid_argument&) {  // a body of a shape that is not there, a shape without a volume
    ++undecodable_;
  }
}

void LiveRun::show_status() {
  const talus_run& run = followed_->run();
  const MomentReader& reader = followed_->reader();
  const bool ended = followed_->ended();
  const talus_stats stats = reader.stats().value_or(talus_stats{});
  Json status =
      status_json(ended && run.reason != "finished" ? printable(run.reason) : "", ended, printable(run.policy),
                  stats.step, stats.ms_step, stats.timed != 0 ? stats.real_time_factor : 0.0);
  status["channels"] = channels_json(reader);
  status["undecodable"] = undecodable_;
  status["slept"] = reader.slept();
  status["woken"] = reader.woken();
  hub_.set_status(json_text(status));
}

void LiveRun::hear(const Datagram& datagram, Clock::time_point now) {
  with_message_of(datagram.channel, [&](auto message) { this->hear(datagram, message, now); });
}

}  // namespace talus
