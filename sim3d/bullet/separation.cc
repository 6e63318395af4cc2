#include "sim3d/bullet/separation.h"

namespace talus::bullet {
namespace {

/// Share of the boxes' extents that single precision could be wrong by, and much more.
constexpr btScalar clearance = 1e-4F;

/// Whether all corners of `other` lie outside of the face.
bool outside(const btFace& face, const btTransform& place, const PlacedPolyhedron& other, btScalar gap) {
  const btVector3 normal = place.getBasis() * btVector3(face.m_plane[0], face.m_plane[1], face.m_plane[2]);
  const btVector3 in_other = normal * other.place.getBasis();
  const btScalar middle = normal.dot(other.place.getOrigin() - place.getOrigin()) + face.m_plane[3];
  btScalar reach = 0;
  for (int i = 0; i < other.shape->m_vertices.size(); ++i)
    reach = btMax(reach, -in_other.dot(other.shape->m_vertices[i]));
  return middle - reach > gap + clearance * (btFabs(middle) + btFabs(face.m_plane[3]) + reach);
}

}  // namespace

bool apart_along(BoxAxis axis, const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                 const btTransform& second_place) {
  const bool of_first = axis < 3;
  const int column = of_first ? axis : axis - 3;
  const btVector3 direction = (of_first ? first_place : second_place).getBasis().getColumn(column);
  const btVector3 across = direction * (of_first ? second_place : first_place).getBasis();  // in the other's axes
  const btVector3 own_half = (of_first ? first : second).getHalfExtentsWithMargin();
  const btVector3 other_half = (of_first ? second : first).getHalfExtentsWithMargin();
  const btScalar reach = own_half[column] + across.absolute().dot(other_half);
  const btScalar distance = btFabs((second_place.getOrigin() - first_place.getOrigin()).dot(direction));
  return distance - reach > clearance * (distance + reach);
}

BoxAxis separating_axis(const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                        const btTransform& second_place) {
  for (BoxAxis axis = 0; axis < 6; ++axis)
    if (apart_along(axis, first, first_place, second, second_place)) return axis;
  return -1;
}

bool apart_along(FaceAxis face, const PlacedPolyhedron& first, const PlacedPolyhedron& second, btScalar gap) {
  const int own = first.shape->m_faces.size();
  return face < own ? outside(first.shape->m_faces[face], first.place, second, gap)
                    : outside(second.shape->m_faces[face - own], second.place, first, gap);
}

FaceAxis separating_face(const PlacedPolyhedron& first, const PlacedPolyhedron& second, btScalar gap) {
  const int faces = first.shape->m_faces.size() + second.shape->m_faces.size();
  for (FaceAxis face = 0; face < faces; ++face)
    if (apart_along(face, first, second, gap)) return face;
  return -1;
}

}  // namespace talus::bullet
