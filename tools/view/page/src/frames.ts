// Blocks of frames (tools/view/frame_stream.h), and the state that they add up to.

/// Reads the numbers of a block.
export class Reader {
  private readonly view: DataView;

  constructor(
    private readonly bytes: Uint8Array,
    public at = 0,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  done(): boolean {
    return this.at >= this.bytes.length;
  }

  unsigned(): number {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      if (this.at >= this.bytes.length) throw new RangeError("the block ends within a number");
      const byte = this.bytes[this.at++];
      value += (byte & 0x7f) * scale;
      if (byte < 0x80) return value;
    }
  }

  signed(): number {
    const value = this.unsigned();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  float(): number {
    const value = this.view.getFloat32(this.at, true);
    this.at += 4;
    return value;
  }

  text(): string {
    const length = this.unsigned();
    this.at += length;
    return new TextDecoder().decode(this.bytes.subarray(this.at - length, this.at));
  }

  bodies(): number[] {
    const list = new Array<number>(this.unsigned());
    let body = -1;
    for (let i = 0; i < list.length; ++i) list[i] = body += this.unsigned();
    return list;
  }
}

/// A pile at one frame. Never changed: frames share what is equal.
export interface Pile {
  centre: number[];
  slope: number;
  lift: number;
  height: number;
  radius: number;
  layers: Layer[];
  /// Bodies and sleepers of each layer in turn.
  counts: Int32Array;
}

/// Lengths in m, `bottom` and `top` above the pile's base.
export interface Layer {
  bottom: number;
  top: number;
  radius: number;
  capacity: number;
  /// Up to it no body of the layer falls asleep; below 0: the policy has no such threshold.
  sleepDensity: number;
  /// Above it the pile wakes; below 0: none.
  wakeDensity: number;
}

export interface SleepEvent {
  step: number;
  body: number;
  woke: boolean;
  cause: number;
  pile: number;
  layer: number;
  score: number;
}

export interface Warning {
  kind: number;
  step: number;
  text: string;
}

/// An event of the scene, by its number, with its time [s].
export interface SceneEvent {
  number: number;
  time: number;
}

/// What a block has beside the state.
export interface News {
  /// Bodies whose pose or sleep changed.
  changed: number[];
  events: SleepEvent[];
  warnings: Warning[];
  sceneEvents: SceneEvent[];
}

/// All bodies at one frame. Poses are in quanta.
export class State {
  step = 0;
  bodies = 0;
  awake = 0;
  asleepCount = 0;
  kineticEnergy = 0;
  /// Of the sleeping bodies [D], below 0: not known.
  drift = -1;
  /// Of the largest pile [rad], fitted to its bodies at rest; below 0: not measured.
  measuredSlope = -1;
  /// Wall time [ms], below 0: not known.
  msPerStep = -1;
  piles: Pile[] = [];
  shape = new Uint16Array(64);
  asleep = new Uint8Array(64);
  removed = new Uint8Array(64);
  /// Enclosed by sleeping bodies: neither sent nor drawn.
  hidden = new Uint8Array(64);
  pose: Int32Array;
  /// Poses of the obstacles that move, by number.
  obstacles = new Map<number, number[]>();
  private readonly components: number;

  constructor(private readonly dimension: 2 | 3) {
    this.components = dimension === 2 ? 3 : 7;
    this.pose = new Int32Array(64 * this.components);
  }

  copy(): State {
    const copy = new State(this.dimension);
    copy.step = this.step;
    copy.bodies = this.bodies;
    copy.awake = this.awake;
    copy.asleepCount = this.asleepCount;
    copy.kineticEnergy = this.kineticEnergy;
    copy.drift = this.drift;
    copy.measuredSlope = this.measuredSlope;
    copy.msPerStep = this.msPerStep;
    copy.piles = this.piles;
    copy.shape = this.shape.slice(0, this.bodies);
    copy.asleep = this.asleep.slice(0, this.bodies);
    copy.removed = this.removed.slice(0, this.bodies);
    copy.hidden = this.hidden.slice(0, this.bodies);
    copy.pose = this.pose.slice(0, this.bodies * this.components);
    for (const [obstacle, pose] of this.obstacles) copy.obstacles.set(obstacle, [...pose]);
    return copy;
  }

  apply(reader: Reader): News {
    this.step = reader.unsigned();
    const before = this.bodies;
    this.grow(before + reader.unsigned());
    const changed: number[] = [];
    for (let body = before; body < this.bodies; ++body) {
      this.shape[body] = reader.unsigned();
      changed.push(body);
    }
    for (const body of reader.bodies()) {
      this.removed[body] ^= 1;
      changed.push(body);
    }
    for (const body of reader.bodies()) {
      this.asleep[body] ^= 1;
      changed.push(body);
    }
    for (const body of reader.bodies()) {
      this.hidden[body] ^= 1;
      changed.push(body);
    }
    const moved = reader.bodies();
    for (let i = 0; i < this.components; ++i)
      for (const body of moved) this.pose[body * this.components + i] += reader.signed();
    for (const body of moved) changed.push(body);
    const events = this.readEvents(reader);
    this.readPiles(reader);
    this.kineticEnergy = reader.float();
    this.drift = reader.float();
    this.measuredSlope = reader.float();
    this.msPerStep = reader.float();
    const warnings: Warning[] = [];
    for (let left = reader.unsigned(); left > 0; --left)
      warnings.push({ kind: reader.unsigned(), step: reader.unsigned(), text: reader.text() });
    const sceneEvents = Array.from({ length: reader.unsigned() }, () => ({ number: reader.unsigned(), time: reader.float() }));
    this.readObstacles(reader);
    this.count();
    return { changed, events, warnings, sceneEvents };
  }

  private readObstacles(reader: Reader): void {
    const moved = reader.bodies();
    for (const obstacle of moved) if (!this.obstacles.has(obstacle)) this.obstacles.set(obstacle, new Array<number>(this.components).fill(0));
    for (let i = 0; i < this.components; ++i) for (const obstacle of moved) this.obstacles.get(obstacle)![i] += reader.signed();
  }

  private grow(bodies: number): void {
    this.bodies = bodies;
    if (bodies <= this.shape.length && bodies * this.components <= this.pose.length) return;
    const room = 2 * bodies;
    const grown = <T extends { set(from: T): void }>(to: T, from: T): T => (to.set(from), to);
    this.shape = grown(new Uint16Array(room), this.shape);
    this.asleep = grown(new Uint8Array(room), this.asleep);
    this.removed = grown(new Uint8Array(room), this.removed);
    this.hidden = grown(new Uint8Array(room), this.hidden);
    this.pose = grown(new Int32Array(room * this.components), this.pose);
  }

  private count(): void {
    this.awake = this.asleepCount = 0;
    for (let body = 0; body < this.bodies; ++body)
      if (this.removed[body] === 0) {
        if (this.asleep[body] === 0) ++this.awake;
        else ++this.asleepCount;
      }
  }

  private readEvents(reader: Reader): SleepEvent[] {
    const events: SleepEvent[] = [];
    for (let left = reader.unsigned(); left > 0; --left) {
      const body = reader.unsigned();
      const step = this.step - reader.unsigned();
      const code = reader.unsigned();
      const pile = reader.unsigned() - 1;
      const layer = reader.unsigned() - 1;
      events.push({ step, body, woke: code % 2 === 1, cause: code >> 1, pile, layer, score: reader.float() });
    }
    return events;
  }

  private readPiles(reader: Reader): void {
    const piles = this.piles.slice(0, reader.unsigned());
    for (let left = reader.unsigned(); left > 0; --left) {
      const number = reader.unsigned();
      const old = piles[number];
      const numbers = reader.unsigned();
      const form = numbers > 0 ? this.readForm(reader, numbers) : old;
      const counts = new Int32Array(reader.unsigned());
      if (numbers === 0) counts.set(old.counts);
      for (let i = 0; i < counts.length; ++i) counts[i] += reader.signed();
      piles[number] = { ...form, counts };
    }
    this.piles = piles;
  }

  private readForm(reader: Reader, numbers: number): Pile {
    const centre = Array.from({ length: this.dimension }, () => reader.float());
    const [slope, lift, height, radius] = [reader.float(), reader.float(), reader.float(), reader.float()];
    const layers = Array.from({ length: (numbers - this.dimension - 4) / 6 }, () => {
      const [bottom, top] = [reader.float(), reader.float()];
      return { bottom, top, radius: reader.float(), capacity: reader.float(), sleepDensity: reader.float(), wakeDensity: reader.float() };
    });
    return { centre, slope, lift, height, radius, layers, counts: new Int32Array() };
  }
}

export const density = (pile: Pile, layer: number): number =>
  pile.layers[layer].capacity > 0 ? pile.counts[2 * layer] / pile.layers[layer].capacity : 0;
