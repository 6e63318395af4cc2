// Colours of the run's head, for three.js and for style sheets.

import type { Rgb } from "./head";
import { Color, SRGBColorSpace } from "./vendor";

export const colour = (rgb: Rgb): Color => new Color().setRGB(rgb[0], rgb[1], rgb[2], SRGBColorSpace);
export const css = (rgb: Rgb, alpha = 1): string =>
  `rgb(${rgb.map((part) => Math.round(255 * part)).join(" ")} / ${alpha})`;

/// Of layers that are denser than the policy allows, or than the bodies that fill them.
export const overfull: Rgb = [0.8, 0.25, 0.15];

/// Colour of a body by its number.
export type Paint = (body: number) => Rgb;
