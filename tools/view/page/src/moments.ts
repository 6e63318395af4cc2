// Moments of a run, put together from its messages, and the state that they add up to.

import { type Contact, contactsOf } from "./contacts";
import { decode, type Layouts, type Message } from "./messages";
import { poseValues } from "./pose";

// Of the message types, the fields that the page uses (lcmtypes/*.lcm).
interface Header {
  step: number;
}

export interface RunMessage extends Header {
  version: string;
  reason: string;
  scene: string;
  title: string;
  backend: string;
  policy: string;
  seed: number;
  dimension: 2 | 3;
  dt: number;
  steps: number;
  tolerance: number;
  score_threshold: number;
  ground: number;
  ground_height: number;
  side: Float64Array;
  period: Float64Array;
}

export interface ShapeMessage extends Header {
  obstacle: number;
  index: number;
  total: number;
  name: string;
  pose: Float64Array;
  colour: string;
  kind: Int8Array;
  length: Int32Array;
  values: Float64Array;
}

export interface EventMessage extends Header {
  number: number;
  happened_step: number;
  happened_time: number;
  action: string;
  text: string;
  /// Obstacles that it removes or adds.
  obstacle: Int32Array;
}

interface StatsMessage extends Header {
  planned: number;
  drift_estimate: number;
  slope: number;
  slope_reason: string;
  warning_kind: Int8Array;
  warning_step: Float64Array;
  warning_text: string[];
  timed: number;
  ms_emit: number;
  ms_step: number;
  ms_count: number;
  ms_decide: number;
  ms_apply: number;
}

interface PilesMessage extends PartMessage {
  piles: Pile[];
}

interface SleepMessage extends Header {
  body: Int32Array;
  pile: Int32Array;
  layer: Int32Array;
  woke: Uint8Array;
  cause: Int8Array;
  score: Float32Array;
}

interface ObstaclesMessage extends Header {
  obstacle: Int32Array;
  poses: Float32Array;
}

interface PartMessage extends Header {
  part: number;
  parts: number;
}

interface BodiesMessage extends PartMessage {
  key_frame: number;
  body_count: number;
  body: Int32Array;
  shape: Int16Array;
  asleep: Uint8Array;
  poses: Float32Array;
}

/// A pile at one moment. Never changed: moments share what is equal.
export interface Pile {
  /// As many numbers as the run has axes.
  centre: ArrayLike<number>;
  alpha: number;
  /// How many layers it has; `layers` are the lowest of them.
  layer_total: number;
  layers: Layer[];
}

/// Lengths in m, `bottom` and `top` above the pile's base.
export interface Layer {
  bottom: number;
  top: number;
  radius: number;
  capacity: number;
  /// Up to it no body of the layer falls asleep; below 0: the policy has no such threshold.
  sleep_density: number;
  /// Above it the pile wakes; below 0: none.
  wake_density: number;
  count: number;
  density: number;
}

export interface SleepEvent {
  step: number;
  body: number;
  woke: boolean;
  cause: string;
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
  step: number;
  time: number;
}

interface Gate {
  name: string;
  forward: number;
  backward: number;
  jammed: number;
  outline: Float32Array;
}

export interface Region {
  name: string;
  kind: number;
  low: Float64Array;
  high: Float64Array;
  bodies: number;
  packing: number;
  slope: number;
}

interface Load {
  name: string;
  known: number;
  force: Float64Array;
}

/// What the scene measures.
export interface Instruments {
  gates: Gate[];
  regions: Region[];
  loads: Load[];
}

interface InstrumentsMessage extends PartMessage, Instruments {}

/// What is new at a moment.
export interface Moment {
  step: number;
  /// All parts of TALUS_BODIES, decoded when they are shown: they are most of a run.
  bodies: Message[];
  /// The same of TALUS_CONTACTS; empty: none were told.
  contacts: Message[];
  piles: Pile[];
  stats: StatsMessage | null;
  /// The newest readings; null: the scene measures nothing.
  instruments: Instruments | null;
  obstacles: ObstaclesMessage[];
  events: SleepEvent[];
  sceneEvents: SceneEvent[];
}

/// Gathers the messages of a step, not decoded.
class Parts {
  private messages: Message[] = [];
  private step = -1;
  private parts = 0;

  /// All of the step where this one is the last, else null. Those of which one is missing are left out.
  take(message: Message, { step, part, parts }: PartMessage): Message[] | null {
    if (part === 0) [this.messages, this.step, this.parts] = [[], step, parts];
    if (part !== this.messages.length || step !== this.step || parts !== this.parts) this.step = -1;
    else this.messages.push(message);
    return part + 1 === parts && this.of(step).length > 0 ? this.messages : null;
  }

  /// Empty where not all of the step have come.
  of(step: number): Message[] {
    return step === this.step && this.messages.length === this.parts ? this.messages : [];
  }
}

/// Puts the moments of a run together. Those of lost messages are left out.
export class MomentReader {
  run: RunMessage | null = null;
  /// Eight hexadecimal digits.
  id = "";
  readonly shapes: ShapeMessage[] = [];
  readonly obstacles: ShapeMessage[] = [];
  /// By number.
  readonly sceneEvents: EventMessage[] = [];
  /// Goes up when a shape or an obstacle is told for the first time.
  form = 0;
  private piles: Pile[] = [];
  private nextPiles: Pile[] = [];
  private stats: StatsMessage | null = null;
  private instruments: Instruments | null = null;
  private nextInstruments: Instruments = { gates: [], regions: [], loads: [] };
  private news: Pick<Moment, "obstacles" | "events" | "sceneEvents"> = { obstacles: [], events: [], sceneEvents: [] };
  private readonly bodies = new Parts();
  private readonly contacts = new Parts();

  constructor(readonly layouts: Layouts) {}

  /// A whole moment where the message is the last of it, else null.
  take(message: Message): Moment | null {
    const read = <Fields>(): Fields => decode<Fields>(message, this.layouts);
    switch (message.channel) {
      case "TALUS_RUN":
        this.run = read<RunMessage>();
        this.id = Array.from(message.bytes.subarray(20, 24), (byte) => byte.toString(16).padStart(2, "0")).join("");
        break;
      case "TALUS_SHAPES":
        this.takeShape(read<ShapeMessage>());
        break;
      case "TALUS_EVENTS":
        this.takeEvent(read<EventMessage>());
        break;
      case "TALUS_PILES":
        this.takePiles(read<PilesMessage>());
        break;
      case "TALUS_STATS":
        this.stats = read<StatsMessage>();
        break;
      case "TALUS_INSTRUMENTS":
        this.takeInstruments(read<InstrumentsMessage>());
        break;
      case "TALUS_SLEEP":
        this.takeSleep(read<SleepMessage>());
        break;
      case "TALUS_OBSTACLES":
        this.news.obstacles.push(read<ObstaclesMessage>());
        break;
      case "TALUS_CONTACTS":
        this.contacts.take(message, decode<PartMessage>(message, this.layouts, false));
        break;
      case "TALUS_BODIES":
        return this.takeBodies(message, decode<PartMessage>(message, this.layouts, false));
    }
    return null;
  }

  /// How many bodies the scene's sources add in all, as far as it was told.
  get planned(): number {
    return this.stats?.planned ?? 0;
  }

  /// Whether frames can be drawn: the run and all its shapes are known.
  ready(): boolean {
    return this.run !== null && this.shapes.length > 0 && Object.keys(this.shapes).length === this.shapes[this.shapes.length - 1].total;
  }

  private takeShape(message: ShapeMessage): void {
    const known = message.obstacle ? this.obstacles : this.shapes;
    if (!known[message.index]) ++this.form;
    known[message.index] ??= message;
  }

  private takeEvent(message: EventMessage): void {
    const known = this.sceneEvents[message.number];
    if (known && known.happened_step >= 0) return;
    this.sceneEvents[message.number] = message;
    if (message.happened_step >= 0) this.news.sceneEvents.push({ number: message.number, step: message.happened_step, time: message.happened_time });
  }

  private takePiles({ part, parts, piles }: PilesMessage): void {
    const flat = this.run?.dimension === 2;
    const here = piles.map(({ centre, ...pile }) => ({ ...pile, centre: flat ? [centre[0], centre[2]] : centre }));
    this.nextPiles = part === 0 ? here : [...this.nextPiles, ...here];
    if (part + 1 === parts) this.piles = this.nextPiles;
  }

  private takeInstruments({ part, parts, ...here }: InstrumentsMessage): void {
    const before = part === 0 ? { gates: [], regions: [], loads: [] } : this.nextInstruments;
    this.nextInstruments = { gates: [...before.gates, ...here.gates], regions: [...before.regions, ...here.regions], loads: [...before.loads, ...here.loads] };
    if (part + 1 === parts) this.instruments = this.nextInstruments;
  }

  private takeSleep({ step, body, pile, layer, woke, cause, score }: SleepMessage): void {
    body.forEach((each, i) => this.news.events.push({ step, body: each, pile: pile[i], layer: layer[i], woke: woke[i] === 1, cause: this.layouts.causes[cause[i]] ?? "unknown", score: score[i] }));
  }

  private takeBodies(message: Message, header: PartMessage): Moment | null {
    const bodies = this.bodies.take(message, header);
    if (!bodies) return null;
    const moment = { step: header.step, bodies, contacts: this.contacts.of(header.step), piles: this.piles, stats: this.stats, instruments: this.instruments, ...this.news };
    this.news = { obstacles: [], events: [], sceneEvents: [] };
    return moment;
  }
}

/// All bodies at one moment.
export class State {
  step = 0;
  bodies = 0;
  awake = 0;
  asleepCount = 0;
  piles: Pile[] = [];
  instruments: Instruments | null = null;
  stats: StatsMessage | null = null;
  private contactMessages: Message[] = [];
  shape = new Uint16Array(64);
  asleep = new Uint8Array(64);
  /// Also those that no message has named yet.
  removed = new Uint8Array(64);
  /// In m and rad: x, z, angle or x, y, z, quaternion w, x, y, z.
  pose: Float32Array;
  /// Poses of the obstacles that move, by number.
  obstacles = new Map<number, number[]>();
  private readonly components: number;

  constructor(
    private readonly dimension: 2 | 3,
    private readonly layouts: Layouts,
  ) {
    this.components = poseValues(dimension);
    this.pose = new Float32Array(64 * this.components);
  }

  copy(): State {
    const copy = new State(this.dimension, this.layouts);
    const { step, bodies, awake, asleepCount, piles, stats, instruments, contactMessages } = this;
    Object.assign(copy, { step, bodies, awake, asleepCount, piles, stats, instruments, contactMessages });
    copy.shape = this.shape.slice(0, bodies);
    copy.asleep = this.asleep.slice(0, bodies);
    copy.removed = this.removed.slice(0, bodies);
    copy.pose = this.pose.slice(0, bodies * this.components);
    for (const [obstacle, pose] of this.obstacles) copy.obstacles.set(obstacle, [...pose]);
    return copy;
  }

  /// Contact points with a force; null: not told.
  contacts(): Contact[] | null {
    return this.contactMessages.length > 0 ? contactsOf(this.contactMessages, this.layouts, this.dimension) : null;
  }

  /// Of the sleeping bodies [D], below 0: not known.
  get drift(): number {
    return this.stats?.drift_estimate ?? -1;
  }

  /// Of the bodies at rest [rad], below 0: none, and why.
  get slope(): number {
    return this.stats?.slope ?? -1;
  }
  get noSlope(): string {
    return this.stats?.slope_reason ? `: ${this.stats.slope_reason}` : "";
  }

  /// Wall time of a step [ms], null: not known.
  get msPerStep(): number | null {
    if (!this.stats?.timed) return null;
    const { ms_emit, ms_step, ms_count, ms_decide, ms_apply } = this.stats;
    return ms_emit + ms_step + ms_count + ms_decide + ms_apply;
  }

  /// Goes on to a moment; the bodies that changed.
  apply(moment: Moment): number[] {
    this.step = moment.step;
    this.piles = moment.piles;
    this.instruments = moment.instruments;
    this.stats = moment.stats;
    this.contactMessages = moment.contacts;
    for (const { obstacle, poses } of moment.obstacles)
      obstacle.forEach((number, i) => this.obstacles.set(number, Array.from(poses.subarray(i * this.components, (i + 1) * this.components))));
    const changed: number[] = [];
    const parts = moment.bodies.map((message) => decode<BodiesMessage>(message, this.layouts));
    const named = new Set<number>();
    for (const part of parts) this.take(part, changed, named);
    if (parts[0].key_frame)
      for (let body = 0; body < this.bodies; ++body)
        if (this.removed[body] === 0 && !named.has(body)) {
          this.removed[body] = 1;
          changed.push(body);
        }
    this.count();
    return changed;
  }

  private take({ body, shape, asleep, poses, key_frame }: BodiesMessage, changed: number[], named: Set<number>): void {
    if (body.length > 0) this.grow(body[body.length - 1] + 1);
    const { components, pose } = this;
    body.forEach((each, i) => {
      if (key_frame) named.add(each);
      let same = this.removed[each] === 0 && this.shape[each] === shape[i] && this.asleep[each] === asleep[i];
      this.shape[each] = shape[i];
      this.asleep[each] = asleep[i];
      this.removed[each] = 0;
      for (let k = 0; k < components; ++k) {
        same &&= pose[each * components + k] === poses[i * components + k];
        pose[each * components + k] = poses[i * components + k];
      }
      if (!same) changed.push(each);
    });
  }

  private grow(bodies: number): void {
    if (bodies <= this.bodies) return;
    if (bodies > this.shape.length || bodies * this.components > this.pose.length) {
      const room = 2 * bodies;
      const grown = <T extends { set(from: T): void }>(to: T, from: T): T => (to.set(from), to);
      this.shape = grown(new Uint16Array(room), this.shape);
      this.asleep = grown(new Uint8Array(room), this.asleep);
      this.removed = grown(new Uint8Array(room), this.removed);
      this.pose = grown(new Float32Array(room * this.components), this.pose);
    }
    this.removed.fill(1, this.bodies, bodies);
    this.bodies = bodies;
  }

  private count(): void {
    this.awake = this.asleepCount = 0;
    for (let body = 0; body < this.bodies; ++body)
      if (this.removed[body] === 0) {
        if (this.asleep[body] === 0) ++this.awake;
        else ++this.asleepCount;
      }
  }
}
