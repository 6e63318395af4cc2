// Periodic sides, beyond which a world repeats itself.

import type { Box, Point } from "./head";

/// Along each axis the lower side and how far the upper one lies above it [m], 0: the world does not repeat.
export interface Sides {
  low: Point;
  period: Point;
}

export const repeats = ({ period }: Sides): boolean => period.some((length) => length > 0);

/// The image of a place that is nearest to `reference` along each axis.
export const near = ({ period }: Sides, place: Point, reference: ArrayLike<number>): Point =>
  place.map((value, axis) => (period[axis] > 0 ? value - Math.round((value - reference[axis]) / period[axis]) * period[axis] : value));

/// From what fills a box to those of its images that are seen between the sides.
export function shiftsInside({ low, period }: Sides, box: Box): Point[] {
  let shifts: Point[] = [[]];
  low.forEach((side, axis) => {
    const seen = [0, 1, -1].filter((step) => period[axis] === 0 ? step === 0 : box[0][axis] + step * period[axis] < side + period[axis] && box[1][axis] + step * period[axis] > side);
    shifts = shifts.flatMap((shift) => seen.map((step) => [...shift, step * period[axis]]));
  });
  return shifts.filter((shift) => shift.some((length) => length !== 0));
}

/// The box, widened to reach from each side to the opposite one.
export function betweenSides({ low, period }: Sides, box: Box): Box {
  return [box[0].map((value, axis) => (period[axis] > 0 ? Math.min(value, low[axis]) : value)), box[1].map((value, axis) => (period[axis] > 0 ? Math.max(value, low[axis] + period[axis]) : value))];
}

/// Ends of lines: for each side its part in the box and between the other sides, a line in 2D, an outline in 3D.
export function outlinesOf({ low, period }: Sides, box: Box): Point[] {
  const up = low.length - 1;
  const within = box.map((corner, i) => corner.map((value, axis) => (period[axis] > 0 ? low[axis] + i * period[axis] : value)));
  return low.flatMap((_, axis) => {
    if (period[axis] === 0) return [];
    return within.flatMap((side) => {
      const corner = (far: number, high: number): Point => low.map((__, k) => (k === axis ? side[k] : k === up ? within[high][k] : within[far][k]));
      if (up === 1) return [corner(0, 0), corner(0, 1)];
      const loop = [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)];
      return loop.flatMap((point, i) => [point, loop[(i + 1) % 4]]);
    });
  });
}
