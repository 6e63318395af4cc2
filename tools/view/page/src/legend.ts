// The legend of what is drawn: on the page, and as pictures of the page have it.

import type { Entry } from "./colourings";
import { css, force, highlight, overfull } from "./colours";
import { element, make } from "./element";
import type { Rgb } from "./head";
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

/// On a picture, in a line that begins at x; where it ends. Lengths in pixels of the picture, `unit` of them for one of the page.
export function paintLegend(paper: CanvasRenderingContext2D, entries: Entry[], marks: Mark[], x: number, y: number, unit: number, text: Rgb): number {
  paper.textBaseline = "middle";
  const put = (words: string): void => {
    paper.fillStyle = css(text);
    paper.fillText(words, x, y);
    x += paper.measureText(words).width + 6 * unit;
  };
  const box = (colours: Rgb[], width: number, height: number): void => {
    const fill = paper.createLinearGradient(x, 0, x + width, 0);
    colours.forEach((each, i) => fill.addColorStop(colours.length > 1 ? i / (colours.length - 1) : 0, css(each)));
    paper.fillStyle = fill;
    paper.fillRect(x, y - height / 2, width, height);
    x += width + 5 * unit;
  };
  for (const { colours, ends, count, text: words } of entries) {
    if (ends) put(ends[0]);
    if (ends) box(colours, 60 * unit, 10 * unit);
    else for (const each of colours) box([each], 10 * unit, 10 * unit);
    put(`${ends ? `${ends[1]} ` : ""}${words}${count === undefined ? "" : ` ${count}`}`);
    x += 8 * unit;
  }
  for (const { colours, line, text: words } of marks) {
    box(colours, 12 * unit, (line ? 2 : 10) * unit);
    put(words);
    x += 8 * unit;
  }
  return x;
}
