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
  /// Wall time of a step when the frame came [ms]; empty for a record, which has none.
  readonly msPerStep: (number | null)[] = [];
  /// The scene's events so far.
  readonly happened: SceneEvent[] = [];
  /// The last text of each kind, by kind.
  readonly warnings = new Map<number, Warning>();
  /// The frame shown, -1 before the first.
  shown = -1;
  state: State;

  private readonly blocks: Uint8Array[] = [];
  private readonly kept: State[] = [];
  /// By body. While a run goes on, an event may come before the frame in which its body appears.
  private readonly events: SleepEvent[][] = [];
  private readonly born: number[] = [];
  private readonly last: State;
  private readonly avalanche: number;

  constructor(readonly head: Head) {
    this.state = new State(head.dimension);
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
    this.woken.push(woken.length);
    this.avalanches.push(woken.filter((event) => event.cause === this.avalanche).length);
    this.piles.push(this.last.piles);
    return reader.at;
  }

  /// Shows a frame; returns what changed.
  seek(frame: number): Changed {
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

  /// Positions of all bodies [m] in the frame shown, moved on in a straight line to `step`, which must lie before the next
  /// frame; NaN for removed ones.
  placesAt(step: number): Float64Array {
    const { dimension, quantum } = this.head;
    const components = dimension === 2 ? 3 : 7;
    const { state } = this;
    const between = step > state.step && this.shown + 1 < this.frames;
    const next = between ? state.copy() : state;
    if (between) next.apply(new Reader(this.blocks[this.shown + 1]));
    const share = between ? (step - state.step) / (next.step - state.step) : 0;
    return Float64Array.from({ length: dimension * state.bodies }, (_, i) => {
      const [body, axis] = [Math.floor(i / dimension), i % dimension];
      if (state.removed[body] !== 0) return NaN;
      const at = components * body + axis;
      return quantum.position * (state.pose[at] + share * (next.pose[at] - state.pose[at]));
    });
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
