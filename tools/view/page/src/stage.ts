// The pile on the screen, and the camera.

import { colour, css, highlight, type Paint } from "./colours";
import { Enclosed } from "./enclosed";
import { boundsOf, type Head, type Point } from "./head";
import type { Contact } from "./contacts";
import { ContactMarks, type ContactWay } from "./contact_marks";
import { discard, Instances, outlined, type Veil } from "./instances";
import { InstrumentView } from "./instrument_view";
import { LayerView } from "./layer_view";
import { matrixOf } from "./pose";
import { niceLength } from "./scale";
import { geometryOf } from "./shapes";
import { repeats, shiftsInside } from "./sides";
import { Surroundings } from "./surroundings";
import type { Changed, Timeline } from "./timeline";
import {
  MeshBasicMaterial,
  MeshLambertMaterial,
  MOUSE,
  OrbitControls,
  OrthographicCamera,
  PCFShadowMap,
  PerspectiveCamera,
  Raycaster,
  Scene,
  TOUCH,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "./vendor";

const updatesBetweenSearches = 8; // for what is hidden
const paleness = 0.7; // of bodies behind contacts: their share of paper

export class Stage {
  private readonly scene = new Scene();
  private readonly renderer: WebGLRenderer;
  private readonly camera: PerspectiveCamera | OrthographicCamera;
  private readonly controls: OrbitControls;
  private readonly labels: CanvasRenderingContext2D;
  /// Of each shape the awake bodies, then those that sleep.
  private readonly shapes: Instances[] = [];
  /// Of each shape the images of bodies that reach through periodic sides.
  private readonly images: Instances[] = [];
  /// Of each body its mesh and its place there; -1: it is not drawn.
  private readonly mesh: number[] = [];
  private readonly place: number[] = [];
  private surroundings: Surroundings;
  private contactMarks: ContactMarks;
  private layers: LayerView;
  private instruments: InstrumentView;
  private readonly pale: Veil["share"] = { value: 0 };
  private readonly flat: boolean;
  private head: Head;
  private timeline: Timeline | null = null;
  private picture = 0; // the browser's number of the picture that will be drawn, 0: none
  private readonly resizes = new ResizeObserver(() => this.resize());
  readonly enclosed = new Enclosed();
  private updates = 0;
  /// Whether the layers of piles are drawn.
  showLayers = true;
  selected = -1;
  /// From where to where a throw is drawn [CSS pixels].
  arrow: [number, number, number, number] | null = null;
  /// From which point of a body, in its own axes [m], to where a line is drawn [CSS pixels].
  tether: { body: number; point: number[]; to: [number, number] } | null = null;
  /// Whether the camera moves back as the pile grows, until the user moves it.
  follows = false;
  /// Whether the user has moved the camera.
  moved = false;
  private accompanied = -1;
  private accompaniedAt: Vector3 | null = null;
  private box: [Vector3, Vector3];
  /// That of another run, which shows the same part of space at the same scale; null: none.
  private partner: Stage | null = null;
  private copying = false;
  /// Called after each picture.
  onDrawn: () => void = () => undefined;
  /// Durations of the last pictures [ms].
  readonly drawn: number[] = [];

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly overlay: HTMLCanvasElement,
    head: Head,
  ) {
    this.head = head;
    this.box = this.boxOf(head);
    this.flat = head.dimension === 2;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.labels = overlay.getContext("2d")!;
    this.camera = this.flat ? new OrthographicCamera() : new PerspectiveCamera(26);
    if (!this.flat) this.camera.up.set(0, 0, 1); // before the controls, which take it over once
    this.controls = new OrbitControls(this.camera, canvas);
    this.prepareControls();
    if (!this.flat) {
      this.renderer.shadowMap.enabled = true;
      this.renderer.shadowMap.type = PCFShadowMap;
      this.renderer.shadowMap.autoUpdate = false;
    }
    this.surroundings = new Surroundings(head, head.box);
    this.scene.add(this.surroundings.group);
    this.contactMarks = new ContactMarks(head);
    this.layers = new LayerView(head);
    this.instruments = new InstrumentView(head);
    this.resizes.observe(canvas.parentElement!);
    this.resize();
    this.fit();
  }

  /// Frees what the graphics card holds, and draws no more.
  dispose(): void {
    this.resizes.disconnect();
    cancelAnimationFrame(this.picture);
    this.controls.dispose();
    this.renderer.dispose();
  }

  private boxOf(head: Head): [Vector3, Vector3] {
    const corner = (i: number): Vector3 => new Vector3(head.box[i][0], head.box[i][1], head.box[i][2] ?? 0);
    return [corner(0), corner(1)];
  }

  private boxSizes(): number[] {
    return this.head.box[1].map((high, i) => high - this.head.box[0][i]);
  }

  /// Takes bodies that left the picture into it.
  private follow(bodies: number[]): void {
    const [low, high] = this.box;
    const before = low.distanceTo(high);
    for (const body of bodies) {
      const [x, y, z] = Array.from(this.poseOf(body));
      const at = new Vector3(x, y, this.flat ? 0 : z);
      const reach = 0.6 * this.head.shapes[this.timeline!.state.shape[body]].extent;
      low.min(at.clone().subScalar(reach));
      high.max(at.addScalar(reach));
    }
    if (this.flat) low.z = high.z = 0;
    if (this.head.ground.present) low.setComponent(this.flat ? 1 : 2, Math.max(low.getComponent(this.flat ? 1 : 2), this.head.ground.height));
    if (low.distanceTo(high) > before) this.fit(false);
    if (low.distanceTo(high) > 2 * this.surroundings.size) this.surround();
  }

  /// From now on both have one camera and one scale: what one shows, the other does.
  pairWith(other: Stage): void {
    [this.partner, other.partner] = [other, this];
    this.surround();
    this.fit();
  }

  /// Draws ground, sides and obstacles anew; beside another run there too, so that both have the same squares.
  surround(): void {
    for (const stage of [this, this.partner]) stage?.surroundAlone();
  }

  private surroundAlone(): void {
    const [low, high] = this.wholeBox();
    const inScene = (corner: Vector3): Point => corner.toArray().slice(0, this.head.dimension);
    this.surroundings.dispose();
    this.surroundings = new Surroundings(this.head, [inScene(low), inScene(high)]);
    this.surroundings.placeSun(low, high);
    this.scene.add(this.surroundings.group);
    if (this.timeline && this.timeline.shown >= 0) this.updateObstacles();
  }

  /// What must be in sight.
  private wholeBox(): [Vector3, Vector3] {
    const [low, high] = [this.box[0].clone(), this.box[1].clone()];
    if (this.partner) {
      low.min(this.partner.box[0]);
      high.max(this.partner.box[1]);
    }
    return [low, high];
  }

  private cameraMoved(): void {
    this.redraw();
    if (!this.copying) this.partner?.copyCamera(this);
  }

  private copyCamera(from: Stage): void {
    this.copying = true;
    this.camera.position.copy(from.camera.position);
    this.controls.target.copy(from.controls.target);
    if (this.camera instanceof OrthographicCamera) {
      const { top, zoom } = from.camera as OrthographicCamera;
      const metresPerPixel = top / zoom / from.canvas.clientHeight;
      this.camera.zoom = this.camera.top / (metresPerPixel * this.canvas.clientHeight);
    } else {
      [this.camera.near, this.camera.far] = [from.camera.near, from.camera.far];
    }
    this.follows = from.follows;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.redraw();
    this.copying = false;
  }

  /// Where the camera is, for an address: its target and, in 2D, half the height in sight, in 3D the eye [m].
  get cameraText(): string {
    const { target } = this.controls;
    const { camera } = this;
    const numbers = camera instanceof OrthographicCamera ? [target.x, target.y, camera.top / camera.zoom] : [...target.toArray(), ...camera.position.toArray()];
    return numbers.map((number) => Number(number.toPrecision(5))).join(",");
  }

  /// Takes the camera to where such a text says.
  set cameraText(text: string) {
    const numbers = text.split(",").map(Number);
    if (numbers.length !== (this.flat ? 3 : 6) || !numbers.every(Number.isFinite)) return;
    if (this.camera instanceof OrthographicCamera) {
      this.controls.target.set(numbers[0], numbers[1], 0);
      this.camera.position.set(numbers[0], numbers[1], 100);
      this.camera.zoom = this.camera.top / Math.max(1e-6, numbers[2]);
    } else {
      this.controls.target.fromArray(numbers);
      this.camera.position.fromArray(numbers, 3);
    }
    this.follows = false;
    this.moved = true;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.cameraMoved();
  }

  /// For tests: metres that a pixel shows in the middle of the view, and from where.
  view(): { metresPerPixel: number; eye: number[]; target: number[] } {
    const { target } = this.controls;
    const right = new Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
    const metresPerPixel = 1 / this.onScreen(target.clone().add(right)).distanceTo(this.onScreen(target));
    return { metresPerPixel, eye: this.camera.position.toArray(), target: target.toArray() };
  }

  private prepareControls(): void {
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.cameraMoved());
    this.controls.addEventListener("start", () => {
      this.follows = false;
      this.moved = true;
    });
    if (this.flat) {
      this.controls.enableRotate = false;
      this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
      this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    } else {
      this.controls.maxPolarAngle = 0.5 * Math.PI;
    }
  }

  /// Shows the whole box, from where the pictures do unless `turn` is false.
  fit(turn = true): void {
    this.moved = false;
    this.surroundings.placeSun(...this.box);
    const [low, high] = this.wholeBox();
    const middle = low.clone().add(high).multiplyScalar(0.5);
    if (this.camera instanceof PerspectiveCamera) {
      const { azimuth, elevation } = this.head.camera;
      const back = turn
        ? new Vector3(Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation))
        : this.camera.position.clone().sub(this.controls.target).normalize();
      this.camera.position.copy(middle).addScaledVector(back, this.distanceFor(low, high, middle, back));
    } else {
      const aspect = this.camera.right / this.camera.top;
      const half = 1.08 * Math.max((high.y - low.y) / 2, (high.x - low.x) / 2 / aspect, 1e-3);
      if (this.head.ground.present) middle.y = Math.max(middle.y, low.y + 0.86 * half); // rather sky than soil
      this.camera.zoom = this.camera.top / half;
      this.camera.position.set(middle.x, middle.y, 100);
    }
    this.controls.target.copy(middle);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.cameraMoved();
  }

  /// From which all corners of the box are in sight.
  private distanceFor(low: Vector3, high: Vector3, middle: Vector3, back: Vector3): number {
    const camera = this.camera as PerspectiveCamera;
    const right = new Vector3(0, 0, 1).cross(back).normalize();
    const up = back.clone().cross(right);
    const slopeUp = Math.tan((camera.fov * Math.PI) / 360);
    let distance = 0;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z).sub(middle);
      const side = Math.max(Math.abs(corner.dot(right)) / camera.aspect, Math.abs(corner.dot(up)));
      distance = Math.max(distance, corner.dot(back) + (1.06 * side) / slopeUp);
    }
    return distance;
  }

  /// The run whose frames are shown. Its head must be of the same scene's dimension.
  setRun(timeline: Timeline): void {
    for (const shape of [...this.shapes, ...this.images]) shape.dispose();
    this.shapes.length = this.images.length = this.mesh.length = this.place.length = 0;
    this.timeline = timeline;
    this.head = timeline.head;
    this.box = this.boxOf(this.head);
    this.scene.background = colour(this.head.colours.paper);
    this.surround();
    for (const part of [this.contactMarks.group, this.layers.lines, this.instruments.lines]) discard(part);
    this.contactMarks = new ContactMarks(this.head);
    this.layers = new LayerView(this.head);
    this.instruments = new InstrumentView(this.head);
    this.scene.add(this.contactMarks.group, this.layers.lines, this.instruments.lines);
    const { awake_outline, asleep_outline } = this.head.colours;
    const material = outlined(this.flat ? new MeshBasicMaterial() : new MeshLambertMaterial(), awake_outline, asleep_outline, { colour: this.head.colours.paper, share: this.pale });
    for (const shape of this.head.shapes) {
      const geometry = geometryOf(shape.pieces);
      for (const list of [this.shapes, this.shapes, this.images]) {
        const instances = new Instances(geometry, material, !this.flat, 64);
        list.push(instances);
        this.scene.add(instances.mesh);
      }
    }
    this.redraw();
  }

  private poseOf(body: number): ArrayLike<number> {
    const width = this.flat ? 3 : 7;
    return this.timeline!.drawn.pose.subarray(width * body, width * (body + 1));
  }

  /// Brings bodies to where the timeline's state has them. Those that sleep are drawn apart from those that are awake, so
  /// that only the latter are sent to the graphics card at each frame.
  update(changed: Changed, paint: Paint): void {
    const state = this.timeline!.state;
    while (this.place.length < state.bodies) {
      this.place.push(-1);
      this.mesh.push(-1);
    }
    // What moves away from a sleeping body needs longer than until the next search to show it.
    const flipped = changed === "all" || this.updates++ % updatesBetweenSearches === 0 ? this.enclosed.update(state, this.head) : [];
    const bodies = changed === "all" ? Array.from(this.place.keys()) : [...changed, ...flipped];
    for (const body of bodies) {
      const hidden = this.enclosed.has(body) && state.asleep[body] !== 0;
      const gone = body >= state.bodies || state.removed[body] !== 0 || hidden;
      const asleep = !gone && state.asleep[body] !== 0;
      const mesh = gone ? -1 : 2 * state.shape[body] + (asleep ? 1 : 0);
      if (mesh !== this.mesh[body]) this.putInto(mesh, body);
      if (gone) continue;
      const tint = body === this.selected ? highlight : paint(body);
      this.shapes[mesh].set(this.place[body], matrixOf(this.poseOf(body)), colour(tint), asleep);
    }
    if (repeats(this.head.sides)) this.updateImages(paint);
    for (const shape of [...this.shapes, ...this.images]) shape.upload();
    this.updateObstacles();
    if (this.accompanied >= 0) this.goAlong();
    else if (this.follows) this.follow(bodies.filter((body) => body < state.bodies && state.removed[body] === 0));
    this.redraw();
  }

  private updateImages(paint: Paint): void {
    const { state } = this.timeline!;
    const { shapes, sides, dimension } = this.head;
    for (const image of this.images) image.clear();
    for (let body = 0; body < state.bodies; ++body) {
      if (this.mesh[body] < 0) continue;
      const { extent, pieces } = shapes[state.shape[body]];
      const pose = Array.from(this.poseOf(body));
      const place = pose.slice(0, dimension);
      const about = [-extent, extent].map((reach) => place.map((value) => value + reach)) as [Point, Point];
      if (shiftsInside(sides, about).length === 0) continue;
      const image = this.images[state.shape[body]];
      for (const shift of shiftsInside(sides, boundsOf(pieces, pose)))
        image.set(image.add(body), matrixOf(pose.map((value, i) => value + (shift[i] ?? 0))), colour(body === this.selected ? highlight : paint(body)), state.asleep[body] !== 0);
    }
  }

  private updateObstacles(): void {
    const absent = new Set<number>();
    for (const event of this.head.events) if (event?.action === "add") for (const each of event.obstacle) absent.add(each);
    for (const { number } of this.timeline!.happenedSoFar()) {
      const event = this.head.events[number];
      for (const each of event?.obstacle ?? []) {
        if (event?.action === "add") absent.delete(each);
        else absent.add(each);
      }
    }
    this.surroundings.hideObstacles(absent);
    for (const [obstacle, pose] of this.timeline!.drawn.obstacles) this.surroundings.placeObstacle(obstacle, pose);
  }

  /// Moves the camera along with a body from now on, none below 0.
  accompany(body: number): void {
    this.accompanied = body;
    this.accompaniedAt = null;
    this.goAlong();
  }

  private goAlong(): void {
    const { state } = this.timeline!;
    if (this.accompanied < 0 || this.accompanied >= state.bodies || state.removed[this.accompanied] !== 0) return;
    const [x, y, z] = Array.from(this.poseOf(this.accompanied));
    const at = new Vector3(x, y, this.flat ? 0 : z);
    if (this.accompaniedAt) {
      const way = at.clone().sub(this.accompaniedAt);
      this.camera.position.add(way);
      this.controls.target.add(way);
      this.controls.update();
    }
    this.accompaniedAt = at;
  }

  /// Draws these over bodies that become pale; none: takes the marks away. The force [N] of a bar of so many metres.
  showContacts(contacts: Contact[], way: ContactWay): { force: number; length: number } {
    this.contactMarks.show(contacts, way, (body) => Array.from(this.poseOf(body)).slice(0, this.head.dimension));
    this.pale.value = this.marked ? paleness : 0;
    this.redraw();
    return this.contactMarks;
  }

  /// Moves a body from one mesh to another, -1: none.
  private putInto(mesh: number, body: number): void {
    const [before, place] = [this.mesh[body], this.place[body]];
    if (before >= 0) {
      const moved = this.shapes[before].remove(place);
      this.place[moved] = place;
    }
    this.mesh[body] = mesh;
    this.place[body] = mesh < 0 ? -1 : this.shapes[mesh].add(body);
  }

  /// Draws when the browser has time for the next picture.
  redraw(): void {
    if (this.picture !== 0) return;
    this.picture = requestAnimationFrame(() => {
      this.picture = 0;
      this.draw();
    });
  }

  private draw(): void {
    const start = performance.now();
    if (this.timeline) this.instruments.update(this.timeline.state.instruments);
    if (this.timeline) this.layers.update(this.showLayers ? this.timeline.state.piles : []);
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.render(this.scene, this.camera);
    this.drawLabels();
    this.onDrawn();
    this.drawn.push(performance.now() - start);
    if (this.drawn.length > 60) this.drawn.shift();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement!;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    const ratio = this.renderer.getPixelRatio();
    [this.overlay.width, this.overlay.height] = [width * ratio, height * ratio];
    if (this.camera instanceof PerspectiveCamera) {
      this.camera.aspect = width / height;
      const size = Math.hypot(...this.boxSizes());
      [this.camera.near, this.camera.far] = [0.02 * size, 100 * size];
    } else {
      const size = Math.max(...this.boxSizes());
      [this.camera.left, this.camera.right, this.camera.bottom, this.camera.top] = [(-size * width) / height, (size * width) / height, -size, size];
      [this.camera.near, this.camera.far] = [0, 200];
    }
    this.camera.updateProjectionMatrix();
    if (!this.moved && this.accompanied < 0) this.fit(false);
    this.redraw();
  }

  private onScreen(point: Vector3): Vector2 {
    this.camera.updateMatrixWorld(); // the camera may have moved since the last picture
    const seen = point.clone().project(this.camera);
    return new Vector2(((seen.x + 1) / 2) * this.canvas.clientWidth, ((1 - seen.y) / 2) * this.canvas.clientHeight);
  }

  /// Densities beside their layers and a scale bar.
  private drawLabels(): void {
    const { labels: paper, overlay } = this;
    const ratio = this.renderer.getPixelRatio();
    paper.setTransform(ratio, 0, 0, ratio, 0, 0);
    paper.clearRect(0, 0, overlay.width, overlay.height);
    this.drawScale();
    this.drawArrow();
    this.drawChosen();
    if (this.timeline) this.instruments.drawLabels(paper, this.timeline.state.instruments, (point) => this.onScreen(point));
    if (this.showLayers && this.timeline) this.layers.drawLabels(paper, this.timeline.state.piles, this.camera, (point) => this.onScreen(point));
  }

  private tetherLine(): [number, number, number, number] | null {
    if (!this.tether) return null;
    const { body, point, to } = this.tether;
    const from = this.onScreen(new Vector3(point[0], point[1], point[2] ?? 0).applyMatrix4(matrixOf(this.poseOf(body))));
    return [from.x, from.y, ...to];
  }

  private drawArrow(): void {
    const line = this.arrow ?? this.tetherLine();
    if (!line) return;
    const [x0, y0, x1, y1] = line;
    const paper = this.labels;
    paper.strokeStyle = paper.fillStyle = css(highlight);
    paper.lineWidth = 2;
    paper.beginPath();
    paper.moveTo(x0, y0);
    paper.lineTo(x1, y1);
    paper.stroke();
    paper.beginPath();
    paper.arc(x1, y1, 4, 0, 2 * Math.PI);
    paper.fill();
  }

  /// A ring about the chosen body, so that it is found among others of its colour.
  private drawChosen(): void {
    const { state } = this.timeline ?? {};
    if (!state || this.selected < 0 || this.selected >= state.bodies || state.removed[this.selected] !== 0) return;
    const { x, y } = this.placeOf(this.selected);
    const paper = this.labels;
    paper.strokeStyle = css(highlight);
    paper.lineWidth = 2;
    paper.beginPath();
    paper.arc(x, y, this.radiusOf(this.selected), 0, 2 * Math.PI);
    paper.stroke();
  }

  /// Of a circle about a body on the canvas [CSS pixels].
  radiusOf(body: number): number {
    const { extent } = this.head.shapes[this.timeline!.state.shape[body]];
    const [x, y, z] = Array.from(this.poseOf(body));
    const centre = new Vector3(x, y, this.flat ? 0 : z);
    const side = new Vector3(0.55 * extent, 0, 0).applyQuaternion(this.camera.quaternion);
    return Math.max(8, this.onScreen(centre.clone().add(side)).distanceTo(this.onScreen(centre)));
  }

  /// Whether contacts are drawn.
  get marked(): boolean {
    return this.contactMarks.count > 0;
  }

  private drawScale(): void {
    const paper = this.labels;
    const bottom = this.canvas.clientHeight - 14;
    paper.fillStyle = paper.strokeStyle = css(this.head.colours.quiet_text);
    paper.font = "12px system-ui, sans-serif";
    paper.textBaseline = "middle";
    if (!this.flat) {
      paper.fillText(`squares of ${this.surroundings.gridLength} m`, 14, bottom);
      return;
    }
    const pixelsPerMetre = this.onScreen(new Vector3(1, 0, 0)).x - this.onScreen(new Vector3(0, 0, 0)).x;
    const length = niceLength(this.canvas.clientWidth / 6 / pixelsPerMetre);
    const end = 14 + length * pixelsPerMetre;
    paper.save();
    paper.fillStyle = css(this.head.colours.paper, 0.8);
    paper.fillRect(8, bottom - 9, end + 7 + paper.measureText(`${length} m`).width, 18);
    paper.restore();
    paper.lineWidth = 1.5;
    paper.beginPath();
    for (const [x, y] of [[14, bottom - 4], [14, bottom + 4], [14, bottom], [end, bottom], [end, bottom - 4], [end, bottom + 4]]) paper.lineTo(x, y);
    paper.stroke();
    paper.fillText(`${length} m`, end + 7, bottom);
  }

  private rayAt(x: number, y: number): Raycaster {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight), this.camera);
    return ray;
  }

  /// The nearest body there, or also the image of one.
  private hitAt(x: number, y: number, instances = this.shapes): { body: number; at: Vector3 } | null {
    const ray = this.rayAt(x, y);
    const hits = instances.flatMap((shape) => ray.intersectObject(shape.mesh).map((hit) => ({ distance: hit.distance, at: hit.point, body: shape.bodies[hit.instanceId!] })));
    hits.sort((a, b) => a.distance - b.distance);
    return hits.find(({ body }) => body < this.timeline!.state.bodies) ?? null;
  }

  /// The obstacle at a place of the canvas [CSS pixels], -1: none.
  obstacleAt(x: number, y: number): number {
    return this.surroundings.obstacleOn(this.rayAt(x, y));
  }

  /// The body at a place of the canvas [CSS pixels], -1: none.
  bodyAt(x: number, y: number): number {
    return this.hitAt(x, y, [...this.shapes, ...this.images])?.body ?? -1;
  }

  /// The body there, with the point hit in its own axes and in the world's [m].
  grabAt(x: number, y: number): { body: number; point: number[]; grabbed: number[] } | null {
    const hit = this.hitAt(x, y);
    if (!hit) return null;
    const local = hit.at.clone().applyMatrix4(matrixOf(this.poseOf(hit.body)).invert());
    const list = (point: Vector3): number[] => point.toArray().slice(0, this.head.dimension);
    return { body: hit.body, point: list(local), grabbed: list(hit.at) };
  }

  /// The point of a ray through a place of the canvas on the plane with this normal through `through`; none behind the eye.
  private onPlane(x: number, y: number, normal: Vector3, through: Vector3): number[] | null {
    const { origin, direction } = this.rayAt(x, y).ray;
    const distance = through.clone().sub(origin).dot(normal) / direction.dot(normal);
    if (!Number.isFinite(distance) || distance < 0) return null;
    return origin.clone().addScaledVector(direction, distance).toArray().slice(0, this.head.dimension);
  }

  private towardsEye(): Vector3 {
    return new Vector3(0, 0, 1).applyQuaternion(this.camera.quaternion);
  }

  /// Where the pointer is [m] in the plane of the screen through a point.
  across(through: number[], x: number, y: number): number[] {
    return this.onPlane(x, y, this.towardsEye(), new Vector3(through[0], through[1], through[2] ?? 0)) ?? through;
  }

  /// Where a body may be put [m]: on the body there, else on the ground, else at the middle of the view.
  placeAt(x: number, y: number): number[] | null {
    if (this.flat) return this.onPlane(x, y, this.towardsEye(), new Vector3());
    const hit = this.hitAt(x, y);
    if (hit) return hit.at.toArray();
    const { ground } = this.head;
    const onGround = ground.present ? this.onPlane(x, y, new Vector3(0, 0, 1), new Vector3(0, 0, ground.height)) : null;
    return onGround ?? this.onPlane(x, y, this.towardsEye(), this.controls.target);
  }

  /// A way on the canvas [CSS pixels] at a body's distance as one in the world [m], in the plane of the screen.
  inWorld(body: number, right: number, down: number): number[] {
    const pose = this.poseOf(body);
    const centre = new Vector3(pose[0], pose[1], this.flat ? 0 : pose[2]);
    const along = (axis: Vector3, pixels: number): Vector3 => {
      const unit = axis.applyQuaternion(this.camera.quaternion);
      const scale = this.onScreen(centre.clone().add(unit)).distanceTo(this.onScreen(centre));
      return unit.multiplyScalar(pixels / scale);
    };
    const way = along(new Vector3(1, 0, 0), right).add(along(new Vector3(0, 1, 0), -down));
    return this.flat ? [way.x, way.y] : [way.x, way.y, way.z];
  }

  /// Where a body is on the canvas [CSS pixels].
  placeOf(body: number): { x: number; y: number } {
    const pose = this.poseOf(body);
    const { x, y } = this.onScreen(new Vector3(pose[0], pose[1], this.flat ? 0 : pose[2]));
    return { x, y };
  }
}
