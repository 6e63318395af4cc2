// Which layer of which pile.

import type { Layer, Pile, State } from "./moments";
import { poseValues } from "./pose";

/// The pile with the most bodies.
export function largest(piles: Pile[]): Pile | undefined {
  const bodies = (pile: Pile): number => pile.layers.reduce((sum, { count }) => sum + count, 0);
  return piles.reduce<Pile | undefined>((best, pile) => (best === undefined || bodies(pile) > bodies(best) ? pile : best), undefined);
}

/// The density above which a layer is too full.
export const fullest = ({ wake_density }: Layer): number => (wake_density > 0 ? wake_density : 1);

/// Layer in which the centre of a body lies, counted from the bottom; the first pile counts.
export function layerOf({ pose, piles }: State, dimension: 2 | 3, body: number): { pile: number; number: number; layer: Layer } | null {
  const at = pose.subarray(poseValues(dimension) * body);
  for (const [pile, { centre, layers }] of piles.entries()) {
    const height = at[dimension - 1] - centre[dimension - 1];
    const away = Math.hypot(...Array.from({ length: dimension - 1 }, (_, i) => at[i] - centre[i]));
    const number = layers.findIndex(({ bottom, top, radius }) => height >= bottom && height < top && away <= radius);
    if (number >= 0) return { pile, number, layer: layers[number] };
  }
  return null;
}
