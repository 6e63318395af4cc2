// Numbers of one run or of two over one time axis, and the densities of layers.

import { css, overfull } from "./colours";
import { element, make } from "./element";
import type { Rgb } from "./head";
import { forceOf, inDegrees, tone } from "./instrument_view";
import type { Instruments, Region } from "./moments";
import { fullest, largest } from "./pile_layers";
import { niceLength } from "./scale";
import type { Timeline } from "./timeline";
import { uPlot } from "./vendor";

const mostColumns = 800; // drawn of a density map
const axisHeight = 20; // [CSS pixels] of the time axis, which the lowest row has
const namesHeight = 14; // [CSS pixels] of the names above the lines
const roomForThree = 36; // [CSS pixels] height in which an axis has room for three numbers
const gutter = 44; // [CSS pixels] left of all rows, so that they have one time axis

type Column = (number | null)[];

/// A series of numbers by frame.
export interface Line {
  label: string;
  colour: Rgb;
  values: Column;
  bars?: boolean;
}

/// A plot of a row: lines of one unit, or a map of the layers' densities.
interface Row {
  name: string;
  unit: string;
  lines: (timeline: Timeline) => Line[];
  map?: boolean;
  /// Shown unless the user chooses otherwise.
  usual: boolean;
}

const counts: Row = {
  name: "bodies",
  unit: "bodies",
  usual: true,
  lines: ({ head: { colours }, awake, asleep, woken }) => [
    { label: "awake", colour: colours.awake[0], values: awake },
    { label: "asleep", colour: colours.asleep, values: asleep },
    { label: "woken", colour: colours.woken, values: woken, bars: true },
  ],
};
const layers: Row = { name: "layers", unit: "m", usual: true, map: true, lines: ({ head, piles }) => [{ label: "height", colour: head.colours.layer, values: piles.map((all) => largest(all)?.layers.at(-1)?.top ?? 0) }] };
const stepTime: Row = { name: "step time", unit: "ms", usual: false, lines: ({ head, msPerStep }) => [{ label: "wall time of a step", colour: head.colours.layer, values: msPerStep }] };
/// A line for each gate, region or load.
const instrumentLines = (timeline: Timeline, of: (all: Instruments) => { name: string; value: number | null }[], first: (all: Instruments) => number): Line[] => {
  const newest = timeline.instruments.at(-1);
  if (!newest) return [];
  return of(newest).map(({ name }, i) => ({ label: name, colour: tone(first(newest) + i), values: timeline.instruments.map((all) => (all && of(all)[i]?.value) ?? null) }));
};
const passed: Row = {
  name: "gates",
  unit: "passed",
  usual: true,
  lines: (timeline) => instrumentLines(timeline, ({ gates }) => gates.map(({ name, forward, backward }) => ({ name, value: forward - backward })), () => 0),
};
const regionLines = (timeline: Timeline, of: (region: Region) => number): Line[] =>
  instrumentLines(timeline, ({ regions }) => regions.map((region) => ({ name: region.name, value: of(region) >= 0 ? of(region) : null })), ({ gates }) => gates.length);
const packing: Row = { name: "packing", unit: "packing", usual: true, lines: (timeline) => regionLines(timeline, (region) => region.packing) };
const slope: Row = { name: "slope", unit: "degrees", usual: true, lines: (timeline) => regionLines(timeline, (region) => inDegrees(region.slope)) };
const loads: Row = {
  name: "loads",
  unit: "N",
  usual: true,
  lines: (timeline) => instrumentLines(timeline, ({ loads: all }) => all.map(({ name, known, force }) => ({ name, value: known ? forceOf(force) : null })), ({ gates, regions }) => gates.length + regions.length),
};
const rows = [counts, layers, passed, packing, slope, loads, stepTime];

export interface PlottedRun {
  timeline: Timeline;
  /// What tells it from the other one; empty: there is only one.
  name: string;
}

/// Fits beside an axis: 250, 0.05, 20k, 1.5M.
const brief = (value: number): string => {
  const power = value >= 1e6 ? 6 : value >= 1e4 ? 3 : 0;
  return `${Number((value / 10 ** power).toPrecision(3))}${power === 6 ? "M" : power === 3 ? "k" : ""}`;
};
const shortened = (text: string): string => (text.length > 40 ? `${text.slice(0, 39)}\u2026` : text);

/// A row as it is on the page.
interface Drawn {
  row: Row;
  runs: PlottedRun[];
  plot: uPlot;
  head: HTMLElement;
}

export class Plots {
  private drawn: Drawn[] = [];
  private readonly resizes = new ResizeObserver(() => this.resize());
  private readonly hint = make("div", { className: "hover", hidden: true });
  /// Frames of each run, and which rows can be shown, when last drawn.
  private known = "";
  private offered = "";
  private time = 0;
  private zooming = false;
  private zoomed: [number, number] | null = null;
  /// Names of the rows that the user has switched away from what is usual.
  private switched: Set<string>;

  /// `seek` is called with a time where the user clicks; `shown`: names of the rows to show, null: the usual ones.
  constructor(
    private readonly parent: HTMLElement,
    private readonly runs: PlottedRun[],
    private readonly seek: (time: number) => void,
    shown: string | null = null,
  ) {
    const wanted = shown?.split(",");
    this.switched = new Set(wanted ? rows.filter(({ name, usual }) => usual !== wanted.includes(name)).map(({ name }) => name) : []);
    this.resizes.observe(parent);
    this.refresh();
  }

  /// Takes them off the page.
  dispose(): void {
    this.resizes.disconnect();
    this.clear();
  }

  private clear(): void {
    for (const { plot } of this.drawn) plot.destroy();
    this.drawn = [];
    this.parent.replaceChildren();
  }

  /// Names of the rows shown, for an address; null: the usual ones.
  get shown(): string | null {
    return this.switched.size === 0 ? null : rows.filter((row) => this.wants(row)).map(({ name }) => name).join(",");
  }

  private wants({ name, usual }: Row): boolean {
    return usual !== this.switched.has(name);
  }

  /// Whether there is anything to draw: no plot is empty.
  private has(row: Row, { timeline }: PlottedRun): boolean {
    if (timeline.frames === 0) return false;
    if (row.map) return timeline.piles.some((piles) => piles.length > 0);
    return row.lines(timeline).some(({ values }) => values.some((value) => value !== null));
  }

  /// Takes in the frames that came since the last call.
  refresh(): void {
    const known = this.runs.map(({ timeline }) => timeline.frames).join();
    if (this.known === known) return;
    this.known = known;
    this.layOut();
    this.draw();
  }

  /// Makes the rows where others are to be shown than those that are there.
  private layOut(): void {
    const able = rows.filter((row) => this.runs.some((run) => this.has(row, run)));
    const wanted = able
      .filter((row) => this.wants(row))
      .flatMap((row) => (row.map ? this.runs.filter((run) => this.has(row, run)).map((run) => ({ row, runs: [run] })) : [{ row, runs: this.runs }]));
    const same = wanted.length === this.drawn.length && wanted.every(({ row, runs }, i) => this.drawn[i].row === row && this.drawn[i].runs[0] === runs[0]);
    this.offer(able);
    if (same) return;
    this.clear();
    this.drawn = wanted.map(({ row, runs }, i) => this.make(row, runs, i + 1 === wanted.length));
    this.parent.append(this.hint);
    this.resize();
  }

  /// Buttons that switch the rows; the same ones as long as nothing changes, since a button that is replaced takes no click.
  private offer(able: Row[]): void {
    const offered = able.map((row) => `${row.name} ${this.wants(row)}`).join();
    if (this.offered === offered) return;
    this.offered = offered;
    element("rows").replaceChildren(
      ...able.map((row) => {
        const button = make("button", { textContent: row.name, title: `Plot of ${row.name}`, onclick: () => this.switch(row) });
        button.setAttribute("aria-pressed", String(this.wants(row)));
        return button;
      }),
    );
  }

  private switch({ name }: Row): void {
    if (!this.switched.delete(name)) this.switched.add(name);
    this.layOut();
    this.draw();
  }

  private make(row: Row, runs: PlottedRun[], last: boolean): Drawn {
    const box = make("div", { className: "plot" });
    this.parent.append(box);
    const { colours } = this.runs[0].timeline.head;
    const axis = { stroke: css(colours.quiet_text), grid: { stroke: css(colours.text, 0.08), width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    const lines = runs.flatMap((run, i) => row.lines(run.timeline).map((line) => ({ ...line, dashed: i > 0 })));
    const plot = new uPlot(
      {
        width: 400,
        height: 60,
        series: [{}, ...lines.map(({ label, colour, bars, dashed }) => (row.map ? { label } : { label, stroke: css(colour), width: 1.5, points: { show: false }, ...(dashed ? { dash: [5, 3] } : {}), ...(bars ? { auto: false, fill: css(colour, dashed ? 0.25 : 0.7), width: 0, paths: uPlot.paths.bars!({ size: [1, 3] }) } : {}) }))],
        scales: { x: { time: false }, y: { range: (_, __, high) => [0, 1.05 * Math.max(row === counts ? 1 : 1e-3, high)] } },
        axes: [
          { ...axis, show: last, size: axisHeight, gap: 6, values: (_, ticks) => ticks.map((tick) => `${Number(tick.toPrecision(6))} s`) },
          { ...axis, size: gutter, gap: 4, splits: ({ bbox }, _, __, high) => (bbox.height < roomForThree * devicePixelRatio ? [0, niceLength(high)] : [0, niceLength(high) / 2, niceLength(high)]), values: (_, ticks) => ticks.map(brief) },
        ],
        padding: [namesHeight, 16, last ? 0 : 4, 0],
        legend: { show: false },
        cursor: { sync: { key: "talus" }, points: { show: false }, drag: { x: true, y: false }, y: false },
        hooks: {
          drawAxes: row.map ? [(self: uPlot) => drawDensities(self, runs[0].timeline)] : [],
          draw: row.map ? [] : [(self: uPlot) => this.drawEvents(self, runs[0].timeline)],
          setScale: [(self: uPlot, key: string) => key === "x" && this.zoom(self)],
          setCursor: [(self: uPlot) => this.showHint(self)],
        },
      },
      [[], ...lines.map(() => [])],
      box,
    );
    const head = make("div", { className: "playhead" });
    plot.over.append(head);
    box.append(this.legend(row, runs));
    let down = 0;
    plot.over.addEventListener("mousedown", (event) => (down = event.clientX));
    plot.over.addEventListener("mouseup", (event) => Math.abs(event.clientX - down) < 3 && this.seek(plot.posToVal(event.offsetX, "x")));
    plot.over.addEventListener("dblclick", () => this.zoomTo(null));
    plot.over.addEventListener("mouseleave", () => (this.hint.hidden = true));
    return { row, runs, plot, head };
  }

  /// Names and colours of the lines, or the scale of densities.
  private legend(row: Row, runs: PlottedRun[]): HTMLElement {
    const { timeline, name } = runs[0];
    const legend = make("div", { className: "names" });
    const unit = row.map ? "layers [m]\u00a0\u00a0" : row === counts ? "bodies" : `[${row.unit}]`;
    legend.append(unit);
    if (row.map) {
      const { layer: full } = timeline.head.colours;
      const layer = largest(timeline.piles[timeline.frames - 1] ?? [])?.layers[0];
      const most = layer ? fullest(layer) : 1;
      const bar = make("i", { className: "scale" });
      bar.style.background = `linear-gradient(to right, ${css(full, 0)}, ${css(full, 0.9)} 66%, ${css(overfull, 0.5)} 66%, ${css(overfull)})`;
      legend.append(`density ${name} 0`, bar, most === 1 ? "> 1" : `> ${most.toFixed(2)}: the pile wakes`);
      return legend;
    }
    for (const { label, colour } of row.lines(timeline)) {
      const mark = make("i", {});
      mark.style.color = css(colour);
      legend.append(mark, label);
    }
    if (runs.length > 1) legend.append(`\u00a0(${name}; dashed: ${runs[1].name})`);
    return legend;
  }

  private resize(): void {
    const width = this.parent.clientWidth;
    const height = Math.floor((this.parent.clientHeight - axisHeight) / Math.max(1, this.drawn.length));
    this.parent.classList.toggle("bare", this.drawn.length === 0);
    this.parent.style.setProperty("--rows", String(this.drawn.length));
    if (width > 0) this.drawn.forEach(({ plot }, i) => plot.setSize({ width, height: Math.max(24, height) + (i + 1 === this.drawn.length ? axisHeight : 0) }));
    queueMicrotask(() => this.showTime(this.time)); // uPlot takes the new size over in a microtask of its own
  }

  private draw(): void {
    for (const { row, runs, plot } of this.drawn) {
      const tables = runs.map(({ timeline }) => withGaps(timeline, [timeline.step.map((step) => step * timeline.head.dt), ...row.lines(timeline).map(({ values }) => values)]));
      plot.setData((tables.length > 1 ? uPlot.join(tables as uPlot.AlignedData[]) : tables[0]) as uPlot.AlignedData, this.zoomed === null);
      if (this.zoomed === null) this.showAll(plot);
      else plot.redraw();
    }
    queueMicrotask(() => this.showTime(this.time)); // uPlot takes the new range over in a microtask of its own
  }

  private get end(): number {
    return Math.max(...this.runs.map(({ timeline }) => (timeline.frames > 0 ? timeline.time(timeline.frames - 1) : 0)), 1e-3);
  }

  /// From the start, or the first frame where that comes much later, to the last frame of all runs.
  private showAll(plot: uPlot): void {
    this.zooming = true;
    const first = Math.min(...this.runs.map(({ timeline }) => (timeline.frames > 0 ? timeline.time(0) : 0)));
    plot.setScale("x", { min: first < 0.05 * this.end ? 0 : first, max: this.end });
    this.zooming = false;
  }

  /// The user has chosen a range in one plot: all have it.
  private zoom(plot: uPlot): void {
    if (this.zooming) return;
    const { min, max } = plot.scales.x;
    if (min === undefined || max === undefined || min === null || max === null || (this.zoomed && this.zoomed[0] === min && this.zoomed[1] === max)) return;
    if (plot.select.width > 0) this.zoomTo([min, max]);
  }

  private zoomTo(range: [number, number] | null): void {
    this.zoomed = range;
    this.zooming = true;
    for (const { plot } of this.drawn) range ? plot.setScale("x", { min: range[0], max: range[1] }) : this.showAll(plot);
    this.zooming = false;
    this.showTime(this.time);
    queueMicrotask(() => this.showTime(this.time));
  }

  /// Moves the line of the time shown.
  showTime(time: number): void {
    this.time = time;
    for (const { plot, head } of this.drawn) {
      const at = plot.valToPos(time, "x");
      head.hidden = !(at >= -1 && at <= plot.over.clientWidth + 1);
      head.style.left = `${at}px`;
    }
  }

  /// Beside the cursor, time and values of all rows.
  private showHint(plot: uPlot): void {
    const { left = -1, top = -1, event } = plot.cursor;
    if (!event || left < 0) return; // the cursor of another row, which tells
    const time = plot.posToVal(left, "x");
    const texts: HTMLElement[] = [make("b", { textContent: `${time.toFixed(2)} s` })];
    for (const { row, runs, plot: own } of this.drawn)
      for (const { timeline, name } of runs) {
        const frame = timeline.frameAt(time);
        for (const { label, colour, values } of row.lines(timeline)) {
          const value = values[frame];
          const mark = make("i", {});
          mark.style.color = css(colour);
          if (value !== null) texts.push(make("span", {}, mark, `${label} ${name} ${Number(value.toPrecision(4))} ${row === counts ? "" : row.unit}`));
        }
        const layer = row.map && own === plot ? largest(timeline.piles[frame])?.layers.find(({ bottom, top: above }) => plot.posToVal(top, "y") >= bottom && plot.posToVal(top, "y") < above) : undefined;
        if (layer) texts.push(make("span", { textContent: `density here ${layer.density.toFixed(2)}, ${layer.count} bodies` }));
      }
    this.hint.replaceChildren(...texts);
    this.hint.hidden = false;
    const at = gutter + left;
    this.hint.style.left = `${at + 14 + this.hint.offsetWidth < this.parent.clientWidth ? at + 14 : at - 14 - this.hint.offsetWidth}px`;
  }

  /// A line with its text where an event of the scene happened or a warning came first.
  private drawEvents(plot: uPlot, timeline: Timeline): void {
    if (plot !== this.drawn[0]?.plot) return;
    const paper = plot.ctx;
    const { head } = timeline;
    paper.save();
    paper.font = `${Math.round(11 * devicePixelRatio)}px system-ui, sans-serif`;
    paper.textAlign = "left";
    paper.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    const ends: number[] = new Array<number>(2).fill(-Infinity); // of the texts in each row
    const warnings = [...timeline.warnings.values()].map(({ step, text }) => ({ time: step * head.dt, text: shortened(text), warns: true }));
    const events = timeline.happened.map((event) => ({ time: event.time, text: timeline.textOf(event), warns: false }));
    for (const { time, text, warns } of [...events, ...warnings].sort((a, b) => a.time - b.time)) {
      paper.strokeStyle = paper.fillStyle = css(warns ? overfull : head.colours.text);
      const left = plot.valToPos(time, "x", true);
      if (left < plot.bbox.left || left > plot.bbox.left + plot.bbox.width) continue;
      paper.beginPath();
      paper.moveTo(left, plot.bbox.top);
      paper.lineTo(left, plot.bbox.top + plot.bbox.height);
      paper.stroke();
      const width = paper.measureText(text).width + 8 * devicePixelRatio;
      const fits = left + width < plot.bbox.left + plot.bbox.width;
      const begin = fits ? left + 4 * devicePixelRatio : left - width + 4 * devicePixelRatio;
      const line = ends.findIndex((end) => end < begin);
      if (line < 0) continue; // no room: the line stands for it
      ends[line] = begin + width;
      paper.fillText(text, begin, plot.bbox.top + (12 + 13 * line) * devicePixelRatio);
    }
    paper.restore();
  }
}

/// The columns, the first of which has times, with an empty place wherever frames are missing, which no line crosses.
function withGaps(timeline: Timeline, columns: Column[]): Column[] {
  const result: Column[] = columns.map(() => []);
  for (let frame = 0; frame < timeline.frames; ++frame) {
    if (timeline.lacksBefore(frame)) result.forEach((column, i) => column.push(i === 0 ? (timeline.time(frame - 1) + timeline.time(frame)) / 2 : null));
    result.forEach((column, i) => column.push(columns[i][frame]));
  }
  return result;
}

/// Time from left to right, layers from bottom to top, full colour where dense.
function drawDensities(plot: uPlot, timeline: Timeline): void {
  const paper = plot.ctx;
  const { layer: full } = timeline.head.colours;
  paper.save();
  paper.beginPath();
  paper.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
  paper.clip();
  const [first, last] = [plot.scales.x.min ?? 0, plot.scales.x.max ?? 0].map((time) => timeline.frameAt(time));
  const each = Math.max(1, Math.ceil((last - first) / mostColumns));
  const pixel = (value: number, scale: string): number => Math.round(plot.valToPos(value, scale, true));
  for (let frame = first; frame <= last; frame += each) {
    const pile = largest(timeline.piles[frame]);
    if (!pile) continue;
    const left = pixel(timeline.time(frame), "x");
    const next = Math.min(timeline.frames - 1, frame + each);
    const right = timeline.lacksBefore(next) ? left + 1 : pixel(timeline.time(next), "x");
    for (const layer of pile.layers) {
      if (layer.density <= 0) continue;
      const share = layer.density / fullest(layer);
      paper.fillStyle = share > 1 ? css(overfull, Math.min(1, share - 0.5)) : css(full, 0.9 * share);
      const top = pixel(layer.top, "y");
      paper.fillRect(left, top, Math.max(1, right - left), pixel(layer.bottom, "y") - top);
    }
  }
  paper.restore();
}
