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

const captionHeight = 64; // [CSS pixels]

const nameOf = ({ head, time }: Scenery): string => `${head.name.replace(/\W+/g, "_")}_${time.toFixed(2)}_s`;

export const factsOf = ({ name, backend, policy, seed, version }: Head): string => [name, backend, `policy ${policy}`, `seed ${seed}`, version].filter((part) => part !== "").join(", ");

/// Draws them side by side; the canvas gets their size where it has none.
function paint(canvas: HTMLCanvasElement, sides: Scenery[], resize: boolean): void {
  const { width, height, clientWidth } = sides[0].canvases[0];
  const unit = width / clientWidth;
  if (resize) Object.assign(canvas, { width: sides.length * width, height: height + captionHeight * unit });
  const paper = canvas.getContext("2d")!;
  sides.forEach((side, i) => {
    const { head, time, canvases, entries, marks } = side;
    const left = i * width;
    paper.fillStyle = css(head.colours.paper);
    paper.fillRect(left, 0, width, canvas.height);
    for (const each of canvases) paper.drawImage(each, left, 0);
    const line = (number: number): number => height + (12 + 20 * number) * unit;
    const put = (text: string, font: string, y: number): void => {
      paper.font = `${font} ${12 * unit}px system-ui, sans-serif`;
      paper.fillText(text, left + 14 * unit, y, width - 28 * unit);
    };
    paper.textBaseline = "middle";
    paper.fillStyle = css(head.colours.text);
    put(`${time.toFixed(2)} s   ${head.title}`, "600", line(0));
    paper.fillStyle = css(head.colours.quiet_text);
    put(factsOf(head), "", line(1));
    paper.save();
    paper.beginPath();
    paper.rect(left, 0, width, canvas.height);
    paper.clip();
    paintLegend(paper, entries, marks, left + 14 * unit, line(2), unit, head.colours.text);
    paper.restore();
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
