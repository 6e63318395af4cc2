// What is known of a run before its first moment.

import { type Colours, themed } from "./colours";
import type { Layouts } from "./messages";
import type { EventMessage, MomentReader, ShapeMessage, State } from "./moments";
import { matrixOf, poseValues } from "./pose";
import { betweenSides, type Sides } from "./sides";
import { piecesOf } from "./surface";
import { Vector3 } from "./vendor";

export type Point = number[];
export type Rgb = [number, number, number];
export type Box = [Point, Point];

/// A convex piece: its polygons, and of a round one the ends of the line that it is round about.
export interface Piece {
  loops: Point[][];
  core?: [Point, Point];
}

export interface ShapeHead {
  name: string;
  /// That the scene gives it; null: by state.
  own: Rgb | null;
  index: number;
  /// D: diagonal of the box around it [m].
  extent: number;
  pieces: Piece[];
}

export interface ObstacleHead {
  name: string;
  pose: number[];
  pieces: Piece[];
}

/// What comes with the page, whatever the run (tools/view/page_settings.h).
export interface Settings extends Layouts {
  camera: { azimuth: number; elevation: number };
  colours: {
    paper: Rgb;
    text: Rgb;
    quiet_text: Rgb;
    asleep: Rgb;
    asleep_outline: Rgb;
    awake: Rgb[];
    awake_outline: Rgb;
    layer: Rgb;
    obstacle: Rgb;
    obstacle_outline: Rgb;
    ground: Rgb;
    /// How much darker sleeping bodies of a shape with a colour of its own are.
    sleep_shade: number;
  };
}

export interface Head extends Pick<Settings, "camera"> {
  /// Of the theme now, and of the light one.
  colours: Colours;
  light: Settings["colours"];
  title: string;
  name: string;
  backend: string;
  policy: string;
  version: string;
  seed: number;
  /// What of a record cannot be shown; empty: nothing is missing.
  damage: string;
  dimension: 2 | 3;
  dt: number;
  ground: { present: boolean; height: number };
  sides: Sides;
  /// What is to be seen at first.
  box: Box;
  /// Of policy `paper`: the score above which a body sleeps; below 0 of other policies.
  score_threshold: number;
  /// Of policy `adaptive`: how far a sleeping body may move once it is woken [D]; below 0 of other policies.
  tolerance: number;
  /// Of the scene, as far as they are known.
  events: EventMessage[];
  coloured_shapes: { name: string; colour: Rgb }[];
  shapes: ShapeHead[];
  obstacles: ObstacleHead[];
}

const manyBodies = 1500; // from so many bodies on, round shapes get fewer faces
const mostNames = 7; // colours that the legend names

const colourOf = (text: string): Rgb => [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16) / 255) as Rgb;

function extend(box: Box, point: Point): void {
  point.forEach((value, axis) => {
    box[0][axis] = Math.min(box[0][axis], value);
    box[1][axis] = Math.max(box[1][axis], value);
  });
}

const emptyBox = (axes: number): Box => [new Array<number>(axes).fill(Infinity), new Array<number>(axes).fill(-Infinity)];
const diagonal = ([low, high]: Box): number => Math.hypot(...low.map((value, axis) => high[axis] - value));

export function boundsOf(pieces: Piece[], pose: number[]): Box {
  const axes = pose.length === 3 ? 2 : 3;
  const box = emptyBox(axes);
  const matrix = matrixOf(pose);
  for (const corner of pieces.flatMap(({ loops }) => loops.flat())) extend(box, new Vector3(corner[0], corner[1], corner[2] ?? 0).applyMatrix4(matrix).toArray().slice(0, axes));
  return box;
}

const middlePose = (flat: boolean): number[] => (flat ? [0, 0, 0] : [0, 0, 0, 1, 0, 0, 0]);

function shapeHead(shape: ShapeMessage, flat: boolean, segments: number): ShapeHead {
  const pieces = piecesOf(shape, flat, segments);
  return { name: shape.name, own: shape.colour === "" ? null : colourOf(shape.colour), index: shape.index, extent: diagonal(boundsOf(pieces, middlePose(flat))), pieces };
}

/// Of bodies of a shape by their state.
export function colourOfState({ own, index }: ShapeHead, asleep: boolean, colours: Colours): Rgb {
  if (!asleep) return own ?? colours.awake[index % colours.awake.length];
  return own ? (own.map((part) => (1 - colours.sleep_shade) * part) as Rgb) : colours.asleep;
}

/// Shapes with colours of their own: each once, variants and sizes under the name that the scene gives them.
function colouredShapes(shapes: ShapeMessage[]): { name: string; colour: Rgb }[] {
  const named = new Map<string, Rgb>();
  for (const { name, colour } of shapes) {
    const plain = name.replace(/[#*].*/, "");
    if (colour !== "" && !named.has(plain) && named.size < mostNames) named.set(plain, colourOf(colour));
  }
  return Array.from(named, ([name, colour]) => ({ name, colour }));
}

export const obstaclesOf = ({ run, obstacles }: MomentReader): ObstacleHead[] =>
  obstacles.map((obstacle) => ({ name: obstacle.name, pose: Array.from(obstacle.pose.subarray(0, poseValues(run!.dimension))), pieces: piecesOf(obstacle, run!.dimension === 2, 48) }));

/// Of a run whose shapes are known; `box` is for boxOf().
export function headOf(reader: MomentReader, settings: Settings, name: string): Head {
  const { title, backend, policy, version, seed, dimension, dt, ground, ground_height, side, period, score_threshold, tolerance } = reader.run!;
  const inScene = (values: Float64Array): Point => [values[0], ...(dimension === 2 ? [] : [values[1]]), values[2]];
  const segments = reader.planned > manyBodies ? 12 : 24;
  return {
    ...{ title, name, backend, policy, version, seed, dimension, dt, score_threshold, tolerance },
    ...{ camera: settings.camera, light: settings.colours, colours: themed(settings.colours), damage: "", box: emptyBox(dimension), events: reader.sceneEvents },
    ground: { present: ground === 1, height: ground_height },
    sides: { low: inScene(side), period: inScene(period) },
    coloured_shapes: colouredShapes(reader.shapes),
    shapes: reader.shapes.map((shape) => shapeHead(shape, dimension === 2, segments)),
    obstacles: obstaclesOf(reader),
  };
}

/// What to show of a state: bodies within 1.5 times the width of the middle half of all and two bodies more, so that one
/// that was shot away does not make a dot of all others; obstacles unless they are much larger; all
/// between periodic sides.
export function boxOf({ dimension, shapes, obstacles, sides }: Head, { bodies, removed, pose, shape }: State): Box {
  const width = poseValues(dimension);
  const box = emptyBox(dimension);
  const present = Array.from({ length: bodies }, (_, body) => body).filter((body) => removed[body] === 0);
  const at = (body: number, axis: number): number => pose[width * body + axis];
  const reach = 2 * Math.max(0, ...shapes.map(({ extent }) => extent));
  const fences = Array.from({ length: dimension }, (_, axis) => {
    const values = present.map((body) => at(body, axis)).sort((a, b) => a - b);
    const [lower, upper] = [0.25, 0.75].map((share) => values[Math.round(share * (values.length - 1))] ?? 0);
    return { low: lower - 1.5 * (upper - lower) - reach, high: upper + 1.5 * (upper - lower) + reach };
  });
  const near = present.filter((body) => fences.every(({ low, high }, axis) => at(body, axis) >= low && at(body, axis) <= high));
  for (const body of near.length > 0 ? near : present)
    for (const side of [-0.5, 0.5]) extend(box, fences.map((_, axis) => at(body, axis) + side * shapes[shape[body]].extent));
  const size = box[0][0] <= box[1][0] ? diagonal(box) : 0;
  for (const obstacle of obstacles) {
    const bounds = boundsOf(obstacle.pieces, obstacle.pose);
    if (size === 0 || diagonal(bounds) < 2.5 * size) for (const corner of bounds) extend(box, corner);
  }
  if (box[0][0] > box[1][0]) for (const side of [-1, 1]) extend(box, fences.map(() => side));
  return betweenSides(sides, box);
}
