// Counts and layer densities over time.

import type { Pile } from "./moments";
import type { Head } from "./head";
import { css, overfull } from "./colours";
import { element } from "./element";
import type { Timeline } from "./timeline";
import { uPlot } from "./vendor";

const mostColumns = 800; // drawn of a density map

/// The pile with the most bodies.
export function largest(piles: Pile[]): Pile | undefined {
  const bodies = (pile: Pile): number => pile.layers.reduce((sum, { count }) => sum + count, 0);
  return piles.reduce<Pile | undefined>((best, pile) => (best === undefined || bodies(pile) > bodies(best) ? pile : best), undefined);
}

function shortened(text: string): string {
  return text.length > 40 ? `${text.slice(0, 39)}\u2026` : text;
}

/// How far plots reach: simulated time [s], bodies, time of a step [ms], height of the layers [m].
export interface Extent {
  time: number;
  bodies: number;
  ms: number;
  top: number;
}

const most = (values: (number | null)[]): number => values.reduce<number>((high, value) => Math.max(high, value ?? 0), 0);

export class Plots {
  private readonly counts: uPlot;
  private readonly densities: uPlot;
  private readonly heads: HTMLElement[];
  private readonly resizes = new ResizeObserver(() => this.resize());
  private frames = 0;
  private piled = false; // whether the run has had a pile
  private time = 0;
  private atLeast: Extent = { time: 0, bodies: 0, ms: 0, top: 0 };

  /// `timed`: the frames come with the wall time of a step. `seek` is called with a time where the user clicks.
  constructor(
    private readonly parent: HTMLElement,
    private readonly head: Head,
    private readonly timeline: Timeline,
    private readonly timed: boolean,
    seek: (time: number) => void,
  ) {
    for (const [name, colour] of [["awake", head.colours.awake[1]], ["layer", head.colours.layer], ["dense", overfull]] as const)
      document.querySelectorAll<HTMLElement>(`#caption .${name}`).forEach((text) => (text.style.color = css(colour)));
    const speed: uPlot.Series = { ...this.series("ms a step", css(head.colours.layer), 1), scale: "ms" };
    this.counts = this.plot(
      [
        this.series("awake", css(head.colours.awake[1]), 2),
        this.series("asleep", css(head.colours.asleep), 1.5),
        { label: "woken", auto: false, stroke: css(head.colours.awake_outline), fill: css(head.colours.awake_outline, 0.6), paths: uPlot.paths.bars!({ size: [1, 3] }), points: { show: false } },
        ...(timed ? [speed] : []),
      ],
      "bodies",
      { draw: [(plot: uPlot) => this.drawEvents(plot)] },
    );
    this.densities = this.plot([this.series("", "transparent", 0)], "layers [m]", { drawAxes: [(plot: uPlot) => this.drawDensities(plot)] });
    this.heads = [this.counts, this.densities].map((plot) => {
      const line = document.createElement("div");
      line.className = "playhead";
      plot.over.append(line);
      let down = 0;
      plot.over.addEventListener("mousedown", (event) => (down = event.clientX));
      plot.over.addEventListener("mouseup", (event) => {
        if (Math.abs(event.clientX - down) < 3) seek(plot.posToVal(event.offsetX, "x"));
      });
      return line;
    });
    this.resizes.observe(parent);
    this.refresh();
  }

  /// Takes them off the page.
  dispose(): void {
    this.resizes.disconnect();
    for (const plot of [this.counts, this.densities]) plot.destroy();
  }

  private series(label: string, stroke: string, width: number): uPlot.Series {
    return { label, stroke, width, points: { show: false } };
  }

  private plot(series: uPlot.Series[], label: string, hooks: uPlot.Hooks.Arrays): uPlot {
    const speed = series.some(({ scale }) => scale === "ms");
    const axis = { stroke: css(this.head.colours.quiet_text), grid: { stroke: "#0001" }, font: "11px system-ui", labelFont: "11px system-ui" };
    return new uPlot(
      {
        width: 400,
        height: 120,
        series: [{ label: "s" }, ...series],
        scales: { x: { time: false }, y: { range: (_, __, high) => [0, Math.max(1, high, label === "bodies" ? this.atLeast.bodies : this.atLeast.top)] }, ms: { range: (_, __, high) => [0, Math.max(high, this.atLeast.ms) || 1] } },
        axes: [
          { ...axis, size: 26, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
          { ...axis, label, labelSize: 16, size: 40, space: 18 },
          ...(speed ? [{ ...axis, scale: "ms", side: 1 as const, grid: { show: false }, label: "ms a step", labelSize: 16, size: 44 }] : []),
        ],
        padding: [null, this.timed && !speed ? 60 : null, null, null], // both plots have the same time line
        legend: { show: false },
        cursor: { sync: { key: "talus" }, points: { show: false }, drag: { x: true, y: false } },
        hooks,
      },
      [[], ...series.map(() => [])],
      this.parent,
    );
  }

  private resize(): void {
    const width = this.parent.clientWidth;
    const height = Math.max(60, Math.floor(this.parent.clientHeight / (this.piled ? 2 : 1)));
    this.densities.root.hidden = !this.piled;
    element("of-layers").hidden = element("layers").parentElement!.hidden = !this.piled;
    if (width > 0) for (const plot of [this.counts, this.densities]) plot.setSize({ width, height });
    queueMicrotask(() => this.showTime(this.time)); // uPlot takes the new size over in a microtask of its own
  }

  extent(): Extent {
    const { timeline } = this;
    const time = timeline.frames > 0 ? timeline.time(timeline.frames - 1) : 0;
    return { time, bodies: most([...timeline.awake, ...timeline.asleep]), ms: this.timed ? most(timeline.msPerStep) : 0, top: most(this.tops()) };
  }

  /// The plots reach at least so far from now on.
  reach(extent: Extent): void {
    const { time, bodies, ms, top } = this.atLeast;
    if (time === extent.time && bodies === extent.bodies && ms === extent.ms && top === extent.top) return;
    this.atLeast = extent;
    this.draw();
  }

  private tops(): number[] {
    return this.timeline.piles.map((piles) => largest(piles)?.layers.at(-1)?.top ?? 0);
  }

  /// Takes in the frames that came since the last call.
  refresh(): void {
    const { timeline } = this;
    if (this.frames === timeline.frames) return;
    this.frames = timeline.frames;
    this.draw();
  }

  private draw(): void {
    const { timeline } = this;
    const series = [timeline.awake, timeline.asleep, timeline.woken, ...(this.timed ? [timeline.msPerStep] : [])];
    const [time, ...lines] = this.withGaps([timeline.step.map((step) => step * this.head.dt), ...series]);
    this.counts.setData([time as number[], ...lines]);
    const [times, top] = this.withGaps([timeline.step.map((step) => step * this.head.dt), this.tops()]);
    this.densities.setData([times as number[], top]);
    const piled = timeline.piles.some((piles) => piles.length > 0);
    if (piled !== this.piled) {
      this.piled = piled;
      this.resize();
    }
    this.showScale();
    queueMicrotask(() => this.showTime(this.time)); // uPlot takes the new range over in a microtask of its own
  }

  /// The columns with an empty place wherever frames are missing, which no line crosses, and at both ends where plots of
  /// two runs reach farther.
  private withGaps(columns: (number | null)[][]): (number | null)[][] {
    const { timeline } = this;
    const result: (number | null)[][] = columns.map(() => []);
    const put = (values: (number | null)[]): void => values.forEach((value, column) => result[column].push(value));
    const nothing = (time: number): (number | null)[] => columns.map((_, column) => (column === 0 ? time : null));
    if (this.atLeast.time > 0) put(nothing(0));
    for (let frame = 0; frame < timeline.frames; ++frame) {
      if (timeline.lacksBefore(frame)) put(nothing((timeline.time(frame - 1) + timeline.time(frame)) / 2));
      put(columns.map((column) => column[frame]));
    }
    if (this.atLeast.time > (columns[0].at(-1) ?? 0)) put(nothing(this.atLeast.time));
    return result;
  }

  /// What red means in the map of densities.
  private showScale(): void {
    const { timeline } = this;
    const layer = largest(timeline.piles[timeline.frames - 1] ?? [])?.layers[0];
    const wakes = layer !== undefined && layer.wake_density > 0;
    const thresholds = wakes ? `the threshold of ${layer.wake_density.toFixed(2)}, above which the pile wakes; up to ${layer.sleep_density.toFixed(2)} no body of a layer falls asleep` : "";
    element("density-scale").replaceChildren("blue", wakes ? ` up to ${thresholds}` : " up to 1");
  }

  /// Moves the line of the time shown.
  showTime(time: number): void {
    this.time = time;
    if (this.timeline.shown < 0) return;
    const at = Math.min(this.counts.over.clientWidth, this.counts.valToPos(time, "x"));
    for (const line of this.heads) line.style.left = `${at}px`;
  }

  /// A line with its text where an event of the scene happened or a warning came first.
  private drawEvents(plot: uPlot): void {
    const paper = plot.ctx;
    paper.save();
    paper.font = `${Math.round(11 * devicePixelRatio)}px system-ui`;
    paper.textAlign = "left";
    paper.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    const { timeline } = this;
    const ends: number[] = new Array<number>(3).fill(-Infinity); // of the texts in each row
    const warnings = [...timeline.warnings.values()].map(({ step, text }) => ({ time: step * this.head.dt, text: shortened(text), warns: true }));
    const events = timeline.happened.map((event) => ({ time: event.time, text: timeline.textOf(event), warns: false }));
    for (const { time, text, warns } of [...events, ...warnings].sort((a, b) => a.time - b.time)) {
      paper.strokeStyle = paper.fillStyle = css(warns ? overfull : this.head.colours.text);
      const left = plot.valToPos(time, "x", true);
      if (left < plot.bbox.left || left > plot.bbox.left + plot.bbox.width) continue;
      paper.beginPath();
      paper.moveTo(left, plot.bbox.top);
      paper.lineTo(left, plot.bbox.top + plot.bbox.height);
      paper.stroke();
      const width = paper.measureText(text).width + 8 * devicePixelRatio;
      const fits = left + width < plot.bbox.left + plot.bbox.width;
      const begin = fits ? left + 4 * devicePixelRatio : left - width + 4 * devicePixelRatio;
      const row = ends.findIndex((end) => end < begin);
      if (row < 0) continue; // no room: the line stands for it
      ends[row] = begin + width;
      paper.fillText(text, begin, plot.bbox.top + (12 + 13 * row) * devicePixelRatio);
    }
    paper.restore();
  }

  /// Time from left to right, layers from bottom to top, dark where dense.
  private drawDensities(plot: uPlot): void {
    const { timeline } = this;
    const paper = plot.ctx;
    paper.save();
    paper.beginPath();
    paper.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
    paper.clip();
    const each = Math.max(1, Math.ceil(timeline.frames / mostColumns));
    for (let frame = 0; frame < timeline.frames; frame += each) {
      const pile = largest(timeline.piles[frame]);
      if (!pile) continue;
      const pixel = (value: number, scale: string): number => Math.round(plot.valToPos(value, scale, true));
      const left = pixel(timeline.time(frame), "x");
      const next = Math.min(timeline.frames - 1, frame + each);
      const right = timeline.lacksBefore(next) ? left + 1 : pixel(timeline.time(next), "x");
      pile.layers.forEach((layer) => {
        const value = layer.density;
        if (value <= 0) return;
        const top = pixel(layer.top, "y");
        const most = layer.wake_density > 0 ? layer.wake_density : 1;
        paper.fillStyle = value > most ? css(overfull, Math.min(1, 0.4 + 0.5 * (value / most - 1))) : css(this.head.colours.layer, (0.9 * value) / most);
        paper.fillRect(left, top, Math.max(1, right - left), pixel(layer.bottom, "y") - top);
      });
    }
    paper.restore();
  }
}
