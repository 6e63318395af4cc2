// All frames of a run so far, and the one that is shown.

import { type Pile, Reader, type SceneEvent, type SleepEvent, State, type Warning } from "./frames";
import type { Head } from "./head";

/// Frames between two kept states: a step back costs at most as many blocks.
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
  /// Mean wall time of a step since the frame before [ms]; null: not known.
  readonly msPerStep: (number | null)[] = [];
  /// The scene's events so far.
  readonly happened: SceneEvent[] = [];
  /// The last text of each kind, by kind.
  readonly warnings = new Map<number, Warning>();
  /// Steps that neighbours lie apart at most where the server left frames out; 0: it did not.
  thinned = 0;
  /// The frame shown, -1 before the first.
  shown = -1;
  state: State;
  /// What is drawn: `state`, or one between it and the next.
  drawn: State;

  private readonly blocks: Uint8Array[] = [];
  private readonly kept: State[] = [];
  /// By body. While a run goes on, an event may come before the frame in which its body appears.
  private readonly events: SleepEvent[][] = [];
  private readonly born: number[] = [];
  private readonly last: State;
  private readonly avalanche: number;

  constructor(readonly head: Head) {
    this.state = this.drawn = new State(head.dimension);
    this.last = new State(head.dimension);
    this.avalanche = head.causes.findIndex((cause) => cause?.name === "avalanche");
  }

  get frames(): number {
    return this.step.length;
  }

  time(frame: number): number {
    return this.step[frame] * this.head.dt;
  }

  /// Frames one after the other.
  addAll(blocks: Uint8Array): void {
    for (let at = 0; at < blocks.length; ) at += this.add(blocks.subarray(at));
  }

  /// Takes the frame at the begin of `bytes`; returns its size.
  add(bytes: Uint8Array): number {
    const reader = new Reader(bytes);
    const { events, warnings, sceneEvents } = this.last.apply(reader);
    this.happened.push(...sceneEvents);
    this.blocks.push(bytes.slice(0, reader.at)); // a copy: more may follow it in `bytes`, which is not kept
    if (this.frames % keepEvery === 0) this.kept.push(this.last.copy());
    for (let body = this.born.length; body < this.last.bodies; ++body) this.born.push(this.last.step);
    for (const event of events) (this.events[event.body] ??= []).push(event);
    this.newWarnings.push(warnings.filter(({ kind }) => !this.warnings.has(kind)).length);
    for (const warning of warnings) this.warnings.set(warning.kind, warning);
    const woken = events.filter((event) => event.woke);
    this.step.push(this.last.step);
    this.awake.push(this.last.awake);
    this.asleep.push(this.last.asleepCount);
    this.msPerStep.push(this.last.msPerStep < 0 ? null : this.last.msPerStep);
    this.woken.push(woken.length);
    this.avalanches.push(woken.filter((event) => event.cause === this.avalanche).length);
    this.piles.push(this.last.piles);
    return reader.at;
  }

  /// Shows a frame; returns what changed.
  seek(frame: number): Changed {
    const between = this.drawn !== this.state;
    const changed = this.goTo(frame);
    this.drawn = this.state;
    return between ? "all" : changed;
  }

  private goTo(frame: number): Changed {
    if (frame === this.shown) return [];
    if (frame === this.shown + 1) {
      const { changed } = this.state.apply(new Reader(this.blocks[frame]));
      this.shown = frame;
      return changed;
    }
    const nearest = Math.floor(frame / keepEvery);
    const forward = this.shown < frame && this.shown >= nearest * keepEvery;
    if (!forward) this.state = this.kept[nearest].copy();
    for (let next = forward ? this.shown + 1 : nearest * keepEvery + 1; next <= frame; ++next)
      this.state.apply(new Reader(this.blocks[next]));
    this.shown = frame;
    return "all";
  }

  /// Steps between two frames above which frames are missing between them: what happened there is not known.
  gap(): number {
    const usual = this.head.steps_per_frame ?? this.meanSteps();
    return 2.5 * Math.max(usual, this.thinned);
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
    next.apply(new Reader(this.blocks[this.shown + 1]));
    const share = Math.min(1, (step - state.step) / Math.max(1e-9, next.step - state.step));
    const between = state.copy();
    const mixed = (a: number, b: number): number => a + share * (b - a);
    for (let i = 0; i < between.pose.length; ++i) between.pose[i] = Math.round(mixed(state.pose[i], next.pose[i]));
    for (const [obstacle, pose] of between.obstacles) {
      const then = next.obstacles.get(obstacle) ?? pose;
      between.obstacles.set(obstacle, pose.map((part, i) => mixed(part, then[i])));
    }
    return between;
  }

  /// What happened until the frame shown, and its text.
  happenedSoFar(): SceneEvent[] {
    const now = this.state.step * this.head.dt;
    return this.happened.filter(({ time }) => time < now - 1e-6);
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
