// Contacts of the frames of a simulation (tools/view/contact_stream.h).

import { Reader } from "./frames";
import type { Head, Point } from "./head";

/// Frames whose contacts are kept, the newest: a frame of many bodies has more bytes of contacts than of poses.
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
  frictionForce: Point;
}

export const magnitude = (force: Point): number => Math.hypot(...force);

export class Contacts {
  private readonly frames = new Map<number, Uint8Array>();

  constructor(private readonly head: Head) {}

  add(frame: number, bytes: Uint8Array): void {
    this.frames.set(frame, bytes);
    this.frames.delete(frame - mostFrames);
  }

  /// Of a frame; null where none were sent with it, or no longer are kept.
  of(frame: number): Contact[] | null {
    const bytes = this.frames.get(frame);
    if (!bytes) return null;
    const reader = new Reader(bytes);
    const { dimension, quantum } = this.head;
    const each = (read: (axis: number) => number): Point => Array.from({ length: dimension }, (_, axis) => read(axis));
    const counts = each(() => 0);
    return Array.from({ length: reader.unsigned() }, () => ({
      a: reader.unsigned(),
      b: reader.signed(),
      kept: reader.unsigned() === 1,
      point: each((axis) => quantum.position * (counts[axis] += reader.signed())),
      normalForce: each(() => reader.float()),
      frictionForce: each(() => reader.float()),
    }));
  }
}
