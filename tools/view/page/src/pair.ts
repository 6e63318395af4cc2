// Two runs side by side, played in step: the pages a/ and b/ show them, this one steers both and compares what they
// show.

import { showPace } from "./element";
import type { Player } from "./player";

interface PairTexts {
  of_runs: boolean;
  ms_per_step: [number, number];
  /// Path, value of A and of B as TOML, empty where it is not given; of all settings that differ.
  differences: [string, string, string][];
}

const element = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;
const texts = JSON.parse(element("pair-data").textContent) as PairTexts;
const paces = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16, ...(texts.of_runs ? [64, 0] : [])];

/// What the two runs differ in at one time.
export interface Difference {
  time: number;
  step: number;
  awake: [number, number];
  bodies: [number, number];
  /// Mean and largest distance of the bodies that both have [m].
  mean: number;
  largest: number;
  /// Time of a step of A over that of B; 0: not known.
  speedUp: number;
}

class Pair {
  private time = 0;
  private playing = !texts.of_runs;
  /// Whether the newest time is shown, of runs that go on.
  private following = texts.of_runs;
  private clock = 0;
  private measured = 0; // time of the browser at which the plots were given one scale [ms]

  constructor(private readonly players: [Player, Player]) {
    const click = (id: string, action: () => void): void => element(id).addEventListener("click", action);
    click("play", () => this.toggle());
    click("step", () => this.step());
    click("restart", () => this.restart());
    for (const pace of paces) element("pace").append(new Option(pace === 0 ? "as fast as possible" : `${pace}x`, String(pace), false, pace === 1));
    element("pace").addEventListener("change", () => this.both((player) => player.command({ do: "pace", value: this.pace() })));
    element("scrub").addEventListener("input", () => this.seek(Number(element<HTMLInputElement>("scrub").value)));
    for (const page of [document, ...["a", "b"].map((side) => element<HTMLIFrameElement>(side).contentDocument!)])
      page.addEventListener("keydown", (event) => this.key(event));
    this.both((player) => player.pause());
    this.players[0].pairWith(this.players[1], (time) => this.seek(time));
    this.showLabels();
    requestAnimationFrame((now) => this.tick(now));
  }

  private both(action: (player: Player) => void): void {
    this.players.forEach(action);
  }

  private pace(): number {
    return Number(element<HTMLSelectElement>("pace").value);
  }

  private key(event: KeyboardEvent): void {
    if ((event.target as HTMLElement).tagName === "SELECT") return;
    const actions: Record<string, () => void> = { " ": () => this.toggle(), ".": () => this.step(), r: () => this.restart(), f: () => this.players[0].resetCamera() };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
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
    ["a", "b"].forEach((side, i) => {
      element(`label-${side}`).replaceChildren(
        ...rows.map((row) => {
          const line = Object.assign(document.createElement("div"), { textContent: `${row[0]} ` });
          line.append(Object.assign(document.createElement("b"), { textContent: row[i + 1] || "(not given)" }));
          return line;
        }),
      );
    });
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

  seek(time: number): void {
    this.following = false;
    this.time = Math.min(time, this.end());
    this.show();
  }

  private tick(now: number): void {
    const passed = this.clock > 0 ? (now - this.clock) / 1000 : 0;
    this.clock = now;
    const before = this.time;
    if (this.following || this.time > this.end()) this.time = this.end();
    else if (this.playing) this.time = Math.min(this.end(), this.time + passed * (this.pace() || 1));
    if (this.playing && this.time >= this.end()) {
      this.playing = false;
      this.following = texts.of_runs;
    }
    element("play").textContent = this.playing || this.runs() ? "\u2016" : "\u25B6";
    Object.assign(element<HTMLInputElement>("scrub"), { max: String(this.end()), value: String(this.time) });
    if (now - this.measured > 500) this.measure(now);
    if (this.time !== before) this.show();
    requestAnimationFrame((next) => this.tick(next));
  }

  /// One scale for the plots of both.
  private measure(now: number): void {
    this.measured = now;
    const [a, b] = this.players.map((player) => player.extent());
    const larger = (of: (extent: typeof a) => number): number => Math.max(of(a), of(b));
    const both = { time: larger(({ time }) => time), bodies: larger(({ bodies }) => bodies), ms: larger(({ ms }) => ms), top: larger(({ top }) => top) };
    this.both((player) => player.reach(both));
    if (this.following) showPace(element<HTMLSelectElement>("pace"), this.players[0].pace());
    this.showDifference();
  }

  private show(): void {
    this.both((player) => player.showMoment(this.time));
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
    element("time").textContent = `${time.toFixed(2)} s in both${this.whichEnds()}`;
    const length = (metres: number): string => `${metres.toPrecision(2)} m`;
    const cells = [
      ["awake", `${awake[0]} and ${awake[1]}`],
      ["bodies", `${bodies[0]} and ${bodies[1]}`],
      ["distance of the two places of a body, mean", length(mean)],
      ["largest", length(largest)],
      ["a step of the right run takes", speedUp > 0 ? `${speedUp.toFixed(2)} times as long` : "(not known)"],
    ];
    element("difference").replaceChildren(
      ...cells.map(([name, value]) => {
        const row = document.createElement("tr");
        for (const text of [name, value]) row.append(Object.assign(document.createElement("td"), { textContent: text }));
        return row;
      }),
    );
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
