// Two runs side by side, played in step: the pages a/ and b/ show them, this one steers both and compares what they
// show.

import type { Player } from "./player";

interface PairTexts {
  of_runs: boolean;
  ms_per_step: [number, number];
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

  constructor(private readonly players: [Player, Player]) {
    const click = (id: string, action: () => void): void => element(id).addEventListener("click", action);
    click("play", () => this.toggle());
    click("step", () => this.step());
    click("restart", () => this.restart());
    for (const pace of paces) element("pace").append(new Option(pace === 0 ? "as fast as possible" : `${pace}x`, String(pace), false, pace === 1));
    element("pace").addEventListener("change", () => this.both((player) => player.command({ do: "pace", value: this.pace() })));
    element("scrub").addEventListener("input", () => this.seek(Number(element<HTMLInputElement>("scrub").value)));
    document.addEventListener("keydown", (event) => this.key(event));
    this.both((player) => player.pause());
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
    const actions: Record<string, () => void> = { " ": () => this.toggle(), ".": () => this.step(), r: () => this.restart() };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  private going(): boolean {
    return texts.of_runs ? this.players.some((player) => player.simulates()) : this.playing;
  }

  toggle(): void {
    if (!texts.of_runs) {
      if (!this.playing && this.time >= this.end()) this.time = 0;
      this.playing = !this.playing;
      return;
    }
    const command = { do: this.going() ? "pause" : "run" };
    this.following = true;
    this.both((player) => player.command(command));
  }

  step(): void {
    this.playing = false;
    if (texts.of_runs) {
      this.following = true;
      this.both((player) => player.command({ do: "step" }));
      return;
    }
    const { timeline } = this.players[0];
    this.seek(timeline.time(Math.min(timeline.frames - 1, timeline.shown + 1)));
  }

  restart(): void {
    this.both((player) => player.command({ do: "restart" }));
    this.seek(0);
    this.following = texts.of_runs;
  }

  /// Up to when both have frames.
  private end(): number {
    return Math.min(...this.players.map(({ timeline }) => (timeline.frames === 0 ? 0 : timeline.time(timeline.frames - 1))));
  }

  pause(): void {
    this.playing = this.following = false;
  }

  seek(time: number): void {
    this.following = false;
    this.time = time;
    this.show();
  }

  private tick(now: number): void {
    const passed = this.clock > 0 ? (now - this.clock) / 1000 : 0;
    this.clock = now;
    const before = this.time;
    if (this.following) this.time = this.end();
    else if (this.playing) this.time = Math.min(this.end(), this.time + passed * this.pace());
    if (this.playing && this.time >= this.end()) this.playing = false;
    element("play").textContent = this.going() ? "\u2016" : "\u25B6";
    element<HTMLInputElement>("scrub").max = String(this.end());
    if (this.time !== before) this.show();
    requestAnimationFrame((next) => this.tick(next));
  }

  private show(): void {
    this.both((player) => player.seekTime(this.time));
    element<HTMLInputElement>("scrub").value = String(this.time);
    this.showDifference();
  }

  difference(): Difference {
    const [a, b] = this.players;
    const step = Math.round(this.time / a.timeline.head.dt);
    const [mean, largest] = a.distanceTo(b, step);
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
    element("time").textContent = `${time.toFixed(2)} s`;
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
}

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
