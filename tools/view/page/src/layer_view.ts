// The layers of piles: outlines behind the bodies, with their densities beside them.

import { colour, css, mixed, overfull } from "./colours";
import type { Pile } from "./moments";
import type { Head } from "./head";
import { fullest } from "./pile_layers";
import { BufferAttribute, BufferGeometry, type Camera, LineBasicMaterial, LineSegments, type Vector2, Vector3 } from "./vendor";

const mostLayers = 32; // drawn of a pile; thinner ones would be lines only
const corners = 64; // of a circle

export class LayerView {
  readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));
  private drawn: Pile[] | null = null;

  constructor(private readonly head: Head) {
    this.lines.frustumCulled = false;
  }

  private flat(): boolean {
    return this.head.dimension === 2;
  }

  update(piles: Pile[]): void {
    if (this.drawn === piles) return;
    this.drawn = piles;
    const points: number[] = [];
    const tints: number[] = [];
    for (const pile of piles)
      for (const { layer, bottom, top, value } of coarse(pile)) {
        const { paper, layer: full } = this.head.colours;
        const most = fullest(pile.layers[layer]);
        const tint = colour(value > most ? overfull : mixed(paper, full, 0.25 + (0.75 * Math.max(0, value)) / most));
        const outline = this.flat() ? frame(pile, pile.layers[layer].radius, bottom, top) : circles(pile, pile.layers[layer].radius, [bottom, top]);
        points.push(...outline);
        for (let i = 0; i < outline.length; i += 3) tints.push(tint.r, tint.g, tint.b);
      }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3)).setAttribute("color", new BufferAttribute(new Float32Array(tints), 3));
  }

  drawLabels(paper: CanvasRenderingContext2D, piles: Pile[], camera: Camera, onScreen: (point: Vector3) => Vector2): void {
    paper.font = "12px system-ui, sans-serif";
    paper.textBaseline = "middle";
    const right = new Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
    const up = this.head.dimension - 1;
    let above = Infinity;
    for (const pile of piles) {
      for (const { layer, bottom, top, value, count, wakeDensity } of coarse(pile)) {
        if (count === 0) continue;
        const middle = new Vector3(...Array.from(pile.centre), 0).setComponent(up, pile.centre[up] + (bottom + top) / 2);
        if (this.flat()) middle.z = 0;
        const at = onScreen(middle.addScaledVector(right, pile.layers[layer].radius));
        if (Math.abs(above - at.y) < 13) continue;
        above = at.y;
        paper.lineWidth = 3;
        paper.strokeStyle = css(this.head.colours.paper, 0.85);
        paper.fillStyle = css(this.head.colours.layer);
        const text = wakeDensity >= 0 ? `${value.toFixed(2)} of ${wakeDensity.toFixed(2)}` : value.toFixed(2);
        if (wakeDensity >= 0 && value > wakeDensity) paper.fillStyle = css(overfull);
        const x = Math.min(at.x + 5, paper.canvas.clientWidth - paper.measureText(text).width - 4);
        paper.strokeText(text, x, at.y);
        paper.fillText(text, x, at.y);
      }
    }
  }
}

/// Ends of lines about a layer in 2D, behind the bodies.
function frame({ centre }: Pile, radius: number, bottom: number, top: number): number[] {
  const [left, right] = [centre[0] - radius, centre[0] + radius];
  const [low, high] = [centre[1] + bottom, centre[1] + top];
  const loop = [left, low, right, low, right, high, left, high, left, low];
  return [0, 2, 4, 6].flatMap((i) => [loop[i], loop[i + 1], -0.5, loop[i + 2], loop[i + 3], -0.5]);
}

function circles({ centre }: Pile, radius: number, heights: number[]): number[] {
  const at = (i: number, height: number): number[] => {
    const angle = (2 * Math.PI * i) / corners;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle), centre[2] + height];
  };
  return heights.flatMap((height) => Array.from({ length: corners }, (_, i) => [...at(i, height), ...at(i + 1, height)]).flat());
}

interface Slice {
  layer: number;
  bottom: number;
  top: number;
  value: number;
  count: number;
  wakeDensity: number;
}

/// At most mostLayers slices of a pile, neighbours put together.
function coarse(pile: Pile): Slice[] {
  const together = Math.max(1, Math.ceil(pile.layers.length / mostLayers));
  const slices = [];
  for (let layer = 0; layer < pile.layers.length; layer += together) {
    const end = Math.min(pile.layers.length, layer + together);
    let [count, capacity, wakeDensity] = [0, 0, pile.layers[layer].wake_density];
    for (let i = layer; i < end; ++i) {
      count += pile.layers[i].count;
      capacity += pile.layers[i].capacity;
      wakeDensity = Math.min(wakeDensity, pile.layers[i].wake_density);
    }
    const value = together === 1 ? pile.layers[layer].density : capacity > 0 ? count / capacity : 0;
    slices.push({ layer, bottom: pile.layers[layer].bottom, top: pile.layers[end - 1].top, value, count, wakeDensity });
  }
  return slices;
}
