// Pictures and films of what the page shows, with what one must know of it written below.

import type { Entry } from "./colourings";
import { css } from "./colours";
import { download, element } from "./element";
import type { Head } from "./head";
import { type Mark, paintLegend } from "./legend";

/// What is on one stage.
export interface Scenery {
  head: Head;
  /// Simulated [s].
  time: number;
  canvases: HTMLCanvasElement[];
  entries: Entry[];
  marks: Mark[];
}

const lineHeight = 20; // of the caption, and its margin [CSS pixels]
const margin = 14;

const nameOf = ({ head, time }: Scenery): string => `${head.name.replace(/\W+/g, "_")}_${time.toFixed(2)}_s`;

export const factsOf = ({ name, backend, policy, seed, version }: Head): string => [name, backend, `policy ${policy}`, `seed ${seed}`, version].filter((part) => part !== "").join(", ");

/// Draws them side by side; `resize`: on a canvas that gets the size of what is shown now.
function paint(canvas: HTMLCanvasElement, sides: Scenery[], resize: boolean): void {
  const { width, height, clientWidth } = sides[0].canvases[0];
  const unit = width / clientWidth;
  const paper = canvas.getContext("2d")!;
  const line = lineHeight * unit;
  const legend = ({ entries, marks, head }: Scenery, x: number): number => paintLegend(paper, [...entries, ...marks], { x, y: height + 2.6 * line, width: width - 2 * margin * unit, unit, line }, head.colours.text);
  if (resize) Object.assign(canvas, { width: sides.length * width, height: Math.ceil(height + (2.2 + Math.max(...sides.map((side) => legend(side, 0)))) * line) });
  sides.forEach((side, i) => {
    const { head, time, canvases } = side;
    const left = i * width;
    paper.fillStyle = css(head.colours.paper);
    paper.fillRect(left, 0, width, canvas.height);
    for (const each of canvases) paper.drawImage(each, left, 0);
    const put = (text: string, weight: string, y: number): void => {
      paper.font = `${weight} ${12 * unit}px system-ui, sans-serif`;
      paper.fillText(text, left + margin * unit, height + y * line, width - 2 * margin * unit);
    };
    paper.textBaseline = "middle";
    paper.fillStyle = css(head.colours.text);
    put(`${time.toFixed(2)} s   ${head.title}`, "600", 0.6);
    paper.fillStyle = css(head.colours.quiet_text);
    put(factsOf(head), "", 1.6);
    legend(side, left + margin * unit);
  });
}

/// The buttons for a picture and for a film; `sides`: what is shown now.
export function offerPictures(sides: () => Scenery[]): void {
  element("picture").addEventListener("click", () => {
    const canvas = document.createElement("canvas");
    const now = sides();
    paint(canvas, now, true);
    canvas.toBlob((blob) => blob && download(`${nameOf(now[0])}.png`, blob), "image/png");
  });
  let film: MediaRecorder | null = null;
  element("film").addEventListener("click", () => {
    if (film) return film.stop();
    film = filmOf(sides, () => (film = null));
  });
}

/// Begins a film of what is shown from now on; the user gets it when it is stopped.
function filmOf(sides: () => Scenery[], ended: () => void): MediaRecorder {
  const button = element("film");
  const canvas = document.createElement("canvas");
  paint(canvas, sides(), true);
  const film = new MediaRecorder(canvas.captureStream(30), { videoBitsPerSecond: 12e6 });
  const parts: Blob[] = [];
  const first = nameOf(sides()[0]);
  film.addEventListener("dataavailable", ({ data }) => parts.push(data));
  film.addEventListener("stop", () => {
    button.classList.remove("going");
    download(`${first}.webm`, new Blob(parts, { type: "video/webm" }));
    ended();
  });
  const draw = (): void => {
    if (film.state !== "recording") return;
    paint(canvas, sides(), false);
    requestAnimationFrame(draw);
  };
  film.start();
  button.classList.add("going");
  draw();
  return film;
}
