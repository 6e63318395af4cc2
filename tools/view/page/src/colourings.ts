// What the colour of a body tells, and the legend of that.

import { causes } from "./causes";
import { css, force, onRamp, type Paint, ramp } from "./colours";
import type { ContactPanel } from "./contact_panel";
import { colourOfState, type Rgb } from "./head";
import { layerOf } from "./pile_layers";
import { roundUp, withUnit } from "./scale";
import type { Timeline } from "./timeline";

/// A line of a legend: boxes of these colours, or one band from the first to the last between two values.
export interface Entry {
  colours: Rgb[];
  ends?: [string, string];
  count?: number;
  text: string;
}

interface Coloured {
  paint: Paint;
  legend: Entry[];
}

export const ways = { state: "state", cause: "cause", speed: "speed", age: "time asleep", layer: "layer", force: "contact force" };
export type Way = keyof typeof ways;

/// Each colour once.
const different = (colours: Rgb[]): Rgb[] => [...new Map(colours.map((colour) => [css(colour), colour])).values()];

export class Colouring {
  way: Way = "state";
  /// Upper ends of the scales so far, which only grow, so that a colour keeps its meaning while time goes on.
  private readonly reached = new Map<Way, number>();

  constructor(
    private readonly timeline: () => Timeline,
    private readonly contacts: ContactPanel,
  ) {}

  /// Another run.
  forget(): void {
    this.reached.clear();
  }

  private plain(): Paint {
    const { state, head } = this.timeline();
    return (body) => colourOfState(head.shapes[state.shape[body]], state.asleep[body] !== 0, head.colours);
  }

  private present(): number[] {
    const { state } = this.timeline();
    return Array.from({ length: state.bodies }, (_, body) => body).filter((body) => state.removed[body] === 0);
  }

  /// For the frame shown.
  now(): Coloured {
    const { head, state } = this.timeline();
    switch (this.way) {
      case "state":
        return { paint: this.plain(), legend: this.states() };
      case "cause":
        return this.byCause();
      case "speed":
        return this.byNumber((body) => this.timeline().speed(body), (value) => withUnit(value, "m/s"), ramp);
      case "age":
        return this.byNumber((body) => (state.asleep[body] === 0 ? null : (state.step - this.timeline().since(body).step) * head.dt), (value) => withUnit(value, "s"), [...ramp].reverse());
      case "layer":
        return this.byNumber((body) => layerOf(state, head.dimension, body)?.number ?? null, (value) => `layer ${value}`, ramp, Math.max(1, ...state.piles.map(({ layers }) => layers.length - 1)));
      case "force": {
        const forces = this.contacts.forces(state);
        return this.byNumber((body) => forces?.get(body) ?? null, (value) => withUnit(value, "N"), force);
      }
    }
  }

  private states(): Entry[] {
    const { state, head } = this.timeline();
    const named = head.coloured_shapes.map(({ name, colour }): Entry => ({ colours: [colour], text: name }));
    const of = (asleep: boolean): Rgb[] => different(head.shapes.map((shape) => colourOfState(shape, asleep, head.colours)));
    return [
      { colours: of(false), count: state.awake, text: "awake" },
      { colours: of(true), count: state.asleepCount, text: named.length > 0 ? "asleep (darker)" : "asleep" },
      ...named,
    ];
  }

  private byCause(): Coloured {
    const timeline = this.timeline();
    const { state } = timeline;
    const plain = this.plain();
    const causeOf = (body: number): string => {
      const { event } = timeline.since(body);
      return event && event.woke === (state.asleep[body] === 0) ? event.cause : "";
    };
    const paint: Paint = (body) => causes[causeOf(body)]?.colour ?? plain(body);
    const rows = new Map<string, Entry>();
    for (const body of this.present()) {
      const awake = state.asleep[body] === 0;
      const cause = causeOf(body);
      const text = cause !== "" ? `${awake ? "awake" : "asleep"}: ${cause}` : awake ? "awake since it appeared" : "asleep";
      const row = rows.get(text) ?? { colours: [paint(body)], count: 0, text };
      ++row.count!;
      rows.set(text, row);
    }
    return { paint, legend: [...rows.values()].sort((a, b) => a.text.localeCompare(b.text)) };
  }

  /// From 0 to `most`, or to a round number above all values so far. Bodies without a value have the colour of their state.
  private byNumber(valueOf: (body: number) => number | null, textOf: (value: number) => string, colours: Rgb[], most?: number): Coloured {
    const { state, head } = this.timeline();
    const plain = this.plain();
    const values = new Map<number, number>();
    for (const body of this.present()) {
      const value = valueOf(body);
      if (value !== null) values.set(body, value);
    }
    // One body in fifty may be beyond the scale, of forces one in five: a fast body, or an impact and what it presses on,
    // would leave all others in one colour.
    const sorted = [...values.values()].sort((a, b) => a - b);
    const within = this.way === "force" ? 0.8 : 0.98;
    const high = most ?? Math.max(this.reached.get(this.way) ?? 0, roundUp(sorted[Math.floor(within * sorted.length)] ?? 0));
    this.reached.set(this.way, high);
    const rest = (asleep: number): number => this.present().filter((body) => !values.has(body) && state.asleep[body] === asleep).length;
    const others = [0, 1].map((asleep): Entry => ({ colours: different(head.shapes.map((shape) => colourOfState(shape, asleep === 1, head.colours))), count: rest(asleep), text: asleep ? "asleep" : "awake" }));
    const paint: Paint = (body) => (values.has(body) ? onRamp(colours, high > 0 ? values.get(body)! / high : 0) : plain(body));
    return { paint, legend: [{ colours, ends: [textOf(0), textOf(high)], count: values.size, text: ways[this.way] }, ...others.filter(({ count }) => count! > 0)] };
  }
}
