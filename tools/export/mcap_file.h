#pragma once
// An MCAP file (https://mcap.dev/spec): messages with times on channels, with the description of their types.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/export/output_file.h"

namespace talus {

/// Writes chunks without compression, with checksums and an index by time. Each call throws std::system_error where
/// the file cannot be written. The same calls give the same bytes.
class McapFile {
 public:
  explicit McapFile(const std::filesystem::path& path);

  /// A channel of messages in the wire format of Protocol Buffers. `type`: full name of a message of `descriptors`, a
  /// serialised FileDescriptorSet. Returns the channel's number. Before the first message.
  int add_channel(std::string_view topic, std::string_view type, std::string_view descriptors);
  /// `time` in ns, not before that of the message before.
  void add(int channel, std::uint64_t time, std::string_view message);
  void close();

 private:
  struct Chunk {
    std::uint64_t begin = 0;  // times of the first and last message [ns]
    std::uint64_t end = 0;
    std::uint64_t offset = 0;              // in the file
    std::uint64_t size = 0;                // of the record
    std::uint64_t bytes = 0;               // of the messages
    std::map<int, std::uint64_t> indices;  // where the index of each channel is in the file
    std::uint64_t indices_size = 0;
  };
  struct Channel {
    std::string schema;  // the records
    std::string channel;
    std::uint32_t messages = 0;
    std::string index;  // of the messages of the chunk being made
  };

  void write(std::string_view bytes);
  void close_chunk();
  static std::string chunk_index(const Chunk& chunk);
  std::string statistics() const;

  OutputFile out_;
  std::uint64_t written_ = 0;
  std::vector<Channel> channels_;
  std::vector<Chunk> chunks_;
  Chunk next_;
  std::string records_;  // of the chunk being made
};

}  // namespace talus
