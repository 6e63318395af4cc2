#include "lcmtypes/event_log.h"

#include <cerrno>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <system_error>

namespace talus {

namespace {

template <class Number>
void append_big_endian(std::string& bytes, Number number) {
  for (int shift = 8 * (static_cast<int>(sizeof number) - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> shift);
}

}  // namespace

void append_event(std::string& log, std::int64_t number, std::int64_t stamp, Channel channel,
                  std::span<const std::uint8_t> data) {
  const std::string_view name = name_of(channel);
  log.append(std::begin(log_sync_word), std::end(log_sync_word));
  append_big_endian(log, number);
  append_big_endian(log, stamp);
  append_big_endian(log, static_cast<std::uint32_t>(name.size()));
  append_big_endian(log, static_cast<std::uint32_t>(data.size()));
  log += name;
  log.append(data.begin(), data.end());
}

EventLog::EventLog(std::string path) : path_(std::move(path)), file_(std::make_unique<lcm::LogFile>(path_, "w")) {
  if (!file_->good()) fail();
}

EventLog::~EventLog() = default;

void EventLog::write(Packet& packet) { write(packet.utime, name_of(packet.channel), packet.bytes); }

void EventLog::write(LogEvent& event) { write(event.timestamp, event.channel, event.data); }

void EventLog::write(std::int64_t stamp, const std::string& channel, std::vector<std::uint8_t>& data) {
  if (broken_) return;
  lcm::LogEvent event{};
  event.timestamp = stamp;
  event.channel = channel;
  event.datalen = static_cast<std::int32_t>(data.size());
  event.data = data.data();
  if (file_->writeEvent(&event) != 0) fail();
}

void EventLog::flush() {
  if (broken_) return;
  if (std::fflush(file_->getFilePtr()) != 0) fail();
  last_flush_ = std::chrono::steady_clock::now();
}

void EventLog::flush_after(double interval) {
  if (std::chrono::steady_clock::now() - last_flush_ >= std::chrono::duration<double>(interval)) flush();
}

void EventLog::fail() {
  broken_ = true;
  throw std::system_error(errno, std::generic_category(), path_);
}

}  // namespace talus
