// What the user does with the frames of a run: play, step, scrub, choose a body.

import type { View } from "./address";
import { type Account, BodyPanel } from "./body_panel";
import { Colouring, type Way, ways } from "./colourings";
import { onTheme, themed } from "./colours";
import { ContactPanel } from "./contact_panel";
import { draggable, dragPlots, element, make, offerPaces, onClick, paces, showGoing, simulationPaces } from "./element";
import type { Head } from "./head";
import { inDegrees } from "./instrument_view";
import { type Key, Keys } from "./keys";
import { type Drawn, marksOf, showLegend } from "./legend";
import { factsOf, offerPictures, type Scenery } from "./picture";
import { largest } from "./pile_layers";
import { Plots } from "./plots";
import { PointerTools } from "./pointer_tools";
import { poseValues } from "./pose";
import { near } from "./sides";
import { Stage } from "./stage";
import { type Changed, Timeline } from "./timeline";

const fastest = 16; // at which is played what was simulated as fast as possible

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

const panels = (): HTMLDetailsElement[] => [...document.querySelectorAll<HTMLDetailsElement>("#dock details")];

export class Player {
  stage: Stage;
  readonly contacts: ContactPanel;
  readonly body = new BodyPanel();
  private readonly tools: PointerTools;
  private readonly colouring: Colouring;
  private coloured: ReturnType<Colouring["now"]>;
  private readonly keys: Keys | null;
  private plots: Plots | null = null;
  private simulation: Simulation | null = null;
  private playing = false;
  private following = false;
  /// Of a page with two runs, which alone decides what time is shown.
  private led = false;
  private clock = 0;
  private time = 0;
  /// Rows of the plots and time [s] that stand in the address, as long as there are no frames of that time.
  private wantedPlots: string | null = null;
  private wantedTime: number | null = null;

  constructor(public timeline: Timeline) {
    this.contacts = new ContactPanel(() => this.repaint());
    this.colouring = new Colouring(() => this.timeline, this.contacts);
    this.coloured = this.colouring.now();
    this.tools = new PointerTools({
      stage: () => this.stage,
      steered: () => this.steered(),
      command: (command) => this.command(command),
      select: (body) => this.select(body),
    });
    this.stage = this.newStage();
    this.show();
    this.listen();
    this.keys = this.half ? null : new Keys(() => this.keyList());
    requestAnimationFrame((now) => this.tick(now));
  }

  private newStage(): Stage {
    const stage = new Stage(element<HTMLCanvasElement>("bodies"), element<HTMLCanvasElement>("labels"), this.head);
    stage.onDrawn = () => this.body.place(this.stage, this.timeline);
    return stage;
  }

  /// Whether this is one of two pages side by side.
  private get half(): boolean {
    return document.body.classList.contains("half");
  }

  /// Another run on the same page: everything from the start.
  replace(timeline: Timeline): void {
    const { dimension } = this.head;
    this.timeline = timeline;
    this.colouring.forget();
    this.pause();
    this.following = this.simulation !== null;
    if (timeline.head.dimension === dimension) {
      this.show();
      if (this.stage.follows) this.stage.fit(false);
      return;
    }
    // A camera of another kind.
    this.stage.dispose();
    for (const id of ["bodies", "labels"]) element(id).replaceWith(make("canvas", { id }));
    this.stage = this.newStage();
    this.stage.follows = this.following;
    this.listenToStage();
    this.show();
  }

  private get head(): Head {
    return this.timeline.head;
  }

  private steered(): boolean {
    return this.simulation?.steered() ?? false;
  }

  attach(simulation: Simulation): void {
    this.simulation = simulation;
    this.following = this.stage.follows = true;
    element("loop-label").hidden = true;
  }

  private show(): void {
    const { head } = this;
    this.time = 0;
    this.stage.selected = -1;
    document.title = `${head.title} - talus`;
    element("title").textContent = head.title;
    element("subtitle").textContent = factsOf(head);
    element("status").textContent = head.damage;
    element("history").hidden = true;
    this.stage.setRun(this.timeline);
    this.accompany(); // no body is chosen
    this.tools.setShapes(head.shapes.map(({ name }) => name));
    this.showBody();
    this.showWarnings();
    this.offerContacts();
    this.plot();
  }

  private plot(): void {
    if (this.half) return; // the page with both has the plots of both
    this.wantedPlots = this.plots ? this.plots.shown : this.wantedPlots;
    this.plots?.dispose();
    this.plots = new Plots(element("plots"), [{ timeline: this.timeline, name: "" }], (time) => this.seekTime(time), this.wantedPlots);
  }

  /// Takes over the colours of the system's theme.
  private retheme(): void {
    this.head.colours = themed(this.head.light);
    this.stage.setRun(this.timeline);
    this.plot();
    this.repaint();
  }

  private listen(): void {
    onClick("play", () => this.toggle());
    onClick("back", () => this.stepBy(-1));
    onClick("forward", () => this.stepBy(1));
    onClick("first", () => this.seek(0));
    onClick("last", () => this.toEnd());
    onClick("restart", () => this.simulation?.restart());
    onClick("wake", () => this.toNext(this.timeline.woken));
    onClick("avalanche", () => this.toNext(this.timeline.avalanches));
    onClick("warning", () => this.toNext(this.timeline.newWarnings));
    onClick("fit", () => this.resetCamera());
    onClick("help", () => this.keys?.toggle());
    onClick("fold", () => this.foldDock());
    onClick("close", () => this.select(-1));
    element("follow").addEventListener("change", () => this.accompany());
    element("scrub").addEventListener("input", () => this.seek(Number(element<HTMLInputElement>("scrub").value)));
    const paint = element<HTMLSelectElement>("paint");
    paint.append(...Object.entries(ways).map(([way, text]) => new Option(text, way)));
    paint.addEventListener("change", () => this.colourBy(paint.value as Way));
    element("layers").addEventListener("change", () => {
      this.stage.showLayers = element<HTMLInputElement>("layers").checked;
      this.stage.redraw();
      this.showCounts();
    });
    offerPaces(element<HTMLSelectElement>("rate"), paces);
    element("rate").addEventListener("change", () => this.steered() && this.command({ do: "pace", value: this.rate() }));
    if (!this.half) offerPictures(() => [this.scenery()]);
    dragPlots();
    draggable(
      element("dock-edge"),
      (x) => document.body.style.setProperty("--dock", `${Math.max(180, innerWidth - x)}px`),
      () => document.body.style.removeProperty("--dock"),
    );
    onTheme(() => this.retheme());
    this.listenToStage();
  }

  private rate(): number {
    return Number(element<HTMLSelectElement>("rate").value);
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
    if (this.stage.selected < 0 || !this.steered()) return;
    this.command({ do: "remove", body: this.stage.selected });
    this.select(-1);
  }

  private keyList(): Key[] {
    if (this.led) return [];
    const all: Key[] = [
      { key: " ", name: "space", does: "play, pause", action: () => this.toggle() },
      { key: ".", does: "step forward", action: () => this.stepBy(1) },
      { key: ",", does: "step back", action: () => this.stepBy(-1) },
      { key: "Home", name: "Home", does: "first frame", action: () => this.seek(0) },
      { key: "End", name: "End", does: "last frame", action: () => this.toEnd() },
      { key: "n", does: "next frame in which bodies wake", action: () => this.toNext(this.timeline.woken) },
      { key: "v", does: "next avalanche", action: () => this.toNext(this.timeline.avalanches) },
      { key: "w", does: "next warning", action: () => this.toNext(this.timeline.newWarnings) },
      { key: "t", does: "the camera follows the chosen body, or no more", action: () => element("follow").click() },
      { key: "f", does: "reset the camera", action: () => this.resetCamera() },
      { key: "d", does: "fold or unfold the panels", action: () => this.foldDock() },
      { key: "Escape", name: "Esc", does: "choose no body", action: () => this.select(-1) },
      { key: "r", does: this.steered() ? "restart" : "first frame", action: () => (this.steered() ? this.simulation!.restart() : this.seek(0)) },
    ];
    if (!this.simulation) all.push({ key: "l", does: "loop", action: () => element("loop").click() });
    if (this.steered())
      all.push(
        { key: "c", does: "the pointer moves the camera", action: () => this.tools.choose("camera") },
        { key: "g", does: "the pointer pulls bodies along", action: () => this.tools.choose("pull") },
        { key: "a", does: "the pointer adds bodies", action: () => this.tools.choose("add") },
        { key: "x", does: "the pointer cuts walls away", action: () => this.tools.choose("cut") },
        { key: "Delete", name: "Delete", does: "remove the chosen body", action: () => this.removeBody() },
        { key: "s", does: "save the state as a scene", action: () => this.command({ do: "save" }) },
      );
    return all;
  }

  private foldDock(): void {
    document.body.classList.toggle("folded");
  }

  resetCamera(): void {
    this.stage.follows = this.simulation !== null;
    this.stage.fit();
  }

  /// Frames came: the controls and plots grow with them.
  grown(): void {
    element<HTMLInputElement>("scrub").max = String(Math.max(0, this.timeline.frames - 1));
    this.showWarnings();
    this.offerContacts();
    const { timeline, wantedTime } = this;
    if (wantedTime !== null && timeline.time(timeline.frames - 1) + this.head.dt / 2 >= wantedTime) this.seekTime(wantedTime);
    else if (this.following && !this.led) this.goTo(timeline.frames - 1);
    const { woken, avalanches, newWarnings } = timeline;
    for (const [id, counts] of Object.entries({ wake: woken, avalanche: avalanches, warning: newWarnings })) element(id).hidden = !counts.some((count) => count > 0);
  }

  private atEnd(): boolean {
    return this.timeline.shown >= this.timeline.frames - 1;
  }

  /// A record or a simulation that has ended: plays or pauses. A simulation that goes on: runs or pauses it where its
  /// newest frame is shown, else plays up to there. One that takes no commands: its newest frame is no longer followed.
  toggle(): void {
    if (this.playing) this.pause();
    else if (this.simulation && this.following && !this.simulation.ended()) this.steered() ? this.simulation.toggle() : this.seek(this.timeline.shown);
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
    showGoing(element("play"), this.playing || (this.following && (this.simulation?.running() ?? false)));
    element("last").classList.toggle("wanted", this.simulation !== null && !this.following && !this.simulation.ended());
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
  private stepSimulation(): void {
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

  /// Shows the frame at or before a time; digits that an address or a pointer lacks make no difference.
  seekTime(time: number): void {
    this.seek(this.timeline.frameAt(time + this.head.dt / 2));
  }

  /// Shows the moment of a time, also between two frames.
  showMoment(time: number): void {
    this.following = false;
    this.time = time;
    if (this.timeline.frames > 0) this.update(this.timeline.seekTime(time), time);
  }

  /// Shows a frame; the nearest where there is none of that number.
  seek(frame: number): void {
    this.following = false;
    this.wantedTime = null;
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
    this.coloured = this.colouring.now();
    this.stage.update(["state", "cause"].includes(this.colouring.way) ? changed : "all", this.coloured.paint);
    this.showContacts();
    element<HTMLInputElement>("scrub").value = String(this.timeline.shown);
    this.showCounts();
    this.showBody();
    this.plots?.showTime(time);
  }

  private repaint(): void {
    if (this.timeline.shown >= 0) this.update("all", this.timeline.time(this.timeline.shown));
  }

  colourBy(way: Way): void {
    this.colouring.way = element<HTMLSelectElement>("paint").value = way;
    if (this.contacts.offered) this.contacts.colourBodies(way === "force");
    this.repaint();
  }

  /// Called before each picture of the browser.
  private tick(now: number): void {
    const passed = this.clock > 0 ? (now - this.clock) / 1000 : 0;
    this.clock = now;
    this.plots?.refresh();
    if (this.playing) this.advance(passed * (this.rate() || fastest));
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

  select(body: number): void {
    const before = this.stage.selected;
    if (this.steered()) this.command({ do: "choose", body });
    this.stage.selected = body;
    this.accompany();
    this.stage.update([before, body].filter((one) => one >= 0), this.coloured.paint);
    this.showBody();
    this.showCounts();
  }

  private showBody(): void {
    this.body.show(this.timeline, this.stage.selected, this.simulation !== null && this.following);
    this.body.place(this.stage, this.timeline);
  }

  private showCounts(): void {
    const { state } = this.timeline;
    const now = state.step * this.head.dt;
    const last = this.timeline.happenedSoFar().at(-1);
    element("time").textContent = `${now.toFixed(2)} s`;
    element("step").textContent = `step ${state.step}${last && now - last.time < 2 ? `: ${this.timeline.textOf(last)}` : ""}`;
    this.showMeasured();
    showLegend(this.coloured.legend, marksOf(this.timeline, this.drawn()));
  }

  private drawn(): Drawn {
    return { layers: this.stage.showLayers, contacts: this.stage.marked, chosen: this.stage.selected >= 0 };
  }

  /// For pictures.
  scenery(): Scenery {
    const { timeline, head } = this;
    return { head, time: timeline.state.step * head.dt, canvases: ["bodies", "labels"].map((id) => element<HTMLCanvasElement>(id)), entries: this.coloured.legend, marks: marksOf(timeline, this.drawn()) };
  }

  /// Slope and error as measured, beside what they should be.
  private showMeasured(): void {
    const { state } = this.timeline;
    const degrees = (angle: number): string => `${inDegrees(angle).toFixed(1)}\u00B0`;
    const lines: string[] = [];
    const pile = largest(state.piles);
    element("layers").parentElement!.hidden = !pile;
    if (pile) lines.push(`Slope ${state.slope < 0 ? `not measured${state.noSlope}` : `${degrees(state.slope)} measured`}; layers: ${degrees(pile.alpha)} (alpha)`);
    const { tolerance } = this.head;
    if (tolerance >= 0 || state.drift >= 0)
      lines.push(`Drift ${state.drift < 0 ? "not estimated until bodies rest" : `estimated ${state.drift.toPrecision(2)} D`}${tolerance < 0 ? "" : `, tolerance ${tolerance} D`}`);
    for (const { layers, layer_total } of state.piles)
      if (layers.length < layer_total) lines.push(`A pile has ${layer_total} layers: the lowest ${layers.length} are shown, which a message holds`);
    const { hidden } = this.stage.enclosed;
    if (hidden > 0) lines.push(`${hidden} enclosed bodies not drawn`);
    element("measures").hidden = lines.length === 0 && element("history").hidden;
    element("measured").replaceChildren(...lines.map((textContent) => make("p", { className: "hint", textContent })));
  }

  private showWarnings(): void {
    const { warnings } = this.timeline;
    element("warnings").hidden = warnings.size === 0;
    element("warnings").querySelector("ul")!.replaceChildren(...[...warnings.values()].map(({ text }) => make("li", { textContent: text })));
  }

  /// For an address.
  view(): View {
    const { stage } = this;
    const view: View = {};
    const toggled = panels().filter((panel) => panel.open !== panel.hasAttribute("data-open")).map(({ id }) => id);
    if (document.body.classList.contains("folded")) toggled.push("dock");
    if (!(this.simulation && this.following)) view.t = String(Number((this.wantedTime ?? this.timeline.state.step * this.head.dt).toFixed(4)));
    if (stage.moved) view.camera = stage.cameraText;
    if (this.colouring.way !== "state") view.colours = this.colouring.way;
    if (stage.selected >= 0) view.body = String(stage.selected);
    if (!stage.showLayers) view.layers = "off";
    if (element<HTMLSelectElement>("contacts").value !== "none") view.contacts = element<HTMLSelectElement>("contacts").value;
    if (toggled.length > 0) view.panels = toggled.join(",");
    const plots = this.plots ? this.plots.shown : this.wantedPlots;
    if (plots !== null) view.plots = plots;
    return view;
  }

  /// Shows what an address says.
  restore({ t, camera, colours, body, panels: changed, plots, layers, contacts }: View): void {
    const toggled = changed?.split(",") ?? [];
    for (const panel of panels()) panel.open = panel.hasAttribute("data-open") !== toggled.includes(panel.id);
    document.body.classList.toggle("folded", toggled.includes("dock"));
    if (plots !== undefined) {
      this.wantedPlots = plots;
      this.plots?.dispose();
      this.plots = null;
      this.plot();
    }
    if (layers === "off") element("layers").click();
    if (contacts && this.contacts.offered) {
      element<HTMLSelectElement>("contacts").value = contacts;
      element("contacts").dispatchEvent(new Event("change"));
    }
    if (colours && colours in ways && (colours !== "force" || this.contacts.offered)) this.colourBy(colours as Way);
    if (t !== undefined && Number.isFinite(Number(t))) this.wantedTime = Number(t);
    if (this.wantedTime !== null && !this.simulation) this.seekTime(this.wantedTime);
    if (body !== undefined && Number.isInteger(Number(body))) this.select(Number(body));
    if (camera) this.stage.cameraText = camera;
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

  /// Both show one part of space at one scale from now on, and the times that they are told.
  pairWith(other: Player): void {
    this.led = other.led = true;
    this.stage.pairWith(other.stage);
  }

  /// Mean and largest distance [m] from the places of the bodies that another player shows.
  distanceTo(other: Player): [number, number] {
    const [a, b] = [this.places(), other.places()];
    const axes = this.head.dimension;
    let [sum, largest, count] = [0, 0, 0];
    for (let body = 0; body * axes < Math.min(a.length, b.length); ++body) {
      const [from, to] = [a, b].map((places) => Array.from(places.subarray(axes * body, axes * (body + 1))));
      const distance = Math.hypot(...near(this.head.sides, to, from).map((value, axis) => value - from[axis]));
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
    const components = poseValues(dimension);
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
    this.contacts.show(this.timeline.state, this.stage);
  }

  /// The run takes commands.
  steer(): void {
    offerPaces(element<HTMLSelectElement>("rate"), simulationPaces);
    this.contacts.steer((wanted) => this.command({ do: "contacts", value: wanted }));
    this.offerContacts();
  }

  private offerContacts(): void {
    if (this.timeline.hasContacts) this.contacts.offer();
    for (const option of element<HTMLSelectElement>("paint").options) option.disabled = option.value === "force" && !this.contacts.offered;
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
