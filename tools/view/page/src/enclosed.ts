// Bodies that cannot be seen from outside of a pile.

import type { Head } from "./head";
import type { State } from "./moments";

const cover = 2; // a hidden body has so many full cells on each side
const range = 2 ** 17; // of cells along an axis

/// The cells that are enclosed along one axis: each of the neighbours on both sides, `step` away each, is full.
function eroded(cells: Set<number>, step: number, ground: number): Set<number> {
  const full = (cell: number): boolean => cells.has(cell) || cell % range < ground;
  const neighbours = Array.from({ length: cover }, (_, i) => (i + 1) * step).flatMap((away) => [away, -away]);
  return new Set([...cells].filter((cell) => neighbours.every((away) => full(cell + away))));
}

/// A body is hidden where it sleeps and so many bodies sleep around it that no line of sight reaches it. Space is cut into
/// cells as wide as the largest extent of a shape; a cell in which the centre of a sleeping body lies is full, and so is
/// every cell below the ground. A body is hidden where its cell and all cells up to two away from it, edges and corners
/// included, are full. In 2D none is hidden.
export class Enclosed {
  /// How many are hidden.
  hidden = 0;
  /// From so many bodies on some are hidden; below, all are drawn in no time.
  fewest = 20_000;
  private flags: Uint8Array = new Uint8Array();

  has(body: number): boolean {
    return this.flags[body] === 1;
  }

  /// Updates which bodies are hidden; returns those that became hidden or visible.
  update(state: State, head: Head): number[] {
    const before = this.flags;
    this.flags = this.find(state, head);
    this.hidden = this.flags.reduce((sum, flag) => sum + flag, 0);
    return Array.from({ length: state.bodies }, (_, body) => body).filter((body) => this.flags[body] !== (before[body] ?? 0));
  }

  private find({ bodies, asleep, removed, pose }: State, { dimension, shapes, ground }: Head): Uint8Array {
    const flags = new Uint8Array(bodies);
    if (dimension === 2 || bodies < this.fewest) return flags;
    const width = Math.max(...shapes.map(({ extent }) => extent));
    const level = ground.present ? ground.height : 0; // so that the ground lies between cells
    const index = (value: number): number => Math.min(range - cover - 1, Math.max(cover, Math.floor(value / width) + range / 2));
    const cellOf = (body: number): number => (index(pose[7 * body]) * range + index(pose[7 * body + 1])) * range + index(pose[7 * body + 2] - level);
    const sleepers = Array.from({ length: bodies }, (_, body) => body).filter((body) => asleep[body] === 1 && removed[body] === 0);
    let cells = new Set(sleepers.map(cellOf));
    for (const step of [1, range, range * range]) cells = eroded(cells, step, ground.present ? range / 2 : 0);
    for (const body of sleepers) if (cells.has(cellOf(body))) flags[body] = 1;
    return flags;
  }
}
