#include "tools/export/npz_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <charconv>
#include <cstdlib>

namespace talus {
namespace {

// Fields of ZIP (APPNOTE.TXT of PKWARE, 4.3).
constexpr std::uint16_t version_with_zip64 = 45;
constexpr std::uint16_t first_date = (1U << 5U) | 1U;  // 1 January 1980: the same arrays give the same bytes
constexpr std::uint32_t in_zip64 = 0xFFFFFFFF;

std::uint64_t item_size(std::string_view type) {
  std::uint64_t size = 0;
  std::from_chars(type.data() + 2, type.data() + type.size(), size);
  return size;
}

/// The header of a .npy file, version 1.0, padded so that the data begin at a multiple of 64.
std::string npy_header(std::string_view type, const std::vector<std::uint64_t>& shape) {
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", type, fmt::join(shape, ", "));
  constexpr std::size_t preamble = 10;
  while ((preamble + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string header = "\x93NUMPY\x01";
  header += '\0';
  append_bytes(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

std::uint32_t crc_of(std::uint32_t before, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

/// What both headers of a member have in common: method, date, checksum, sizes and the length of its name.
void append_common(std::string& bytes, std::uint32_t crc, std::size_t name_length, std::uint16_t extra_length) {
  append_bytes<std::uint16_t>(bytes, version_with_zip64);
  append_bytes<std::uint16_t>(bytes, 0);  // flags
  append_bytes<std::uint16_t>(bytes, 0);  // stored
  append_bytes<std::uint16_t>(bytes, 0);  // time
  append_bytes<std::uint16_t>(bytes, first_date);
  append_bytes<std::uint32_t>(bytes, crc);
  append_bytes<std::uint32_t>(bytes, in_zip64);
  append_bytes<std::uint32_t>(bytes, in_zip64);
  append_bytes(bytes, static_cast<std::uint16_t>(name_length));
  append_bytes<std::uint16_t>(bytes, extra_length);
}

}  // namespace

int NpzFile::declare(std::string_view name, std::string_view type, const std::vector<std::uint64_t>& shape) {
  Member member;
  member.name = std::string(name) + ".npy";
  member.header = npy_header(type, shape);
  member.size = item_size(type);
  for (const std::uint64_t count : shape) member.size *= count;
  member.size += member.header.size();
  member.offset = end_;
  end_ += local_header(member).size() + member.size;
  members_.push_back(std::move(member));
  const int number = static_cast<int>(members_.size()) - 1;
  append(number, members_.back().header);
  return number;
}

void NpzFile::append(int array, std::string_view bytes) {
  Member& member = members_[array];
  out_.write_at(member.offset + local_header(member).size() + member.written, bytes);
  member.written += bytes.size();
  member.crc = crc_of(member.crc, bytes);
}

std::string NpzFile::local_header(const Member& member) {
  std::string bytes = "PK\x03\x04";
  append_common(bytes, member.crc, member.name.size(), 20);
  bytes += member.name;
  append_bytes<std::uint16_t>(bytes, 1);  // ZIP64: sizes
  append_bytes<std::uint16_t>(bytes, 16);
  append_bytes(bytes, member.size);
  append_bytes(bytes, member.size);
  return bytes;
}

void NpzFile::finish() {
  std::string directory;
  for (const Member& member : members_) {
    if (member.written != member.size) std::abort();
    out_.write_at(member.offset, local_header(member));
    directory += "PK\x01\x02";
    append_bytes<std::uint16_t>(directory, version_with_zip64);
    append_common(directory, member.crc, member.name.size(), 28);
    directory.append(2 + 2 + 2 + 4, '\0');  // comment, disk, attributes
    append_bytes<std::uint32_t>(directory, in_zip64);
    directory += member.name;
    append_bytes<std::uint16_t>(directory, 1);  // ZIP64: sizes and offset
    append_bytes<std::uint16_t>(directory, 24);
    for (const std::uint64_t number : {member.size, member.size, member.offset}) append_bytes(directory, number);
  }
  const std::uint64_t count = members_.size();
  std::string end = "PK\x06\x06";  // ZIP64 end of the directory
  append_bytes<std::uint64_t>(end, 44);
  append_bytes<std::uint16_t>(end, version_with_zip64);
  append_bytes<std::uint16_t>(end, version_with_zip64);
  append_bytes<std::uint64_t>(end, 0);  // disks
  for (const std::uint64_t number : {count, count, static_cast<std::uint64_t>(directory.size()), end_})
    append_bytes(end, number);
  end += "PK\x06\x07";  // where that is
  append_bytes<std::uint32_t>(end, 0);
  append_bytes<std::uint64_t>(end, end_ + directory.size());
  append_bytes<std::uint32_t>(end, 1);
  end += "PK\x05\x06";  // end of the directory: all in ZIP64
  append_bytes<std::uint32_t>(end, 0);
  append_bytes<std::uint32_t>(end, in_zip64);
  append_bytes<std::uint32_t>(end, in_zip64);
  append_bytes<std::uint32_t>(end, in_zip64);
  append_bytes<std::uint16_t>(end, 0);
  out_.write_at(end_, directory + end);
  out_.close();
}

}  // namespace talus
