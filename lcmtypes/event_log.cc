#include "lcmtypes/event_log.h"

#include <cerrno>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <system_error>

namespace talus {

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
