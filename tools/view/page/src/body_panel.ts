// What is known of the body that was clicked, and why it sleeps or not.

import { element } from "./element";
import { causes } from "./causes";
import { withUnit } from "./scale";
import type { Timeline } from "./timeline";

/// A number that the policy goes by.
interface Reading {
  name: string;
  value: number;
  threshold?: number;
  unit: string;
  effect: string;
}

/// What only the simulation knows of a body (tools/serve/body_account.h).
export interface Account {
  body: number;
  step: number;
  supports?: { on: number; name: string; force?: number }[];
  readings?: Reading[];
}

const digits = (value: number): string => String(Number(value.toPrecision(3)));

function textOf({ name, value, threshold, unit, effect }: Reading): string {
  const amount = (number: number): string => `${digits(number)}${unit ? ` ${unit}` : ""}`;
  if (threshold !== undefined) return `${name}: ${amount(value)} (above ${amount(threshold)} ${effect})`;
  return effect || unit ? `${name} ${amount(value)}, ${effect}` : name;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

export class BodyPanel {
  /// The newest one.
  account: Account | null = null;

  /// `newest`: the frame shown is that of the simulation now, so that its account of the body holds.
  show(timeline: Timeline, body: number, newest: boolean): void {
    const { state } = timeline;
    if (body < 0 || body >= state.bodies) {
      const hint = Object.assign(document.createElement("p"), { className: "hint", textContent: body < 0 ? "Click a body to see why it sleeps." : `Body ${body} has not appeared yet.` });
      element("body").replaceChildren(hint);
      return;
    }
    const texts = [...this.describe(timeline, body), ...(newest ? this.now(body) : [])];
    element("body").replaceChildren(...texts.map((text) => Object.assign(document.createElement("p"), { textContent: text })));
  }

  /// Which body, since when it is as it is, and why.
  describe(timeline: Timeline, body: number): string[] {
    const { state, head } = timeline;
    const { step, event } = timeline.since(body);
    const awake = state.asleep[body] === 0;
    const since = `since ${(step * head.dt).toFixed(2)} s (step ${step})`;
    const lines = [`Body ${body}, shape ${head.shapes[state.shape[body]]?.name ?? ""}`];
    if (state.removed[body] !== 0) return [...lines, "removed"];
    lines.push(`${awake ? "Awake" : "Asleep"} ${event ? since : `${since}, when it appeared`}`);
    const cause = event ? causes[event.cause] : null;
    if (event && cause) lines.push(`Cause: ${cause.name} (${event.woke ? cause.woke : cause.slept})`);
    if (event && event.score > 0) {
      const threshold = head.score_threshold >= 0 && cause?.name === "score" ? `, threshold ${digits(head.score_threshold)}` : "";
      lines.push(`Score ${digits(event.score)} when it fell asleep${threshold}`);
    }
    const layer = layerOf(timeline, body);
    lines.push(layer === null ? "In no layer" : `Layer ${layer.layer} from the bottom of pile ${layer.pile}, density ${layer.density.toFixed(2)}${layer.wake > 0 ? `, the pile wakes above ${layer.wake.toFixed(2)}` : ""}`);
    return lines;
  }

  /// From the account, if it is of this body.
  private now(body: number): string[] {
    if (this.account?.body !== body) return [];
    const { supports, readings } = this.account;
    const lines: string[] = [];
    if (supports) {
      const each = supports.map(({ name, force }) => (force === undefined ? name : `${name} (${withUnit(force, "N")})`));
      lines.push(each.length > 0 ? `Rests on ${each.join(", ")}` : "Rests on nothing");
    }
    for (const reading of readings ?? []) lines.push(capital(textOf(reading)));
    return lines;
  }
}

/// Layer in which the centre of a body lies; the first pile counts.
function layerOf({ state, head }: Timeline, body: number): { pile: number; layer: number; density: number; wake: number } | null {
  const axes = head.dimension;
  const components = axes === 2 ? 3 : 7;
  const at = Array.from({ length: axes }, (_, i) => state.pose[components * body + i]);
  for (const [pile, { centre, layers }] of state.piles.entries()) {
    const height = at[axes - 1] - centre[axes - 1];
    const away = Math.hypot(...at.slice(0, -1).map((value, i) => value - centre[i]));
    const layer = layers.findIndex(({ bottom, top, radius }) => height >= bottom && height < top && away <= radius);
    if (layer >= 0) return { pile, layer, density: layers[layer].density, wake: layers[layer].wake_density };
  }
  return null;
}
