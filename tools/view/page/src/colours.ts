// Colours of the page in its two themes, for three.js, canvases and style sheets.

import type { Rgb, Settings } from "./head";
import { Color, SRGBColorSpace } from "./vendor";

export type Colours = Settings["colours"] & {
  /// Bars of a plot where bodies woke.
  woken: Rgb;
};

export const colour = (rgb: Rgb): Color => new Color().setRGB(rgb[0], rgb[1], rgb[2], SRGBColorSpace);
export const css = (rgb: Rgb, alpha = 1): string => `rgb(${rgb.map((part) => Math.round(255 * part)).join(" ")} / ${alpha})`;
export const mixed = (a: Rgb, b: Rgb, share: number): Rgb => a.map((part, i) => part + share * (b[i] - part)) as Rgb;

/// Of layers that are denser than the policy allows, or than the bodies that fill them.
export const overfull: Rgb = [0.87, 0.27, 0.17];
/// Of the body that was chosen.
export const highlight: Rgb = [0.1, 0.5, 0.95];
/// Of contacts with a small and with a large force.
export const force: [Rgb, Rgb] = [[0.1, 0.75, 0.7], [0.85, 0.05, 0.5]];

/// From little to much, even steps to the eye and to the colour-blind (viridis).
export const ramp: Rgb[] = [
  [0.42, 0.27, 0.68],
  [0.231, 0.322, 0.545],
  [0.129, 0.569, 0.549],
  [0.369, 0.788, 0.384],
  [0.993, 0.906, 0.144],
];

/// Of a share in [0, 1].
export function onRamp(colours: Rgb[], share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (colours.length - 1);
  const low = Math.min(colours.length - 2, Math.floor(at));
  return mixed(colours[low], colours[low + 1], at - low);
}

const themes = matchMedia("(prefers-color-scheme: dark)");

/// Of a line or a text on the paper of the system's theme, from that on white.
export const onPaper = (rgb: Rgb): Rgb => (themes.matches ? mixed(rgb, [1, 1, 1], 0.4) : rgb);

/// Those of the system's theme; `light`: as in the pictures of the program.
export function themed(light: Settings["colours"]): Colours {
  if (!themes.matches) return { ...light, woken: [0.7, 0.36, 0.06] };
  return {
    ...light,
    paper: [0.075, 0.086, 0.106],
    text: [0.9, 0.91, 0.93],
    quiet_text: [0.64, 0.67, 0.72],
    asleep: [0.4, 0.43, 0.5],
    asleep_outline: [0.11, 0.12, 0.15],
    layer: [0.45, 0.68, 1],
    obstacle: [0.3, 0.33, 0.38],
    obstacle_outline: [0.6, 0.64, 0.7],
    ground: [0.6, 0.64, 0.7],
    woken: [1, 0.6, 0.25],
  };
}

export const onTheme = (changed: () => void): void => themes.addEventListener("change", changed);

/// Colour of a body by its number.
export type Paint = (body: number) => Rgb;
