// Surfaces of shapes as polygons, from their convex pieces as TALUS_SHAPES has them.

import type { Piece, Point } from "./head";
import type { ShapeMessage } from "./moments";
import { matrixOf } from "./pose";
import { ConvexHull, Quaternion, Vector3 } from "./vendor";

type Values = Float64Array;

const arc = (centre: Point, radius: number, from: number, to: number, segments: number): Point[] =>
  Array.from({ length: segments + 1 }, (_, i) => {
    const angle = from + ((to - from) * i) / segments;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
  });

/// About the line from a to b; counter-clockwise.
function stadium(a: Point, b: Point, radius: number, segments: number): Point[] {
  const angle = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const quarter = Math.PI / 2;
  return [...arc(b, radius, angle - quarter, angle + quarter, segments / 2), ...arc(a, radius, angle + quarter, angle + 3 * quarter, segments / 2)];
}

/// Faces between rings of latitude about the line from a to b: trapezoids, at the poles triangles.
function roundFaces(a: Point, b: Point, radius: number, segments: number): Point[][] {
  const [from, to] = [new Vector3(...a), new Vector3(...b)];
  const along = to.clone().sub(from);
  const turned = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), along.lengthSq() > 0 ? along.normalize() : new Vector3(0, 0, 1));
  const steps = segments / 2;
  const latitudes = Array.from({ length: steps + 1 }, (_, i) => ({ angle: (Math.PI * i) / steps - Math.PI / 2, middle: 2 * i <= steps ? from : to }));
  if (from.distanceTo(to) > 0) latitudes.splice(steps / 2 + 1, 0, { angle: 0, middle: to });
  const rings = latitudes.map(({ angle, middle }) =>
    Array.from({ length: segments }, (_, i) => {
      const around = (2 * Math.PI * i) / segments;
      return new Vector3(Math.cos(around) * Math.cos(angle), Math.sin(around) * Math.cos(angle), Math.sin(angle)).multiplyScalar(radius).applyQuaternion(turned).add(middle).toArray() as Point;
    }),
  );
  const last = rings.length - 2;
  return rings.slice(0, -1).flatMap((ring, k) =>
    ring.map((corner, i) => {
      const next = (i + 1) % segments;
      return [corner, ...(k > 0 ? [ring[next]] : []), rings[k + 1][next], ...(k < last ? [rings[k + 1][i]] : [])];
    }),
  );
}

/// Faces of the hull of corners; triangles in one plane are one face.
function hullFaces(corners: Point[]): Point[][] {
  const points = corners.map((corner) => new Vector3(...corner));
  const size = Math.max(...points.map((point) => point.distanceTo(points[0])));
  const planes: { normal: Vector3; constant: number }[] = [];
  for (const { normal, constant } of new ConvexHull().setFromPoints(points).faces)
    if (!planes.some((plane) => plane.normal.dot(normal) > 1 - 1e-6 && Math.abs(plane.constant - constant) < 1e-5 * size)) planes.push({ normal, constant });
  return planes.map(({ normal, constant }) => {
    const face = points.filter((point) => Math.abs(normal.dot(point) - constant) < 1e-5 * size);
    const middle = face.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(face.length);
    const right = face[0].clone().sub(middle).normalize();
    const up = normal.clone().cross(right);
    const angle = (point: Vector3): number => Math.atan2(point.clone().sub(middle).dot(up), point.clone().sub(middle).dot(right));
    return face.sort((a, b) => angle(a) - angle(b)).map((point) => point.toArray() as Point);
  });
}

const pointsOf = (values: Values, axes: number): Point[] => Array.from({ length: Math.floor(values.length / axes) }, (_, i) => Array.from(values.subarray(i * axes, (i + 1) * axes)));

/// Corners of a box with its pose; in 2D in order.
function boxCorners(values: Values, flat: boolean): Point[] {
  const pose = matrixOf(values.subarray(0, flat ? 3 : 7));
  const half = values.subarray(flat ? 3 : 7);
  const signs = flat ? [[-1, -1], [1, -1], [1, 1], [-1, 1]] : Array.from({ length: 8 }, (_, i) => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1]);
  return signs.map((sign) => new Vector3(sign[0] * half[0], sign[1] * half[1], (sign[2] ?? 0) * (half[2] ?? 0)).applyMatrix4(pose).toArray().slice(0, sign.length));
}

/// `segments`: corners of a full turn of round pieces, a multiple of 4.
function pieceOf(kind: number, values: Values, flat: boolean, segments: number): Piece {
  const axes = flat ? 2 : 3;
  const [box, ball, capsule] = [0, 1, 2];
  if (kind === ball || kind === capsule) {
    const corners = pointsOf(values, axes);
    const [a, b] = [corners[0], corners[kind === ball ? 0 : 1]];
    const radius = values[values.length - 1];
    return { loops: flat ? [stadium(a, b, radius, segments)] : roundFaces(a, b, radius, segments), core: [a, b] };
  }
  const corners = kind === box ? boxCorners(values, flat) : pointsOf(values, axes);
  return { loops: flat ? [corners] : hullFaces(corners) };
}

export function piecesOf(shape: ShapeMessage, flat: boolean, segments: number): Piece[] {
  let end = 0;
  return Array.from(shape.kind, (kind, i) => pieceOf(kind, shape.values.subarray(end, (end += shape.length[i])), flat, segments));
}
