#include "tools/export/protobuf.h"

#include <algorithm>
#include <bit>

#include "tools/export/output_file.h"

namespace talus {
namespace {

// The wire types of the format.
constexpr int wire_varint = 0;
constexpr int wire_64_bits = 1;
constexpr int wire_length = 2;

std::string_view package_of(std::string_view name) { return name.substr(0, name.rfind('.')); }
std::string_view own_name(std::string_view name) { return name.substr(name.rfind('.') + 1); }
std::string file_of(std::string_view package) { return std::string(package) + ".proto"; }

ProtoMessage field_descriptor(const ProtoField& field) {
  constexpr int optional = 1;
  constexpr int repeated = 3;
  ProtoMessage message;
  message.add(1, field.name);
  message.add_integer(3, field.number);
  message.add_integer(4, field.repeated ? repeated : optional);
  message.add_integer(5, static_cast<std::uint64_t>(field.type));
  if (!field.of.empty()) message.add(6, "." + std::string(field.of));
  return message;
}

ProtoMessage message_descriptor(const ProtoSchema& schema) {
  ProtoMessage message;
  message.add(1, own_name(schema.name));
  for (const ProtoField& field : schema.fields) message.add(2, field_descriptor(field));
  return message;
}

ProtoMessage enum_descriptor(const ProtoSchema& schema) {
  ProtoMessage message;
  message.add(1, own_name(schema.name));
  for (std::size_t i = 0; i < schema.values.size(); ++i) {
    ProtoMessage value;
    value.add(1, schema.values[i]);
    value.add_integer(2, i);
    message.add(2, value);
  }
  return message;
}

/// The packages that the fields of a package's messages refer to, each once.
std::vector<std::string_view> packages_needed(std::span<const ProtoSchema> schemas, std::string_view package) {
  std::vector<std::string_view> needed;
  for (const ProtoSchema& schema : schemas) {
    if (package_of(schema.name) != package) continue;
    for (const ProtoField& field : schema.fields) {
      const std::string_view other = package_of(field.of);
      if (!field.of.empty() && other != package && std::ranges::find(needed, other) == needed.end())
        needed.push_back(other);
    }
  }
  return needed;
}

ProtoMessage file_descriptor(std::span<const ProtoSchema> schemas, std::string_view package) {
  ProtoMessage file;
  file.add(1, file_of(package));
  file.add(2, package);
  for (const std::string_view other : packages_needed(schemas, package)) file.add(3, file_of(other));
  for (const ProtoSchema& schema : schemas) {
    if (package_of(schema.name) != package) continue;
    if (schema.values.empty())
      file.add(4, message_descriptor(schema));
    else
      file.add(5, enum_descriptor(schema));
  }
  file.add(12, "proto3");
  return file;
}

}  // namespace

void ProtoMessage::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>((value & 0x7F) | 0x80);
  bytes_ += static_cast<char>(value);
}

void ProtoMessage::tag(int field, int wire_type) { varint(static_cast<std::uint64_t>(field) << 3 | wire_type); }

void ProtoMessage::add(int field, double value) {
  tag(field, wire_64_bits);
  append_bytes(bytes_, value);
}

void ProtoMessage::add(int field, std::string_view text) {
  tag(field, wire_length);
  varint(text.size());
  bytes_ += text;
}

void ProtoMessage::add(int field, const ProtoMessage& message) { add(field, std::string_view(message.bytes_)); }

void ProtoMessage::add_integer(int field, std::uint64_t value) {
  tag(field, wire_varint);
  varint(value);
}

void ProtoMessage::add_packed(int field, std::span<const double> values) {
  tag(field, wire_length);
  varint(values.size_bytes());
  for (const double value : values) append_bytes(bytes_, value);
}

void ProtoMessage::add_packed(int field, std::span<const std::uint32_t> fixed) {
  tag(field, wire_length);
  varint(fixed.size_bytes());
  for (const std::uint32_t value : fixed) append_bytes(bytes_, value);
}

std::string descriptor_set(std::span<const ProtoSchema> schemas) {
  std::vector<std::string_view> packages;
  for (const ProtoSchema& schema : schemas)
    if (std::ranges::find(packages, package_of(schema.name)) == packages.end())
      packages.push_back(package_of(schema.name));
  ProtoMessage set;
  for (const std::string_view package : packages) set.add(1, file_descriptor(schemas, package));
  return set.bytes();
}

}  // namespace talus
