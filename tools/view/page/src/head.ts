// What is known of a run before its first frame (tools/view/run_head.h).

export type Point = number[];
export type Rgb = [number, number, number];

export interface Piece {
  loops: Point[][];
  core?: [Point, Point];
}

export interface ShapeHead {
  name: string;
  awake: Rgb;
  asleep: Rgb;
  mass: number;
  extent: number;
  pieces: Piece[];
}

export interface ObstacleHead {
  name: string;
  pose: number[];
  pieces: Piece[];
}

export interface Cause {
  name: string;
  slept: string;
  woke: string;
}

export interface Head {
  title: string;
  name: string;
  backend: string;
  policy: string;
  version: string;
  seed: number;
  reason: string;
  damage: string;
  dimension: 2 | 3;
  dt: number;
  steps: number;
  /// Between two frames of output; none where frames come as another process sends them.
  steps_per_frame: number | null;
  ground: { present: boolean; height: number };
  quantum: { position: number; angle: number; quaternion: number };
  box: [Point, Point];
  camera: { azimuth: number; elevation: number };
  colours: {
    paper: Rgb;
    text: Rgb;
    quiet_text: Rgb;
    asleep: Rgb;
    asleep_outline: Rgb;
    awake: Rgb[];
    awake_outline: Rgb;
    layer: Rgb;
    obstacle: Rgb;
    obstacle_outline: Rgb;
    ground: Rgb;
  };
  /// Of policy `paper`: the score above which a body sleeps; none of other policies.
  score_threshold: number | null;
  /// Of policy `adaptive`: how far a sleeping body may move once it is woken [D]; none where it is not known.
  tolerance: number | null;
  causes: (Cause | null)[];
  /// The scene's events, with the numbers of the obstacles that they remove; none where the scene is not known.
  events: { text: string; removes: number[] }[];
  coloured_shapes: { name: string; colour: Rgb }[];
  shapes: ShapeHead[];
  obstacles: ObstacleHead[];
}

/// A run before its first frame, and its frames.
export interface Stream {
  head: Head;
  blocks: Uint8Array;
}

/// Reads what stream_bytes() of tools/view/page.h wrote.
export async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<Stream> {
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const all = new Uint8Array(await new Response(plain).arrayBuffer());
  const size = new DataView(all.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(all.subarray(4, 4 + size))) as Head;
  return { head, blocks: all.subarray(4 + size) };
}
