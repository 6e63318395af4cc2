// Triangles of shapes, with what is needed to draw the outlines of a body.

import type { Piece, Point } from "./head";
import { BufferAttribute, BufferGeometry } from "./vendor";

/// Parts of an edge that are tested for lying within another piece.
const edgeParts = 8;

interface Plane {
  normal: Point;
  distance: number;
}

const difference = (a: Point, b: Point): Point => a.map((value, i) => value - b[i]);
const dot = (a: Point, b: Point): number => a.reduce((sum, value, i) => sum + value * b[i], 0);
const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const scaled = (a: Point, by: number): Point => a.map((value) => value * by);
const normalized = (a: Point): Point => scaled(a, 1 / (Math.sqrt(dot(a, a)) || 1));
const between = (a: Point, b: Point, share: number): Point => a.map((value, i) => value + share * (b[i] - value));

function normalOf(loop: Point[]): Point {
  let sum = [0, 0, 0];
  for (let i = 1; i + 1 < loop.length; ++i) {
    const part = cross(difference(loop[i], loop[0]), difference(loop[i + 1], loop[0]));
    sum = sum.map((value, k) => value + part[k]);
  }
  return normalized(sum);
}

/// Half-spaces whose intersection is the piece.
function planesOf(piece: Piece): Plane[] {
  if (piece.loops[0]?.[0]?.length === 3)
    return piece.loops.map((loop) => {
      const normal = normalOf(loop);
      return { normal, distance: dot(normal, loop[0]) };
    });
  const loop = piece.loops[0];
  return loop.map((corner, i) => {
    const along = difference(loop[(i + 1) % loop.length], corner);
    const normal = normalized([along[1], -along[0]]);
    return { normal, distance: dot(normal, corner) };
  });
}

const within = (planes: Plane[], point: Point, slack: number): boolean =>
  planes.every(({ normal, distance }) => dot(normal, point) <= distance + slack);

function middleOf(loop: Point[]): Point {
  const sum = loop.reduce((total, corner) => total.map((value, i) => value + corner[i]));
  return scaled(sum, 1 / loop.length);
}

/// Direction of a round piece's surface: away from the line that it is round about.
function roundNormal(point: Point, [a, b]: [Point, Point]): Point {
  const along = difference(b, a);
  const length = dot(along, along);
  const share = length > 0 ? Math.min(1, Math.max(0, dot(difference(point, a), along) / length)) : 0;
  return normalized(difference(point, between(a, b, share)));
}

class Triangles {
  private readonly positions: number[] = [];
  private readonly normals: number[] = [];
  private readonly edges: number[] = [];

  /// A fan of a convex polygon around its middle. The attribute `edge` is 1 on an outer edge, 0 in the middle and all
  /// along edges that are no outline.
  add(loop: Point[], core: Piece["core"], outlined: (a: Point, b: Point) => boolean): void {
    const flat = loop[0].length === 2;
    const normal = flat ? [0, 0, 1] : normalOf(loop);
    const middle = middleOf(loop);
    for (let i = 0; i < loop.length; ++i) {
      const [a, b] = [loop[i], loop[(i + 1) % loop.length]];
      const at = (part: number): Point => between(a, b, part / edgeParts);
      const outer = Array.from({ length: edgeParts }, (_, part) => outlined(at(part), at(part + 1)));
      for (let from = 0, to = 0; from < edgeParts; from = to) {
        while (to < edgeParts && outer[to] === outer[from]) ++to;
        this.triangle([middle, at(from), at(to)], normal, flat ? undefined : core, outer[from] ? 1 : 0);
      }
    }
  }

  private triangle(corners: Point[], normal: Point, core: Piece["core"], edge: number): void {
    corners.forEach((corner, i) => {
      this.positions.push(corner[0], corner[1], corner[2] ?? 0);
      this.normals.push(...(core ? roundNormal(corner, core) : normal));
      this.edges.push(i === 0 ? 0 : edge);
    });
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(this.normals), 3));
    geometry.setAttribute("edge", new BufferAttribute(new Float32Array(this.edges), 1));
    return geometry;
  }
}

/// Triangles of a compound. Lines where two pieces meet are no outlines, nor are those of round faces in 3D.
export function geometryOf(pieces: Piece[]): BufferGeometry {
  const triangles = new Triangles();
  const planes = pieces.map(planesOf);
  const corners = pieces.flatMap((piece) => piece.loops.flat());
  const size = Math.max(...corners.map((corner) => Math.sqrt(dot(corner, corner))));
  pieces.forEach((piece, own) => {
    const smooth = piece.core !== undefined && piece.loops[0][0].length === 3;
    const outlined = (a: Point, b: Point): boolean => {
      if (smooth) return false;
      const middle = between(a, b, 0.5);
      return !planes.some((other, i) => i !== own && within(other, middle, 1e-3 * size));
    };
    for (const loop of piece.loops) triangles.add(loop, piece.core, outlined);
  });
  return triangles.geometry();
}
