// The gates and regions of a scene: outlines with their readings beside them.

import { colour, css, onPaper } from "./colours";
import type { Head, Rgb } from "./head";
import type { Instruments, Region } from "./moments";
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, type Vector2, Vector3 } from "./vendor";

const corners = 48; // of a circle
const lineHeight = 16; // of the readings [CSS pixels]
const ball = 1; // talus_region.lcm
const layer = 2;

const tones: Rgb[] = [[0.0, 0.55, 0.5], [0.75, 0.35, 0.1], [0.5, 0.35, 0.75], [0.8, 0.2, 0.45], [0.3, 0.55, 0.15], [0.15, 0.45, 0.8]];

/// Of an instrument by its number among all: gates, then regions, then loads.
export const tone = (number: number): Rgb => onPaper(tones[number % tones.length]);

/// [N]
export const forceOf = (force: ArrayLike<number>): number => Math.hypot(...Array.from(force));

export const inDegrees = (angle: number): number => (angle * 180) / Math.PI;

type Place = [number, number, number];

export class InstrumentView {
  readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true, transparent: true, depthTest: false }));
  private drawn = false;

  constructor(private readonly head: Head) {
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 2;
  }

  /// Instruments stay where they are: the first readings have all that is drawn.
  update(instruments: Instruments | null): void {
    if (this.drawn || !instruments) return;
    this.drawn = true;
    const points: number[] = [];
    const tints: number[] = [];
    const add = (loops: Place[][], number: number, closed = true): void => {
      const tint = colour(tone(number));
      for (const loop of loops)
        for (let i = 0; i + (closed ? 0 : 1) < loop.length; ++i) {
          for (const point of [loop[i], loop[(i + 1) % loop.length]]) points.push(...this.onStage(point));
          tints.push(tint.r, tint.g, tint.b, tint.r, tint.g, tint.b);
        }
    };
    instruments.gates.forEach(({ outline }, i) => add([cornersOf(outline)], i, outline.length > 6));
    instruments.regions.forEach((region, i) => add(this.loopsOf(region), instruments.gates.length + i));
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3)).setAttribute("color", new BufferAttribute(new Float32Array(tints), 3));
  }

  drawLabels(paper: CanvasRenderingContext2D, instruments: Instruments | null, onScreen: (point: Vector3) => Vector2): void {
    if (!instruments) return;
    paper.font = "12px system-ui, sans-serif";
    paper.textBaseline = "middle";
    const written: { left: number; right: number; y: number }[] = [];
    const write = (at: Place, text: string, number: number): void => {
      const place = onScreen(new Vector3(...this.onStage(at)));
      const width = paper.measureText(text).width;
      const left = Math.max(4, Math.min(place.x, paper.canvas.clientWidth - width - 4));
      const right = left + width;
      let y = place.y - lineHeight / 2;
      const covers = (): boolean => written.some((other) => Math.abs(other.y - y) < lineHeight && other.left < right && other.right > left);
      while (covers()) y -= lineHeight / 4;
      written.push({ left, right, y });
      paper.fillStyle = css(this.head.colours.paper, 0.8);
      paper.fillRect(left - 3, y - lineHeight / 2, width + 6, lineHeight);
      paper.fillStyle = css(tone(number));
      paper.fillText(text, left, y);
    };
    instruments.gates.forEach(({ name, outline, forward, backward, jammed }, i) =>
      write(cornersOf(outline)[0], `${name}: ${forward - backward} passed${jammed ? ", jammed" : ""}`, i));
    instruments.regions.forEach((region, i) => {
      const [x, y, z] = region.low;
      const packing = region.packing >= 0 ? `, packing ${region.packing.toFixed(3)}` : "";
      const slope = region.slope >= 0 ? `, slope ${inDegrees(region.slope).toFixed(1)}\u00b0` : "";
      const at: Place = region.kind === ball ? [x - region.high[0], y, z] : region.kind === layer ? [this.head.box[0][0], 0, region.high[2]] : [x, y, region.high[2]];
      write(at, `${region.name}: ${region.bodies} bodies${packing}${slope}`, instruments.gates.length + i);
    });
  }

  /// Where a point (x, y, z) is drawn: the stage has height as y in 2D.
  private onStage([x, y, z]: Place): Place {
    return this.head.dimension === 2 ? [x, z, 0] : [x, y, z];
  }

  private loopsOf({ kind, low, high }: Region): Place[][] {
    if (kind === ball) return this.circlesOf(low, high[0]);
    const [from, to] = [Array.from(low), Array.from(high)];
    if (kind === layer) for (let i = 0; i + 1 < this.head.dimension; ++i) [from[i], to[i]] = [this.head.box[0][i], this.head.box[1][i]];
    const at = (x: number, y: number, z: number): Place => [[from, to][x][0], [from, to][y][1], [from, to][z][2]];
    if (this.head.dimension === 2) return [[at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)]];
    const level = (z: number): Place[] => [at(0, 0, z), at(1, 0, z), at(1, 1, z), at(0, 1, z)];
    return [level(0), level(1), ...level(0).map((point, i): Place[] => [point, level(1)[i]])];
  }

  /// About each axis across which the stage shows it.
  private circlesOf([x, y, z]: Float64Array, radius: number): Place[][] {
    const circle = (place: (cosine: number, sine: number) => Place): Place[] =>
      Array.from({ length: corners }, (_, i) => place(radius * Math.cos((2 * Math.PI * i) / corners), radius * Math.sin((2 * Math.PI * i) / corners)));
    const upright = circle((a, b) => [x + a, y, z + b]);
    return this.head.dimension === 2 ? [upright] : [upright, circle((a, b) => [x + a, y + b, z]), circle((a, b) => [x, y + a, z + b])];
  }
}

function cornersOf(outline: ArrayLike<number>): Place[] {
  return Array.from({ length: outline.length / 3 }, (_, i): Place => [outline[3 * i], outline[3 * i + 1], outline[3 * i + 2]]);
}
