#include "tools/export/mcap_file.h"

#include <zlib.h>

#include <algorithm>

namespace talus {
namespace {

constexpr std::string_view mcap_magic("\x89MCAP0\r\n", 8);
constexpr std::size_t chunk_bytes = 1 << 20;  // a reader seeks to a chunk

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

std::string mcap_record(Opcode opcode, std::string_view content) {
  std::string bytes(1, static_cast<char>(opcode));
  append_bytes(bytes, static_cast<std::uint64_t>(content.size()));
  return bytes.append(content);
}

/// A string or a map or list of so many bytes.
void append_sized(std::string& bytes, std::string_view content) {
  append_bytes(bytes, static_cast<std::uint32_t>(content.size()));
  bytes += content;
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

McapFile::McapFile(const std::filesystem::path& path) : out_(path) {
  std::string content;
  append_sized(content, "");  // no profile: nothing beyond the format is promised
  append_sized(content, "talus");
  write(mcap_magic);
  write(mcap_record(Opcode::header, content));
}

int McapFile::add_channel(std::string_view topic, std::string_view type, std::string_view descriptors) {
  const auto number = static_cast<std::uint16_t>(channels_.size() + 1);
  Channel& added = channels_.emplace_back();
  append_bytes(added.schema, number);
  append_sized(added.schema, type);
  append_sized(added.schema, "protobuf");
  append_sized(added.schema, descriptors);
  append_bytes(added.channel, number);
  append_bytes(added.channel, number);
  append_sized(added.channel, topic);
  append_sized(added.channel, "protobuf");
  append_sized(added.channel, "");
  added.schema = mcap_record(Opcode::schema, added.schema);
  added.channel = mcap_record(Opcode::channel, added.channel);
  records_ += added.schema + added.channel;
  return number;
}

void McapFile::add(int channel, std::uint64_t time, std::string_view message) {
  Channel& own = channels_[channel - 1];
  append_bytes(own.index, time);
  append_bytes(own.index, static_cast<std::uint64_t>(records_.size()));
  std::string content;
  append_bytes(content, static_cast<std::uint16_t>(channel));
  append_bytes(content, own.messages++);
  append_bytes(content, time);
  append_bytes(content, time);
  content += message;
  if (next_.bytes == 0) next_.begin = time;
  next_.end = time;
  next_.bytes += content.size();
  records_ += mcap_record(Opcode::message, content);
  if (records_.size() >= chunk_bytes) close_chunk();
}

void McapFile::close_chunk() {
  next_.offset = written_;
  next_.bytes = records_.size();
  std::string content;
  append_bytes(content, next_.begin);
  append_bytes(content, next_.end);
  append_bytes(content, next_.bytes);
  append_bytes(content, crc_of(records_));
  append_sized(content, "");  // no compression
  append_bytes(content, next_.bytes);
  write(mcap_record(Opcode::chunk, content + records_));
  next_.size = written_ - next_.offset;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].index.empty()) continue;
    const auto number = static_cast<int>(i + 1);
    std::string index;
    append_bytes(index, static_cast<std::uint16_t>(number));
    append_sized(index, channels_[i].index);
    next_.indices[number] = written_;
    write(mcap_record(Opcode::message_index, index));
    channels_[i].index.clear();
  }
  next_.indices_size = written_ - next_.offset - next_.size;
  chunks_.push_back(next_);
  next_ = {};
  records_.clear();
}

std::string McapFile::chunk_index(const Chunk& chunk) {
  std::string content;
  for (const std::uint64_t value : {chunk.begin, chunk.end, chunk.offset, chunk.size}) append_bytes(content, value);
  std::string indices;
  for (const auto& [number, offset] : chunk.indices) {
    append_bytes(indices, static_cast<std::uint16_t>(number));
    append_bytes(indices, offset);
  }
  append_sized(content, indices);
  append_bytes(content, chunk.indices_size);
  append_sized(content, "");
  append_bytes(content, chunk.bytes);
  append_bytes(content, chunk.bytes);
  return mcap_record(Opcode::chunk_index, content);
}

std::string McapFile::statistics() const {
  std::uint64_t messages = 0;
  std::string counts;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    messages += channels_[i].messages;
    append_bytes(counts, static_cast<std::uint16_t>(i + 1));
    append_bytes(counts, static_cast<std::uint64_t>(channels_[i].messages));
  }
  std::string content;
  append_bytes(content, messages);
  append_bytes(content, static_cast<std::uint16_t>(channels_.size()));
  for (const std::size_t count : {channels_.size(), std::size_t{0}, std::size_t{0}, chunks_.size()})
    append_bytes(content, static_cast<std::uint32_t>(count));
  append_bytes(content, chunks_.empty() ? 0 : chunks_.front().begin);
  append_bytes(content, chunks_.empty() ? 0 : chunks_.back().end);
  append_sized(content, counts);
  return mcap_record(Opcode::statistics, content);
}

void McapFile::close() {
  if (!records_.empty()) close_chunk();
  write(mcap_record(Opcode::data_end, std::string(4, '\0')));  // without a checksum of the whole
  std::string summary;
  std::string offsets;
  const auto add_group = [&](Opcode opcode, std::string_view records) {
    if (records.empty()) return;
    std::string offset(1, static_cast<char>(opcode));
    append_bytes(offset, written_ + summary.size());
    append_bytes(offset, static_cast<std::uint64_t>(records.size()));
    offsets += mcap_record(Opcode::summary_offset, offset);
    summary += records;
  };
  std::string schemas;
  std::string channels;
  std::string indices;
  for (const Channel& each : channels_) schemas += each.schema;
  for (const Channel& each : channels_) channels += each.channel;
  for (const Chunk& each : chunks_) indices += chunk_index(each);
  add_group(Opcode::schema, schemas);
  add_group(Opcode::channel, channels);
  add_group(Opcode::statistics, statistics());
  add_group(Opcode::chunk_index, indices);
  std::string end;
  append_bytes(end, written_);
  append_bytes(end, static_cast<std::uint64_t>(written_ + summary.size()));
  std::string last = mcap_record(Opcode::footer, end + std::string(4, '\0'));
  last.resize(last.size() - 4);  // the checksum goes to here
  summary += offsets + last;
  append_bytes(summary, crc_of(summary));
  write(summary);
  write(mcap_magic);
  out_.close();
}

void McapFile::write(std::string_view bytes) {
  out_.write(bytes);
  written_ += bytes.size();
}

}  // namespace talus
