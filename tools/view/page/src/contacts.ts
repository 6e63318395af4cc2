// Contacts of the frames of a simulation, as the server sends them (tools/serve/shown_run.cc).

import type { Point } from "./head";

/// Frames whose contacts are kept, the newest.
const mostFrames = 1000;

export interface Contact {
  a: number;
  /// A body, or -1 for the ground, below for obstacles.
  b: number;
  /// Both sides sleep: the forces are those of the last step before.
  kept: boolean;
  point: Point;
  /// On `a` [N].
  normalForce: Point;
}

/// Of each contact a, b, 1 where it is kept, then a number for each axis of point, normal force and friction force.
export interface ContactsText {
  step: number;
  contacts: number[][];
}

/// What two sides exert on each other, all their contacts together.
export interface Chain {
  a: number;
  b: number;
  /// Of the first contact.
  point: Point;
  force: number;
  kept: boolean;
}

/// Of the contacts of a frame, one for each pair of bodies; of a body and an obstacle or the ground one for each point.
export function chainsOf(contacts: Contact[]): Chain[] {
  const chains = new Map<string, Chain>();
  contacts.forEach(({ a, b, kept, point, normalForce }, i) => {
    const key = b < 0 ? `${i}` : `${Math.min(a, b)}-${Math.max(a, b)}`;
    const chain = chains.get(key);
    if (chain) chain.force += magnitude(normalForce);
    else chains.set(key, { a, b, kept, point, force: magnitude(normalForce) });
  });
  return [...chains.values()];
}

export const magnitude = (force: Point): number => Math.hypot(...force);

export class Contacts {
  /// By step, in the order in which they came.
  private readonly frames = new Map<number, number[][]>();

  constructor(private readonly dimension: 2 | 3) {}

  add({ step, contacts }: ContactsText): void {
    this.frames.set(step, contacts);
    if (this.frames.size > mostFrames) this.frames.delete(this.frames.keys().next().value!);
  }

  /// Of the frame of a step; null where none were sent with it, or no longer are kept.
  of(step: number): Contact[] | null {
    const axes = this.dimension;
    return this.frames.get(step)?.map(([a, b, kept, ...values]) => ({ a, b, kept: kept === 1, point: values.slice(0, axes), normalForce: values.slice(axes, 2 * axes) })) ?? null;
  }
}
