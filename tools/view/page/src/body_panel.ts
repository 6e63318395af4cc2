// A card beside the body that was clicked: what is known of it, and why it sleeps or not.

import { element, make } from "./element";
import { causes } from "./causes";
import { layerOf } from "./pile_layers";
import { withUnit } from "./scale";
import type { Stage } from "./stage";
import type { Timeline } from "./timeline";

/// A number that the policy goes by.
interface Reading {
  name: string;
  value: number;
  threshold?: number;
  unit: string;
  effect: string;
}

/// What of a body is only in the simulation (tools/serve/body_account.h).
export interface Account {
  body: number;
  step: number;
  supports?: { on: number; name: string; force?: number }[];
  readings?: Reading[];
}

const gap = 10; // between a body and its card [CSS pixels]
const edge = 8; // that the card keeps from the ends of the stage

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
    element("card").hidden = body < 0;
    if (body < 0) return;
    const texts = body < state.bodies ? [...this.describe(timeline, body), ...(newest ? this.now(body) : [])] : [`Body ${body} has not appeared yet.`];
    element("body").replaceChildren(...texts.map((textContent) => make("p", { textContent })));
  }

  /// Brings the card beside the body as it is drawn, where there is room.
  place(stage: Stage, timeline: Timeline): void {
    const card = element("card");
    const { state } = timeline;
    const body = stage.selected;
    if (card.hidden || body < 0 || body >= state.bodies) return;
    const area = element("stage");
    const { x, y } = stage.placeOf(body);
    const away = stage.radiusOf(body) + gap;
    const right = x + away + card.offsetWidth <= area.clientWidth - edge ? x + away : x - away - card.offsetWidth;
    const within = (value: number, room: number): number => Math.max(edge, Math.min(value, room - edge));
    const left = within(right, area.clientWidth - card.offsetWidth);
    const top = within(y - 24, area.clientHeight - card.offsetHeight);
    card.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
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
    if (event) lines.push(`Cause: ${event.cause} (${causes[event.cause]?.[event.woke ? "woke" : "slept"] ?? ""})`);
    if (event && event.score > 0) {
      const threshold = head.score_threshold >= 0 && event.cause === "score" ? `, threshold ${digits(head.score_threshold)}` : "";
      lines.push(`Score ${digits(event.score)} when it fell asleep${threshold}`);
    }
    const at = layerOf(state, head.dimension, body);
    const wakes = at && at.layer.wake_density > 0 ? `, the pile wakes above ${at.layer.wake_density.toFixed(2)}` : "";
    lines.push(at ? `Layer ${at.number} from the bottom of pile ${at.pile}, density ${at.layer.density.toFixed(2)}${wakes}` : "In no layer");
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
