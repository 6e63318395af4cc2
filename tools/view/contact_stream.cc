#include "tools/view/contact_stream.h"

#include "tools/view/stream_numbers.h"

namespace talus {

template <int Dim>
std::string encode_contacts(std::span<const ShownContact<Dim>> contacts, const Quantum& quantum) {
  std::string bytes;
  write_unsigned(bytes, contacts.size());
  std::array<std::int32_t, Dim> before = {};
  for (const ShownContact<Dim>& contact : contacts) {
    write_unsigned(bytes, contact.a);
    write_signed(bytes, contact.b);
    write_unsigned(bytes, contact.kept ? 1 : 0);
    for (int axis = 0; axis < Dim; ++axis) {
      const std::int32_t now = in_quanta(contact.point[axis], quantum.position);
      write_signed(bytes, std::int64_t{now} - before[axis]);
      before[axis] = now;
    }
    for (const Vec<Dim>& force : {contact.normal_force, contact.friction_force})
      for (int axis = 0; axis < Dim; ++axis) write_float(bytes, static_cast<float>(force[axis]));
  }
  return bytes;
}

template std::string encode_contacts(std::span<const ShownContact<2>>, const Quantum&);
template std::string encode_contacts(std::span<const ShownContact<3>>, const Quantum&);

}  // namespace talus
