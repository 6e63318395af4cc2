// The layers of piles: translucent slices with their densities beside them.

import { colour, css, overfull } from "./colours";
import type { Pile } from "./moments";
import type { Head } from "./head";
import { type Camera, CylinderGeometry, DoubleSide, Group, type Material, Mesh, MeshBasicMaterial, PlaneGeometry, type Vector2, Vector3 } from "./vendor";

const mostLayers = 32; // drawn of a pile; thinner ones would be lines only

export class LayerView {
  readonly group = new Group();
  private drawn: Pile[] | null = null;

  constructor(private readonly head: Head) {
    this.group.renderOrder = this.flat() ? -1 : 10;
  }

  private flat(): boolean {
    return this.head.dimension === 2;
  }

  update(piles: Pile[]): void {
    if (this.drawn === piles) return;
    this.drawn = piles;
    for (const child of this.group.children as Mesh[]) {
      child.geometry.dispose();
      (child.material as Material).dispose();
    }
    this.group.clear();
    for (const pile of piles) for (const slice of coarse(pile)) this.add(pile, slice);
  }

  private add(pile: Pile, { layer, bottom, top, value }: Slice): void {
    const { radius } = pile.layers[layer];
    const opacity = 0.1 + 0.22 * Math.min(1, Math.max(0, value));
    const material = new MeshBasicMaterial({ color: colour(this.head.colours.layer), transparent: true, opacity: (this.flat() ? 1 : 0.5) * opacity, depthWrite: false, side: DoubleSide });
    const mesh = this.flat()
      ? new Mesh(new PlaneGeometry(2 * radius, 0.97 * (top - bottom)), material)
      : new Mesh(new CylinderGeometry(radius, radius, 0.97 * (top - bottom), 48, 1, true).rotateX(0.5 * Math.PI), material);
    const height = (bottom + top) / 2;
    if (this.flat()) mesh.position.set(pile.centre[0], pile.centre[1] + height, -0.5); // behind the bodies
    else mesh.position.set(pile.centre[0], pile.centre[1], pile.centre[2] + height);
    this.group.add(mesh);
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
