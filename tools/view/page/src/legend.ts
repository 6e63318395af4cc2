// The legend of what is drawn: on the page, and as pictures of the page have it.

import type { Entry } from "./colourings";
import { css, force, highlight, overfull } from "./colours";
import { element, make } from "./element";
import type { Rgb } from "./head";
import { repeats } from "./sides";
import type { Timeline } from "./timeline";

/// Something that is drawn beside the bodies.
export interface Mark extends Entry {
  line?: boolean;
}

/// What of all that could be drawn is.
export interface Drawn {
  layers: boolean;
  contacts: boolean;
  chosen: boolean;
}

export function marksOf({ head, state }: Timeline, { layers, contacts, chosen }: Drawn): Mark[] {
  const { colours } = head;
  const marks: Mark[] = [];
  if (head.obstacles.length > 0) marks.push({ colours: [colours.obstacle], text: "obstacles" });
  if (repeats(head.sides)) marks.push({ colours: [colours.ground], line: true, text: "periodic sides" });
  if (layers && state.piles.length > 0) marks.push({ colours: [colours.layer], line: true, text: "layers, with their density" });
  if (layers && state.piles.some((pile) => pile.layers.some(({ density, wake_density }) => wake_density > 0 && density > wake_density))) marks.push({ colours: [overfull], line: true, text: "too dense" });
  if (contacts) marks.push({ colours: force, text: "contacts, weak to strong" });
  if (chosen) marks.push({ colours: [highlight], text: "chosen body" });
  return marks;
}

const band = (colours: Rgb[]): string => `linear-gradient(to right, ${colours.map((each) => css(each)).join(", ")})`;

function swatch(colours: Rgb[], line = false): HTMLElement {
  const box = make("span", { className: line ? "swatch line" : "swatch" });
  box.style.background = colours.length > 1 ? band(colours) : css(colours[0]);
  return box;
}

export function showLegend(entries: Entry[], marks: Mark[]): void {
  element("counts").replaceChildren(
    ...entries.flatMap(({ colours, ends, count, text }) => [
      ...(ends ? [make("tr", {}, make("td", { colSpan: 3 }, ramp(colours, ends)))] : []),
      make("tr", {}, make("td", {}, ...(ends ? [] : colours.map((each) => swatch([each])))), make("td", { className: "count", textContent: count === undefined ? "" : String(count) }), make("td", { textContent: text })),
    ]),
  );
  element("drawn").replaceChildren(...listed(marks));
}

/// For a list in one line.
export const listed = (entries: Mark[]): HTMLElement[] => entries.map(({ colours, ends, count, text, line }) => make("li", {}, ...(ends ? [ramp(colours, ends)] : [swatch(colours, line)]), count === undefined ? text : `${text} ${count}`));

function ramp(colours: Rgb[], [low, high]: [string, string]): HTMLElement {
  const bar = make("span", { className: "band" });
  bar.style.background = band(colours);
  return make("span", { className: "ramp" }, make("small", { textContent: low }), bar, make("small", { textContent: high }));
}

/// Draws a legend on a picture from x on, in lines not longer than `width`. Returns how many
/// there are. All in pixels of the picture; `unit` of them are one of the page.
export function paintLegend(paper: CanvasRenderingContext2D, marks: Mark[], at: { x: number; y: number; width: number; unit: number; line: number }, text: Rgb): number {
  const { unit } = at;
  const [gap, band, box] = [5 * unit, 60 * unit, 10 * unit];
  paper.font = `${12 * unit}px system-ui, sans-serif`;
  paper.textBaseline = "middle";
  let [x, lines] = [0, 1];
  for (const { colours, ends, line, count, text: words } of marks) {
    const parts = [ends?.[0] ?? "", `${ends ? `${ends[1]} ` : ""}${words}${count === undefined ? "" : ` ${count}`}`];
    const whole = ends || line || count === undefined; // one box with all colours
    const boxes = whole ? [colours] : colours.map((each) => [each]);
    const size = ends ? band : box;
    const room = parts.reduce((sum, part) => sum + (part ? paper.measureText(part).width + gap : 0), boxes.length * (size + gap));
    if (x > 0 && x + room > at.width) [x, lines] = [0, lines + 1];
    const y = at.y + (lines - 1) * at.line;
    const put = (part: string): void => {
      if (!part) return;
      paper.fillStyle = css(text);
      paper.fillText(part, at.x + x, y);
      x += paper.measureText(part).width + gap;
    };
    put(parts[0]);
    for (const each of boxes) {
      const fill = paper.createLinearGradient(at.x + x, 0, at.x + x + size, 0);
      each.forEach((one, i) => fill.addColorStop(each.length > 1 ? i / (each.length - 1) : 0, css(one)));
      paper.fillStyle = fill;
      const height = line ? 2 * unit : box;
      paper.fillRect(at.x + x, y - height / 2, size, height);
      x += size + gap;
    }
    put(parts[1]);
    x += 2 * gap;
  }
  return lines;
}
