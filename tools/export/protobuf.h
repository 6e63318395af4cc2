#pragma once
// Messages in the wire format of Protocol Buffers, and their description for readers that do not know them.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// The bytes of one message, field by field. A field's number is that of its schema.
class ProtoMessage {
 public:
  void add(int field, double value);
  void add(int field, std::string_view text);
  void add(int field, const ProtoMessage& message);
  /// Integers, enumerators and booleans.
  void add_integer(int field, std::uint64_t value);
  void add_packed(int field, std::span<const double> values);
  void add_packed(int field, std::span<const std::uint32_t> fixed);

  const std::string& bytes() const { return bytes_; }

 private:
  void tag(int field, int wire_type);
  void varint(std::uint64_t value);

  std::string bytes_;
};

/// Types of fields, as numbered by google.protobuf.FieldDescriptorProto.
enum class ProtoType : std::uint8_t {
  number = 1,
  int64 = 3,
  int32 = 5,
  fixed32 = 7,
  boolean = 8,
  text = 9,
  message = 11,
  enumeration = 14
};

struct ProtoField {
  std::string_view name;
  int number = 0;
  ProtoType type = ProtoType::number;
  bool repeated = false;
  std::string_view of = {};  // full name of the message or enumeration, as "foxglove.Pose"
};

/// A message or, with values, an enumeration.
struct ProtoSchema {
  std::string_view name;  // with its package, as "foxglove.Pose"
  std::vector<ProtoField> fields = {};
  std::vector<std::string_view> values = {};  // numbered from 0
};

/// A serialised google.protobuf.FileDescriptorSet of `schemas`, in which all names that they refer to must be. A file
/// for each package, in the order of the first schemas.
std::string descriptor_set(std::span<const ProtoSchema> schemas);

}  // namespace talus
