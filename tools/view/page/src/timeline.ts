// All frames of a run so far, and the one that is shown.

import type { Head } from "./head";
import type { Layouts } from "./messages";
import { mixedPose, poseValues } from "./pose";
import { near } from "./sides";
import { type Instruments, type Moment, type Pile, type SceneEvent, type SleepEvent, State, type Warning } from "./moments";

/// Frames between two kept states: a step back costs at most as many moments.
const keepEvery = 32;

/// Bodies whose pose or sleep differs from the state shown before.
export type Changed = number[] | "all";

/// How a body came to be as it is.
export interface Since {
  step: number;
  /// None: it has been awake since it appeared.
  event: SleepEvent | null;
}

export class Timeline {
  /// Of each frame.
  readonly step: number[] = [];
  readonly awake: number[] = [];
  readonly asleep: number[] = [];
  readonly woken: number[] = [];
  readonly avalanches: number[] = [];
  /// Kinds of warning that appeared first in it.
  readonly newWarnings: number[] = [];
  readonly piles: Pile[][] = [];
  readonly instruments: (Instruments | null)[] = [];
  /// Mean wall time of a step since the frame before [ms]; null: not known.
  readonly msPerStep: (number | null)[] = [];
  /// Whether any frame has contacts.
  hasContacts = false;
  /// The scene's events so far.
  readonly happened: SceneEvent[] = [];
  /// The last text of each kind, by kind.
  readonly warnings = new Map<number, Warning>();
  /// Steps that neighbours lie apart at most where the server left frames out; 0: it did not.
  thinned = 0;
  /// The frame shown, -1 before the first.
  shown = -1;
  /// More is known of the frame shown than is drawn.
  private stale = false;
  state: State;
  /// The state after the last frame.
  readonly newest: State;
  /// What is drawn: `state`, or one between it and the next.
  drawn: State;

  /// Step, poses and removed bodies of the frame before the one shown.
  private before: Pick<State, "step" | "bodies" | "pose" | "removed"> | null = null;
  /// Of each frame; more than one where a step was told again.
  private readonly moments: Moment[][] = [];
  private readonly kept: State[] = [];
  /// By body. While a run goes on, an event may come before the frame in which its body appears.
  private readonly events: SleepEvent[][] = [];
  private readonly born: number[] = [];

  constructor(
    readonly head: Head,
    layouts: Layouts,
  ) {
    this.state = this.drawn = new State(head.dimension, layouts);
    this.newest = new State(head.dimension, layouts);
  }

  get frames(): number {
    return this.step.length;
  }

  time(frame: number): number {
    return this.step[frame] * this.head.dt;
  }

  /// Adds a moment: as a frame, or to the last frame where that is of the same step.
  add(moment: Moment): void {
    const again = this.step.at(-1) === moment.step;
    const frame = again ? this.frames - 1 : this.frames;
    this.newest.apply(moment);
    if (again) this.moments[frame].push(moment);
    else this.moments.push([moment]);
    if (frame % keepEvery === 0) this.kept[frame / keepEvery] = this.newest.copy();
    if (again && this.shown === frame) this.stale = true;
    this.hasContacts ||= moment.contacts.length > 0;
    this.happened.push(...moment.sceneEvents);
    for (let body = this.born.length; body < this.newest.bodies; ++body) this.born.push(moment.step);
    for (const event of moment.events) (this.events[event.body] ??= []).push(event);
    const woken = moment.events.filter((event) => event.woke);
    const put = <Value>(list: Value[], value: Value, sum: (before: Value) => Value = () => value): void => {
      list[frame] = again ? sum(list[frame]) : value;
    };
    const count = (list: number[], value: number): void => put(list, value, (before) => before + value);
    put(this.step, moment.step);
    put(this.awake, this.newest.awake);
    put(this.asleep, this.newest.asleepCount);
    put(this.msPerStep, this.newest.msPerStep, (before) => before ?? this.newest.msPerStep);
    put(this.piles, moment.piles);
    put(this.instruments, moment.instruments);
    count(this.newWarnings, this.takeWarnings(moment));
    count(this.woken, woken.length);
    count(this.avalanches, woken.filter((event) => event.cause === "avalanche").length);
  }

  /// How many kinds of warning are new.
  private takeWarnings({ stats }: Moment): number {
    const before = this.warnings.size;
    stats?.warning_kind.forEach((kind, i) => this.warnings.set(kind, { kind, step: stats.warning_step[i], text: stats.warning_text[i] }));
    return this.warnings.size - before;
  }

  /// Shows a frame; returns what changed.
  seek(frame: number): Changed {
    const between = this.drawn !== this.state;
    const changed = this.goTo(frame);
    this.drawn = this.state;
    return between ? "all" : changed;
  }

  private goTo(frame: number): Changed {
    if (frame === this.shown && !this.stale) return [];
    this.stale = false;
    if (frame === this.shown + 1) return this.goOn();
    const nearest = Math.floor(Math.max(0, frame - 1) / keepEvery); // so that the frame before is passed
    if (this.shown > frame || this.shown < nearest * keepEvery || frame === this.shown) {
      this.state = this.kept[nearest].copy();
      this.shown = nearest * keepEvery;
      this.before = null;
    }
    while (this.shown < frame) this.goOn();
    return "all";
  }

  /// To the next frame.
  private goOn(): number[] {
    const { step, bodies, pose, removed } = this.state;
    this.before = this.shown < 0 ? null : { step, bodies, pose: pose.slice(), removed: removed.slice() };
    return this.moments[++this.shown].flatMap((moment) => this.state.apply(moment));
  }

  /// Mean speed of an awake body since the frame before [m/s]; null: it sleeps, or was not there.
  speed(body: number): number | null {
    const { before, state } = this;
    if (!before || body >= before.bodies || before.removed[body] !== 0 || state.asleep[body] !== 0) return null;
    const { dimension, dt, sides } = this.head;
    const at = poseValues(dimension) * body;
    const [from, to] = [before, state].map(({ pose }) => Array.from(pose.subarray(at, at + dimension)));
    const way = Math.hypot(...near(sides, to, from).map((value, axis) => value - from[axis]));
    return way / Math.max(dt, (state.step - before.step) * dt);
  }

  /// Steps between two frames above which frames are missing between them: what happened there is not known.
  gap(): number {
    return 2.5 * Math.max(this.meanSteps(), this.thinned);
  }

  private meanSteps(): number {
    return this.frames > 1 ? (this.step[this.frames - 1] - this.step[0]) / (this.frames - 1) : 1;
  }

  /// Whether frames are missing before this one.
  lacksBefore(frame: number): boolean {
    return frame > 0 && this.step[frame] - this.step[frame - 1] > this.gap();
  }

  /// The last frame at or before a time.
  frameAt(time: number): number {
    const step = time / this.head.dt + 1e-6;
    let low = 0;
    for (let high = this.frames; low < high; ) {
      const middle = (low + high) >> 1;
      if (this.step[middle] <= step) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  /// Shows the moment of a time: poses between those of the two nearest frames, all else as in the one before.
  seekTime(time: number): Changed {
    this.seek(this.frameAt(time));
    this.drawn = this.stateAt(time);
    return "all";
  }

  private stateAt(time: number): State {
    const { state } = this;
    const step = time / this.head.dt;
    if (step <= state.step + 1e-6 || this.shown + 1 >= this.frames) return state;
    const next = state.copy();
    for (const moment of this.moments[this.shown + 1]) next.apply(moment);
    const share = Math.min(1, (step - state.step) / Math.max(1e-9, next.step - state.step));
    const between = state.copy();
    const { dimension, sides } = this.head;
    const width = poseValues(dimension);
    for (let at = 0; at < between.pose.length; at += width) {
      const [from, to] = [state, next].map(({ pose }) => pose.subarray(at, at + width));
      to.set(near(sides, Array.from(to.subarray(0, dimension)), from));
      between.pose.set(mixedPose(from, to, share), at);
    }
    for (const [obstacle, pose] of between.obstacles) between.obstacles.set(obstacle, mixedPose(pose, next.obstacles.get(obstacle) ?? pose, share));
    return between;
  }

  /// What happened until the frame shown, and its text.
  happenedSoFar(): SceneEvent[] {
    return this.happened.filter(({ step }) => step <= this.state.step);
  }

  textOf({ number }: SceneEvent): string {
    return this.head.events[number]?.text ?? `event ${number}`;
  }

  /// Why a body is as it is in the frame shown.
  since(body: number): Since {
    const events = this.events[body] ?? [];
    for (let i = events.length - 1; i >= 0; --i)
      if (events[i].step <= this.state.step) return { step: events[i].step, event: events[i] };
    return { step: this.born[body] ?? 0, event: null };
  }
}
