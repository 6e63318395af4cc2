// Two runs side by side, played in step: the pages a/ and b/ show them, this one steers both and compares what they
// show.

import { keepAddress, type View, viewOfAddress } from "./address";
import { type Way, ways } from "./colourings";
import { onTheme, themed } from "./colours";
import { dragPlots, element, make, offerPaces, onClick, paces, showGoing, showPace, simulationPaces } from "./element";
import { Keys } from "./keys";
import { listed } from "./legend";
import { offerPictures } from "./picture";
import type { Player } from "./player";
import { Plots } from "./plots";
import type { Timeline } from "./timeline";

interface PairTexts {
  of_runs: boolean;
  ms_per_step: [number, number];
  /// Path, value of A and of B as TOML, empty where it is not given; of all settings that differ.
  differences: [string, string, string][];
}

const texts = JSON.parse(element("pair-data").textContent) as PairTexts;
const rate = element<HTMLSelectElement>("rate");
const paint = element<HTMLSelectElement>("paint");

/// What the two runs differ in at one time.
export interface Difference {
  time: number;
  step: number;
  awake: [number, number];
  bodies: [number, number];
  /// Mean and largest distance of the bodies that both have [m].
  mean: number;
  largest: number;
  /// Time of a step of B over that of A; 0: not known.
  speedUp: number;
}

class Pair {
  private time = 0;
  private playing = !texts.of_runs;
  /// Whether the newest time is shown, of runs that go on.
  private following = texts.of_runs;
  private clock = 0;
  private compared = 0; // time of the browser at which the two were compared [ms]
  private plots: Plots | null = null;
  /// Of the plots: a run that begins anew has another one.
  private plotted: Timeline[] = [];
  /// That stands in the address, as long as there are no frames of it [s].
  private wantedTime: number | null = null;

  constructor(private readonly players: [Player, Player]) {
    onClick("play", () => this.toggle());
    onClick("forward", () => this.step());
    onClick("first", () => this.seek(0));
    onClick("last", () => this.toEnd());
    onClick("restart", () => this.restart());
    onClick("fit", () => this.players[0].resetCamera());
    onClick("help", () => keys.toggle());
    offerPaces(rate, texts.of_runs ? simulationPaces : paces);
    rate.addEventListener("change", () => this.both((player) => player.command({ do: "pace", value: this.pace() })));
    paint.append(...Object.entries(ways).map(([way, text]) => new Option(text, way)).filter(({ value }) => value !== "force"));
    paint.addEventListener("change", () => this.colourBy(paint.value as Way));
    element("scrub").addEventListener("input", () => this.seek(Number(element<HTMLInputElement>("scrub").value)));
    const keys = new Keys(() => this.keyList(), [document, ...["a", "b"].map((side) => element<HTMLIFrameElement>(side).contentDocument!)]);
    this.both((player) => player.pause());
    this.players[0].pairWith(this.players[1]);
    this.showLabels();
    this.plot(viewOfAddress().plots ?? null);
    onTheme(() => this.plot(this.plots!.shown));
    dragPlots();
    offerPictures(() => this.players.map((player) => player.scenery()));
    this.restore(viewOfAddress());
    keepAddress(() => this.view());
    requestAnimationFrame((now) => this.tick(now));
  }

  private keyList(): ReturnType<ConstructorParameters<typeof Keys>[0]> {
    return [
      { key: " ", name: "space", does: "run, play or pause both", action: () => this.toggle() },
      { key: ".", does: "one step or frame of both", action: () => this.step() },
      { key: "Home", name: "Home", does: "start", action: () => this.seek(0) },
      { key: "End", name: "End", does: "newest time", action: () => this.toEnd() },
      { key: "r", does: "both from the start", action: () => this.restart() },
      { key: "f", does: "reset the camera", action: () => this.players[0].resetCamera() },
    ];
  }

  private colourBy(way: Way): void {
    paint.value = way;
    this.both((player) => player.colourBy(way));
  }

  private plot(shown: string | null): void {
    this.plots?.dispose();
    const [a, b] = (this.plotted = this.players.map(({ timeline }) => timeline));
    for (const { head } of this.plotted) head.colours = themed(head.light);
    this.plots = new Plots(element("plots"), [{ timeline: a, name: "left" }, { timeline: b, name: "right" }], (time) => this.seek(time), shown);
  }

  private view(): View {
    const { camera, colours, layers } = this.players[0].view();
    const plots = this.plots!.shown;
    return {
      ...(this.following ? {} : { t: String(Number((this.wantedTime ?? this.time).toFixed(4))) }),
      ...(camera ? { camera } : {}),
      ...(colours ? { colours } : {}),
      ...(layers ? { layers } : {}),
      ...(plots !== null ? { plots } : {}),
    };
  }

  private restore({ t, camera, colours, layers }: View): void {
    this.both((player) => player.restore({ ...(camera ? { camera } : {}), ...(layers ? { layers } : {}) }));
    if (colours && colours in ways) this.colourBy(colours as Way);
    if (t === undefined || !Number.isFinite(Number(t))) return;
    this.playing = false;
    this.wantedTime = Number(t);
  }

  private both(action: (player: Player) => void): void {
    this.players.forEach(action);
  }

  private pace(): number {
    return Number(rate.value);
  }

  /// Large above each run what it has otherwise than the other one, and its name where they have all in common.
  private showLabels(): void {
    const [a, b] = this.players.map(({ timeline }) => timeline.head);
    const all: [string, string, string][] = [
      ["policy", a.policy, b.policy],
      ["engine", a.backend, b.backend],
      ["seed", String(a.seed), String(b.seed)],
      ["scene", a.title, b.title],
      ...texts.differences.filter(([path]) => !["policy.kind", "seed", "title"].includes(path)),
      ["talus", a.version, b.version],
    ];
    const different = all.filter(([, first, second]) => first !== second);
    const rows = different.length > 0 ? different : [["run", a.name, b.name]];
    ["a", "b"].forEach((side, i) => element(`label-${side}`).replaceChildren(...rows.map((row) => make("div", { textContent: `${row[0]} ` }, make("b", { textContent: row[i + 1] || "(not given)" })))));
  }

  /// Whether a simulation goes on that is shown as it goes.
  private runs(): boolean {
    return this.following && this.players.some((player) => player.simulates());
  }

  private ended(): boolean {
    return this.players.every((player) => player.ended());
  }

  toggle(): void {
    if (this.playing) {
      this.playing = false;
    } else if (this.following && !this.ended()) {
      const command = { do: this.runs() ? "pause" : "run" };
      this.players.filter((player) => !player.ended()).forEach((player) => player.command(command));
    } else {
      if (this.time >= this.end()) this.time = 0;
      this.playing = true;
      this.following = false;
    }
  }

  /// One step of both simulations, else to the next time of which one of them has a frame.
  step(): void {
    this.playing = false;
    if (this.following && !this.ended()) {
      this.players.filter((player) => !player.ended()).forEach((player) => player.command({ do: "step" }));
      return;
    }
    const next = this.players.map(({ timeline }) => {
      const frame = timeline.frameAt(this.time + 1e-9) + 1;
      return frame < timeline.frames ? timeline.time(frame) : this.end();
    });
    this.seek(Math.min(this.end(), ...next));
  }

  restart(): void {
    this.both((player) => player.command({ do: texts.of_runs && player.ended() ? "run" : "restart" }));
    this.seek(0);
    this.following = texts.of_runs;
  }

  /// Until when there are both runs.
  private end(): number {
    return Math.min(...this.players.map(lastTime));
  }

  pause(): void {
    this.playing = this.following = false;
  }

  toEnd(): void {
    this.seek(this.end());
    this.playing = false;
    this.following = texts.of_runs;
  }

  seek(time: number): void {
    this.following = false;
    this.wantedTime = null;
    this.time = Math.min(time, this.end());
    this.show();
  }

  private tick(now: number): void {
    const passed = this.clock > 0 ? (now - this.clock) / 1000 : 0;
    this.clock = now;
    const before = this.time;
    if (this.wantedTime !== null && this.end() >= this.wantedTime) this.seek(this.wantedTime);
    if (this.following || this.time > this.end()) this.time = this.end();
    else if (this.playing) this.time = Math.min(this.end(), this.time + passed * (this.pace() || 1));
    if (this.playing && this.time >= this.end()) {
      this.playing = false;
      this.following = texts.of_runs;
    }
    showGoing(element("play"), this.playing || this.runs());
    Object.assign(element<HTMLInputElement>("scrub"), { max: String(this.end()), value: String(this.time) });
    const begun = this.players.some(({ timeline }, i) => timeline !== this.plotted[i]);
    if (begun) this.plot(this.plots!.shown);
    this.plots!.refresh();
    if (now - this.compared > 500) this.compare(now);
    if (begun || this.time !== before) this.show();
    requestAnimationFrame((next) => this.tick(next));
  }

  private compare(now: number): void {
    this.compared = now;
    if (this.following) showPace(rate, this.players[0].pace());
    this.showDifference();
  }

  private show(): void {
    this.both((player) => player.showMoment(this.time));
    this.plots!.showTime(this.time);
    this.showDifference();
  }

  difference(): Difference {
    const [a, b] = this.players;
    const step = Math.round(this.time / a.timeline.head.dt);
    const [mean, largest] = a.distanceTo(b);
    const [first, second] = texts.of_runs ? this.players.map((player) => player.msPerStep()) : texts.ms_per_step;
    return {
      time: this.time,
      step,
      awake: [a.shown().awake, b.shown().awake],
      bodies: [a.shown().bodies, b.shown().bodies],
      mean,
      largest,
      speedUp: first > 0 && second > 0 ? second / first : 0,
    };
  }

  private showDifference(): void {
    const { time, awake, bodies, mean, largest, speedUp } = this.difference();
    element("time").textContent = `${time.toFixed(2)} s${this.whichEnds()}`;
    const length = (metres: number): string => `${metres.toPrecision(2)} m`;
    const cells = [
      ["awake", `${awake[0]} and ${awake[1]}`],
      ["bodies", `${bodies[0]} and ${bodies[1]}`],
      ["distance of the two places of a body, mean", length(mean)],
      ["largest", length(largest)],
      ["a step of the right run takes", speedUp > 0 ? `${speedUp.toFixed(2)} times as long` : "(not known)"],
    ];
    ["a", "b"].forEach((side, i) => element(`legend-${side}`).replaceChildren(...listed(this.players[i].scenery().entries)));
    element("difference").replaceChildren(...cells.map((cell) => make("tr", {}, ...cell.map((textContent) => make("td", { textContent })))));
  }

  /// Where one run ends before the other there is nothing to compare from then on.
  private whichEnds(): string {
    const [a, b] = this.players.map(lastTime);
    const [first, second] = this.players;
    if (a < b && first.ended()) return `; the first run ends at ${a.toFixed(2)} s`;
    if (b < a && second.ended()) return `; the second run ends at ${b.toFixed(2)} s`;
    return "";
  }
}

const lastTime = ({ timeline }: Player): number => (timeline.frames === 0 ? 0 : timeline.time(timeline.frames - 1));

declare global {
  interface Window {
    /// For tests and for the console.
    pair?: Pair;
  }
}

/// Resolves once the page of a side shows its run.
async function playerOf(side: string): Promise<Player> {
  const frame = element<HTMLIFrameElement>(side);
  frame.src = `${side}/${location.search}`;
  for (;;) {
    const player = frame.contentWindow?.talus;
    if (player) return player;
    await new Promise((done) => setTimeout(done, 30));
  }
}

void Promise.all([playerOf("a"), playerOf("b")]).then((players) => (window.pair = new Pair(players)));
