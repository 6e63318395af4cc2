// Contact points with their forces (lcmtypes/talus_contacts.lcm).

import type { Point } from "./head";
import { decode, type Layouts, type Message } from "./messages";

export interface Contact {
  a: number;
  /// A body, or -1 for the ground, below for obstacles.
  b: number;
  /// No side is awake: the force is that which holds them, or held them as they fell asleep.
  kept: boolean;
  point: Point;
  /// On `a` [N].
  normalForce: Point;
}

interface ContactsMessage {
  a: Int32Array;
  b: Int32Array;
  kept: Uint8Array;
  values: Float32Array;
}

/// Of the messages of a frame.
export function contactsOf(messages: Message[], layouts: Layouts, dimension: 2 | 3): Contact[] {
  const axes = dimension === 2 ? [0, 2] : [0, 1, 2];
  return messages.flatMap((message) => {
    const { a, b, kept, values } = decode<ContactsMessage>(message, layouts);
    const vector = (at: number): Point => axes.map((axis) => values[at + axis]);
    return Array.from(a, (body, i) => ({ a: body, b: b[i], kept: kept[i] === 1, point: vector(9 * i), normalForce: vector(9 * i + 3) }));
  });
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
