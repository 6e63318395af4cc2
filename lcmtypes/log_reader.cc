#include "lcmtypes/log_reader.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

#include "lcmtypes/channels.h"
#include "lcmtypes/layout.h"
#include "lcmtypes/wire.h"

namespace talus {
namespace {

constexpr std::size_t header_size = 4 + 8 + 8 + 4 + 4;
constexpr std::size_t max_channel_length = 63;         // LCM_MAX_CHANNEL_NAME_LENGTH
constexpr std::size_t max_foreign_bytes = 16U << 20U;  // of a message that is not ours
constexpr std::size_t chunk = 1U << 16U;               // [bytes] that are read at once

bool is_sync(std::span<const std::uint8_t> bytes) {
  return std::equal(std::begin(log_sync_word), std::end(log_sync_word), bytes.begin());
}

bool is_ours(std::string_view channel) { return channel_named(channel).has_value(); }

bool is_name(std::string_view channel) {
  return std::all_of(channel.begin(), channel.end(), [](char letter) { return letter > ' ' && letter <= '~'; });
}

std::string_view text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

LogReader::LogReader(const std::string& path) : log_(std::make_unique<std::ifstream>(path, std::ios::binary)) {
  if (!*log_) throw std::system_error(errno, std::generic_category(), path);
}

bool LogReader::next(LogEvent& event) {
  while (have(1)) {
    const std::size_t size = event_size();
    if (size == 0) {
      skip_to_candidate();
      continue;
    }
    in_damage_ = false;
    const auto bytes = rest().first(size);
    const std::size_t channel_length = big_endian(bytes.subspan(20, 4));
    event.number = static_cast<std::int64_t>(big_endian(bytes.subspan(4, 8)));
    event.timestamp = static_cast<std::int64_t>(big_endian(bytes.subspan(12, 8)));
    event.channel = text(bytes.subspan(header_size, channel_length));
    const auto data = bytes.subspan(header_size + channel_length);
    event.data.assign(data.begin(), data.end());
    at_ += size;
    return true;
  }
  return false;
}

/// Size of the valid event that begins here, or 0.
std::size_t LogReader::event_size() {
  if (!have(header_size) || !is_sync(rest())) return 0;
  const std::size_t channel_length = big_endian(rest().subspan(20, 4));
  const std::size_t data_length = big_endian(rest().subspan(24, 4));
  if (channel_length == 0 || channel_length > max_channel_length || !have(header_size + channel_length)) return 0;
  const std::string_view channel = text(rest().subspan(header_size, channel_length));
  if (!is_name(channel)) return 0;
  const bool ours = is_ours(channel);  // now: have() may move the bytes
  if (data_length > (ours ? max_message_bytes : max_foreign_bytes)) return 0;
  const std::size_t size = header_size + channel_length + data_length;
  if (!have(size)) return 0;
  if (ours) return checksum_holds(rest().subspan(header_size + channel_length, data_length)) ? size : 0;
  return !have(size + 1) || (have(size + 4) && is_sync(rest().subspan(size))) ? size : 0;
}

/// Leaves at least one byte out, and all up to the next one that a sync word could begin with.
void LogReader::skip_to_candidate() {
  if (!in_damage_) ++damage_.places;
  in_damage_ = true;
  const auto after = rest().subspan(1);
  const auto found = std::find(after.begin(), after.end(), log_sync_word[0]);
  const auto skipped = found - after.begin() + 1;
  damage_.bytes += skipped;
  at_ += skipped;
}

/// Whether so many bytes follow; reads them in.
bool LogReader::have(std::size_t bytes) {
  while (buffer_.size() - at_ < bytes && *log_) {
    if (at_ >= chunk) {
      buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at_));
      at_ = 0;
    }
    const std::size_t before = buffer_.size();
    buffer_.resize(before + chunk);
    log_->read(reinterpret_cast<char*>(buffer_.data() + before), static_cast<std::streamsize>(chunk));
    buffer_.resize(before + log_->gcount());
  }
  return buffer_.size() - at_ >= bytes;
}

}  // namespace talus
