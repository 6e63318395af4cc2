// What the user does with the frames of a run: play, step, scrub, choose a body.

import { type Account, BodyPanel } from "./body_panel";
import { ContactPanel } from "./contact_panel";
import { element } from "./element";
import { causes } from "./causes";
import type { Head, Rgb } from "./head";
import { type Extent, largest, Plots } from "./plots";
import { css, type Paint } from "./colours";
import { PointerTools } from "./pointer_tools";
import { Stage } from "./stage";
import { type Changed, Timeline } from "./timeline";

const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

/// Of sleeping and awake bodies by the number of the cause.
const causeColours: Rgb[] = [
  [0.1, 0.3, 0.55],
  [0.17, 0.18, 0.2],
  [0.85, 0.2, 0.15],
  [0.95, 0.5, 0.1],
  [0.75, 0.3, 0.75],
  [0.5, 0.5, 0.5],
  [0.5, 0.5, 0.5],
  [0.15, 0.5, 0.45],
  [0.95, 0.8, 0.2],
  [0.45, 0.7, 0.95],
];

function cell(text: string, name = ""): HTMLTableCellElement {
  const td = document.createElement("td");
  td.textContent = text;
  td.className = name;
  return td;
}

/// A box of each colour.
function swatch(colours: Rgb[]): HTMLTableCellElement {
  const td = cell("");
  for (const colour of colours) {
    const box = document.createElement("span");
    box.className = "swatch";
    box.style.background = css(colour);
    td.append(box);
  }
  return td;
}

/// Each colour once.
function different(colours: Rgb[]): Rgb[] {
  return [...new Map(colours.map((colour) => [css(colour), colour])).values()];
}

/// What a simulation that is still going on does with the controls.
export interface Simulation {
  toggle(): void;
  step(): void;
  restart(): void;
  running(): boolean;
  /// Whether it has come to its end.
  ended(): boolean;
  /// Whether it takes commands.
  steered(): boolean;
  /// Times real time; 0: as fast as possible.
  pace(): number;
  /// Mean time of a step since the start [ms].
  msPerStep(): number;
  /// Of tools/serve/run_loop.h.
  send(command: object): void;
}

/// What a page shows, as numbers.
export interface Shown {
  frame: number;
  frames: number;
  step: number;
  time: number;
  bodies: number;
  awake: number;
  asleep: number;
  playing: boolean;
}

export class Player {
  stage: Stage;
  readonly contacts: ContactPanel;
  readonly body = new BodyPanel();
  private readonly tools: PointerTools;
  private plots!: Plots; // made by show()
  private simulation: Simulation | null = null;
  private playing = false;
  private following = false;
  /// Of a page with two runs, which alone decides what time is shown: goes to a time.
  private led: ((time: number) => void) | null = null;
  private clock = 0;
  private time = 0;

  constructor(public timeline: Timeline) {
    const { head } = timeline;
    this.contacts = new ContactPanel(head);
    this.tools = new PointerTools({
      stage: () => this.stage,
      steered: () => this.simulation?.steered() ?? false,
      command: (command) => this.command(command),
      select: (body) => this.select(body),
    });
    this.stage = new Stage(element<HTMLCanvasElement>("bodies"), element<HTMLCanvasElement>("labels"), head);
    this.show();
    this.listen();
    requestAnimationFrame((now) => this.tick(now));
  }

  /// Another run on the same page: everything from the start.
  replace(timeline: Timeline): void {
    const { dimension } = this.head;
    const { head } = timeline;
    this.timeline = timeline;
    this.contacts.replace(head);
    this.pause();
    this.following = this.simulation !== null;
    if (head.dimension === dimension) {
      this.show();
      if (this.stage.follows) this.stage.fit(false);
      return;
    }
    // A camera of another kind.
    this.stage.dispose();
    for (const id of ["bodies", "labels"]) element(id).replaceWith(Object.assign(document.createElement("canvas"), { id }));
    this.stage = new Stage(element<HTMLCanvasElement>("bodies"), element<HTMLCanvasElement>("labels"), head);
    this.stage.follows = this.following;
    this.listenToStage();
    this.show();
  }

  private get head(): Head {
    return this.timeline.head;
  }

  attach(simulation: Simulation): void {
    this.simulation = simulation;
    this.following = this.stage.follows = true;
    element("loop-label").hidden = true;
    element("timed").hidden = false;
    this.show();
  }

  private show(): void {
    const { head } = this;
    this.time = 0;
    this.stage.selected = -1;
    document.title = `${head.title} - talus`;
    element("title").textContent = head.title;
    const seed = `seed ${head.seed}`;
    element("subtitle").textContent = [head.name, head.backend, `policy ${head.policy}`, seed, head.version].filter((part) => part !== "").join(", ");
    element("status").textContent = head.damage;
    element("history").hidden = true;
    this.stage.setRun(this.timeline);
    this.tools.setShapes(head.shapes.map(({ name }) => name));
    this.body.show(this.timeline, this.stage.selected, this.simulation !== null && this.following);
    this.showWarnings();
    this.plots?.dispose();
    this.plots = new Plots(element("plots"), head, this.timeline, this.simulation !== null, (time) => (this.led ? this.led(time) : this.seekTime(time)));
  }

  private listen(): void {
    const click = (id: string, action: () => void): void => element(id).addEventListener("click", action);
    click("play", () => this.toggle());
    click("back", () => this.stepBy(-1));
    click("forward", () => this.stepBy(1));
    click("first", () => this.seek(0));
    click("last", () => this.toEnd());
    click("wake", () => this.toNext(this.timeline.woken));
    click("avalanche", () => this.toNext(this.timeline.avalanches));
    click("warning", () => this.toNext(this.timeline.newWarnings));
    element("follow").addEventListener("change", () => this.accompany());
    click("fit", () => this.resetCamera());
    element("scrub").addEventListener("input", () => this.seek(Number(element<HTMLInputElement>("scrub").value)));
    element("paint").addEventListener("change", () => this.repaint());
    element("layers").addEventListener("change", () => {
      this.stage.showLayers = element<HTMLInputElement>("layers").checked;
      this.stage.redraw();
    });
    for (const speed of speeds) element("rate").append(new Option(`${speed}x`, String(speed), false, speed === 1));
    document.addEventListener("keydown", (event) => this.key(event));
    this.listenToStage();
  }

  private listenToStage(): void {
    const canvas = element("bodies");
    let [downX, downY] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => ([downX, downY] = [event.clientX, event.clientY]));
    canvas.addEventListener("pointerup", (event) => {
      if (Math.hypot(event.clientX - downX, event.clientY - downY) >= 4 || this.tools.click(event.offsetX, event.offsetY)) return;
      this.select(this.stage.bodyAt(event.offsetX, event.offsetY));
    });
  }

  /// What the server says of a body.
  takeAccount(account: Account): void {
    this.body.account = account;
  }

  private removeBody(): void {
    if (this.stage.selected < 0 || !this.simulation?.steered()) return;
    this.command({ do: "remove", body: this.stage.selected });
    this.select(-1);
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (this.led || event.ctrlKey || event.altKey || event.metaKey || ["TEXTAREA", "SELECT"].includes(target.tagName) || (target as HTMLInputElement).type === "number") return;
    const actions: Record<string, () => void> = {
      " ": () => this.toggle(),
      ".": () => this.stepBy(1),
      ",": () => this.stepBy(-1),
      n: () => this.toNext(this.timeline.woken),
      v: () => this.toNext(this.timeline.avalanches),
      w: () => this.toNext(this.timeline.newWarnings),
      t: () => element("follow").click(),
      s: () => this.simulation?.steered() && this.command({ do: "save" }),
      x: () => this.tools.choose("cut"),
      f: () => this.resetCamera(),
      r: () => (this.simulation ? this.simulation.restart() : this.seek(0)),
      l: () => element("loop").click(),
      c: () => this.tools.choose("camera"),
      g: () => this.tools.choose("pull"),
      a: () => this.tools.choose("add"),
      Delete: () => this.removeBody(),
      Home: () => this.seek(0),
      End: () => this.toEnd(),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  resetCamera(): void {
    this.stage.follows = this.simulation !== null;
    this.stage.fit();
  }

  /// Frames came: the controls and plots grow with them.
  grown(): void {
    element<HTMLInputElement>("scrub").max = String(Math.max(0, this.timeline.frames - 1));
    this.showWarnings();
    if (this.following && !this.led) this.goTo(this.timeline.frames - 1);
  }

  private atEnd(): boolean {
    return this.timeline.shown >= this.timeline.frames - 1;
  }

  /// A record or a simulation that has ended: plays or pauses. A simulation that goes on: runs or pauses it where its
  /// newest frame is shown, else plays up to there.
  toggle(): void {
    if (this.playing) this.pause();
    else if (this.simulation && this.following && !this.simulation.ended()) this.simulation.toggle();
    else this.play();
  }

  play(): void {
    if (this.atEnd() && (!this.simulation || this.simulation.ended())) this.seek(0);
    this.following = false;
    this.playing = true;
    this.clock = 0;
    this.showPlaying();
  }

  pause(): void {
    this.playing = false;
    this.showPlaying();
  }

  /// The play button follows what is going on: the simulation where the newest frame is shown.
  showPlaying(): void {
    const going = this.playing || (this.following && (this.simulation?.running() ?? false));
    element("play").textContent = going ? "\u2016" : "\u25B6";
  }

  stepBy(frames: number): void {
    if (this.simulation && frames > 0 && this.atEnd() && !this.simulation.ended()) {
      this.stepSimulation();
      return;
    }
    this.pause();
    this.seek(this.timeline.shown + frames);
  }

  /// One step of the simulation, shown when it has come.
  stepSimulation(): void {
    this.pause();
    this.following = true;
    this.simulation?.step();
  }

  toEnd(): void {
    this.seek(this.timeline.frames - 1);
    this.following = this.simulation !== null;
    this.pause();
  }

  /// To the next frame that has any of these.
  private toNext(counts: number[]): void {
    const next = counts.findIndex((count, frame) => frame > this.timeline.shown && count > 0);
    if (next >= 0) this.seek(next);
  }

  private accompany(): void {
    this.stage.accompany(element<HTMLInputElement>("follow").checked ? this.stage.selected : -1);
  }

  seekTime(time: number): void {
    this.seek(this.timeline.frameAt(time));
  }

  /// Shows the moment of a time, also between two frames.
  showMoment(time: number): void {
    this.following = false;
    if (this.timeline.frames > 0) this.update(this.timeline.seekTime(time), time);
  }

  /// Shows a frame; the nearest where there is none of that number.
  seek(frame: number): void {
    this.following = false;
    this.goTo(frame);
    this.time = this.timeline.shown < 0 ? 0 : this.timeline.time(this.timeline.shown);
    this.showPlaying();
  }

  private goTo(frame: number): void {
    if (this.timeline.frames === 0) return;
    const changed = this.timeline.seek(Math.min(this.timeline.frames - 1, Math.max(0, frame)));
    this.update(changed, this.timeline.time(this.timeline.shown));
  }

  private update(changed: Changed, time: number): void {
    this.stage.update(changed, this.paint());
    this.showContacts();
    element<HTMLInputElement>("scrub").value = String(this.timeline.shown);
    this.showCounts();
    this.body.show(this.timeline, this.stage.selected, this.simulation !== null && this.following);
    this.plots.showTime(time);
  }

  private repaint(): void {
    this.stage.update("all", this.paint());
    this.showCounts();
  }

  /// Called before each picture of the browser.
  private tick(now: number): void {
    const passed = this.clock > 0 ? (now - this.clock) / 1000 : 0;
    this.clock = now;
    this.plots.refresh();
    if (this.playing) this.advance(passed * Number(element<HTMLSelectElement>("rate").value));
    requestAnimationFrame((next) => this.tick(next));
  }

  private advance(seconds: number): void {
    this.time += seconds;
    if (this.time > this.timeline.time(this.timeline.frames - 1)) {
      if (element<HTMLInputElement>("loop").checked && !this.simulation) this.time = 0;
      else this.toEnd();
    }
    if (this.playing) this.goTo(this.timeline.frameAt(this.time));
  }

  private byCause(): boolean {
    return element<HTMLSelectElement>("paint").value === "cause";
  }

  private paint(): Paint {
    const { shapes } = this.head;
    const { state } = this.timeline;
    const plain: Paint = (body) => (state.asleep[body] !== 0 ? shapes[state.shape[body]].asleep : shapes[state.shape[body]].awake);
    if (!this.byCause()) return plain;
    return (body) => {
      const { event } = this.timeline.since(body);
      return event && event.woke === (state.asleep[body] === 0) ? causeColours[event.cause] : plain(body);
    };
  }

  select(body: number): void {
    const before = this.stage.selected;
    if (this.simulation?.steered()) this.command({ do: "choose", body });
    this.stage.selected = body;
    this.accompany();
    this.stage.update([before, body].filter((one) => one >= 0), this.paint());
    this.body.show(this.timeline, this.stage.selected, this.simulation !== null && this.following);
  }

  private showCounts(): void {
    const { state } = this.timeline;
    const { coloured_shapes } = this.head;
    const now = state.step * this.head.dt;
    const last = this.timeline.happenedSoFar().at(-1);
    const note = last && now - last.time < 2 ? `: ${this.timeline.textOf(last)}` : "";
    element("time").textContent = `${now.toFixed(2)} s, step ${state.step}${note}`;
    const { shapes } = this.head;
    const rows: [Rgb[], number | string, string][] = this.byCause()
      ? this.countsByCause().map(([colour, count, text]) => [[colour], count, text])
      : [
          [different(shapes.map(({ awake }) => awake)), state.awake, "awake"],
          [different(shapes.map(({ asleep }) => asleep)), state.asleepCount, coloured_shapes.length > 0 ? "asleep (darker)" : "asleep"],
          ...coloured_shapes.map(({ name, colour }): [Rgb[], string, string] => [[colour], "", name]),
        ];
    this.showMeasured();
    element("counts").replaceChildren(
      ...rows.map(([colours, count, text]) => {
        const row = document.createElement("tr");
        row.append(swatch(colours), cell(String(count), "count"), cell(text));
        return row;
      }),
    );
  }

  /// Slope and error as measured, beside what they should be.
  private showMeasured(): void {
    const { state } = this.timeline;
    const degrees = (angle: number): string => `${((180 * angle) / Math.PI).toFixed(1)}\u00B0`;
    const lines: string[] = [];
    const pile = largest(state.piles);
    if (pile) lines.push(`Slope ${state.slope < 0 ? `not measured${state.noSlope}` : `${degrees(state.slope)} measured`}; layers: ${degrees(pile.alpha)} (alpha)`);
    const { tolerance } = this.head;
    if (tolerance >= 0 || state.drift >= 0)
      lines.push(`Drift ${state.drift < 0 ? "not estimated until bodies rest" : `estimated ${state.drift.toPrecision(2)} D`}${tolerance < 0 ? "" : `, tolerance ${tolerance} D`}`);
    for (const { layers, layer_total } of state.piles)
      if (layers.length < layer_total) lines.push(`A pile has ${layer_total} layers: the lowest ${layers.length} are shown, which a message holds`);
    const { hidden } = this.stage.enclosed;
    if (hidden > 0) lines.push(`${hidden} enclosed bodies not drawn`);
    element("measured").replaceChildren(...lines.map((text) => Object.assign(document.createElement("p"), { className: "hint", textContent: text })));
  }

  private countsByCause(): [Rgb, number, string][] {
    const { state } = this.timeline;
    const counts = new Map<string, [Rgb, number, string]>();
    const paint = this.paint();
    for (let body = 0; body < state.bodies; ++body) {
      if (state.removed[body] !== 0) continue;
      const { event } = this.timeline.since(body);
      const awake = state.asleep[body] === 0;
      const named = event && event.woke === awake ? `${awake ? "awake" : "asleep"}: ${causes[event.cause]?.name}` : awake ? "awake since it appeared" : "asleep";
      const row = counts.get(named) ?? [paint(body), 0, named];
      ++row[1];
      counts.set(named, row);
    }
    return [...counts.values()].sort((a, b) => a[2].localeCompare(b[2]));
  }

  private showWarnings(): void {
    const { warnings } = this.timeline;
    element("warnings").hidden = warnings.size === 0;
    const lines = [...warnings.values()].map(({ text }) => Object.assign(document.createElement("li"), { textContent: text }));
    element("warnings").querySelector("ul")!.replaceChildren(...lines);
  }

  /// For a page that steers this one.
  command(command: object): void {
    this.simulation?.send(command);
  }
  simulates(): boolean {
    return this.simulation?.running() ?? false;
  }
  ended(): boolean {
    return this.simulation?.ended() ?? true;
  }
  /// Of the simulation.
  pace(): number {
    return this.simulation?.pace() ?? 1;
  }

  msPerStep(): number {
    return this.simulation?.msPerStep() ?? 0;
  }

  /// Both show one part of space at one scale from now on, and the times that they are told. `seek`: to where the user
  /// clicks in a plot.
  pairWith(other: Player, seek: (time: number) => void): void {
    this.led = other.led = seek;
    this.stage.pairWith(other.stage);
  }
  /// How far the plots reach, and to have them reach at least so far.
  extent(): Extent {
    return this.plots.extent();
  }
  reach(extent: Extent): void {
    this.plots.reach(extent);
  }

  /// Mean and largest distance [m] from the places of the bodies that another player shows.
  distanceTo(other: Player): [number, number] {
    const [a, b] = [this.places(), other.places()];
    const axes = this.head.dimension;
    let [sum, largest, count] = [0, 0, 0];
    for (let body = 0; body * axes < Math.min(a.length, b.length); ++body) {
      const distance = Math.hypot(...Array.from({ length: axes }, (_, i) => a[axes * body + i] - b[axes * body + i]));
      if (Number.isNaN(distance)) continue;
      sum += distance;
      largest = Math.max(largest, distance);
      ++count;
    }
    return [count > 0 ? sum / count : 0, largest];
  }

  /// Positions of all bodies [m] as drawn; NaN for removed ones.
  private places(): Float64Array {
    const { dimension } = this.head;
    const { state, drawn } = this.timeline;
    const components = dimension === 2 ? 3 : 7;
    return Float64Array.from({ length: dimension * state.bodies }, (_, i) => {
      const body = Math.floor(i / dimension);
      return state.removed[body] !== 0 ? NaN : drawn.pose[components * body + (i % dimension)];
    });
  }

  /// The server has left frames out: those that are left lie at most so many steps apart.
  thin(steps: number, mebibytes: number): void {
    this.timeline.thinned = steps;
    const note = element("history");
    note.hidden = false;
    note.textContent = `The run has more frames than ${mebibytes} MiB hold: in the past they lie up to ${(steps * this.head.dt).toPrecision(3)} s apart (--history).`;
  }

  private showContacts(): void {
    this.contacts.show(this.timeline.state.step, this.stage);
  }

  /// The run takes commands.
  steer(): void {
    this.contacts.listen(
      (wanted) => this.command({ do: "contacts", value: wanted }),
      () => this.showContacts(),
    );
  }

  shown(): Shown {
    const { state } = this.timeline;
    return {
      frame: this.timeline.shown,
      frames: this.timeline.frames,
      step: state.step,
      time: state.step * this.head.dt,
      bodies: state.awake + state.asleepCount,
      awake: state.awake,
      asleep: state.asleepCount,
      playing: this.playing,
    };
  }
}
