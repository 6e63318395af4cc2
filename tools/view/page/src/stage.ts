// The pile on the screen: bodies, obstacles, layers, ground, and the camera.

import { density, type Pile } from "./frames";
import type { Head, Rgb } from "./head";
import { geometryOf } from "./shapes";
import type { Changed, Timeline } from "./timeline";
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  MOUSE,
  OrbitControls,
  OrthographicCamera,
  PCFShadowMap,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Raycaster,
  Scene,
  ShadowMaterial,
  SRGBColorSpace,
  TOUCH,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "./vendor";

const mostLayers = 32; // drawn of a pile; thinner ones would be lines only
const highlight: Rgb = [0.1, 0.5, 0.95];

export const colour = (rgb: Rgb): Color => new Color().setRGB(rgb[0], rgb[1], rgb[2], SRGBColorSpace);
export const css = (rgb: Rgb, alpha = 1): string =>
  `rgb(${rgb.map((part) => Math.round(255 * part)).join(" ")} / ${alpha})`;

/// Colour of a body by its number.
export type Paint = (body: number) => Rgb;

/// The largest of 1, 2, 5 times a power of ten that is at most `limit`.
export function niceLength(limit: number): number {
  const power = 10 ** Math.floor(Math.log10(limit));
  const share = limit / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

/// The bodies of one shape.
class Instances {
  mesh: InstancedMesh;
  readonly bodies: number[] = [];
  private sleeping: InstancedBufferAttribute;

  constructor(
    private readonly geometry: BufferGeometry,
    private readonly material: Material,
    private readonly shadows: boolean,
    room: number,
  ) {
    [this.mesh, this.sleeping] = this.make(room);
  }

  private make(room: number): [InstancedMesh, InstancedBufferAttribute] {
    const geometry = this.geometry.clone();
    const sleeping = new InstancedBufferAttribute(new Float32Array(room), 1);
    sleeping.setUsage(DynamicDrawUsage);
    geometry.setAttribute("sleeping", sleeping);
    const mesh = new InstancedMesh(geometry, this.material, room);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * room), 3);
    mesh.instanceColor.setUsage(DynamicDrawUsage);
    mesh.count = 0;
    mesh.frustumCulled = false;
    mesh.castShadow = mesh.receiveShadow = this.shadows;
    return [mesh, sleeping];
  }

  /// Room for one body more; returns its place. The mesh may be another one afterwards.
  add(body: number): number {
    const room = this.sleeping.count;
    if (this.bodies.length === room) {
      const old = this.mesh;
      [this.mesh, this.sleeping] = this.make(2 * room);
      this.mesh.instanceMatrix.array.set(old.instanceMatrix.array);
      this.mesh.instanceColor!.array.set(old.instanceColor!.array);
      old.parent?.add(this.mesh);
      old.removeFromParent();
      old.dispose();
      old.geometry.dispose();
    }
    this.bodies.push(body);
    this.mesh.count = this.bodies.length;
    return this.bodies.length - 1;
  }

  set(place: number, matrix: Matrix4, tint: Color, asleep: boolean): void {
    this.mesh.setMatrixAt(place, matrix);
    this.mesh.setColorAt(place, tint);
    this.sleeping.setX(place, asleep ? 1 : 0);
  }

  upload(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.instanceColor!.needsUpdate = true;
    this.sleeping.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }
}

/// Draws outlines one and a half pixels wide, in one colour where `sleeping` is 0, in another where it is 1.
function outlined(material: Material, awake: Rgb, asleep: Rgb): Material {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.awakeOutline = { value: colour(awake) };
    shader.uniforms.asleepOutline = { value: colour(asleep) };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nattribute float edge; attribute float sleeping; varying float vEdge; varying float vSleeping;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvEdge = edge; vSleeping = sleeping;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nuniform vec3 awakeOutline; uniform vec3 asleepOutline; varying float vEdge; varying float vSleeping;")
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
        float pixel = fwidth(vEdge);
        float line = smoothstep(1.0 - 1.6 * pixel, 1.0 - 0.6 * pixel, vEdge) * clamp(1.4 - 4.0 * pixel, 0.0, 1.0);
        diffuseColor.rgb = mix(diffuseColor.rgb, vSleeping > 0.5 ? asleepOutline : awakeOutline, line);`,
      );
  };
  return material;
}

export class Stage {
  private readonly scene = new Scene();
  private readonly renderer: WebGLRenderer;
  private readonly camera: PerspectiveCamera | OrthographicCamera;
  private readonly controls: OrbitControls;
  private readonly labels: CanvasRenderingContext2D;
  private readonly shapes: Instances[] = [];
  private readonly place: number[] = [];
  private readonly obstacles: Instances[] = [];
  private readonly layers = new Group();
  private readonly flat: boolean;
  private readonly gridLength: number;
  private head: Head;
  private timeline: Timeline | null = null;
  private layersDrawn: Pile[] | null = null;
  private waiting = false;
  /// Whether the layers of piles are drawn.
  showLayers = true;
  selected = -1;
  /// From where to where a throw is drawn [CSS pixels].
  arrow: [number, number, number, number] | null = null;
  /// Whether the camera moves back as the pile grows, until the user moves it.
  follows = false;
  private box: [Vector3, Vector3];
  private sun: DirectionalLight | null = null;
  /// Times at which frames were drawn [ms], the last few.
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
    this.scene.background = colour(head.colours.paper);
    this.labels = overlay.getContext("2d")!;
    this.gridLength = niceLength(Math.max(...this.boxSizes()) / 5);
    this.camera = this.flat ? new OrthographicCamera() : new PerspectiveCamera(26);
    this.controls = new OrbitControls(this.camera, canvas);
    this.prepareControls();
    this.addSurroundings();
    this.scene.add(this.layers);
    this.layers.renderOrder = 10;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
    this.fit();
  }

  /// Frees what the graphics card holds.
  dispose(): void {
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
      const [x, y, z] = this.poseOf(body);
      const at = new Vector3(x, y, this.flat ? 0 : z);
      const reach = 0.6 * this.head.shapes[this.timeline!.state.shape[body]].extent;
      low.min(at.clone().subScalar(reach));
      high.max(at.addScalar(reach));
    }
    if (this.flat) low.z = high.z = 0;
    if (this.head.ground.present) low.setComponent(this.flat ? 1 : 2, Math.max(low.getComponent(this.flat ? 1 : 2), this.head.ground.height));
    if (low.distanceTo(high) > before) this.fit(false);
  }

  private prepareControls(): void {
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.redraw());
    this.controls.addEventListener("start", () => (this.follows = false));
    if (this.flat) {
      this.controls.enableRotate = false;
      this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
      this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    } else {
      this.camera.up.set(0, 0, 1);
      this.controls.maxPolarAngle = 0.5 * Math.PI;
    }
  }

  /// Shows the whole box, from where the pictures do unless `turn` is false.
  fit(turn = true): void {
    this.placeSun();
    const [low, high] = this.box;
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
      this.camera.zoom = this.camera.top / half;
      this.camera.position.set(middle.x, middle.y, 100);
    }
    this.controls.target.copy(middle);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.redraw();
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

  private addSurroundings(): void {
    const { colours, obstacles, ground } = this.head;
    const size = Math.hypot(...this.boxSizes());
    const material = outlined(
      this.flat ? new MeshBasicMaterial() : new MeshLambertMaterial({ transparent: true, opacity: 0.45, depthWrite: false, side: DoubleSide }),
      colours.obstacle_outline,
      colours.obstacle_outline,
    );
    for (const obstacle of obstacles) {
      const instance = new Instances(geometryOf(obstacle.pieces), material, false, 1);
      instance.set(instance.add(0), this.matrixOf(obstacle.pose), colour(colours.obstacle), false);
      this.obstacles.push(instance);
      this.scene.add(instance.mesh);
    }
    if (!this.flat) this.addLights();
    if (ground.present) this.flat ? this.addGroundLine(size) : this.addGroundPlane(size);
  }

  private addLights(): void {
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    const sun = new DirectionalLight(0xffffff, 2.1);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.radius = 4;
    this.sun = sun;
    this.scene.add(sun, sun.target, new AmbientLight(0xffffff, 1.7));
  }

  /// Light from the left of the eye at the start, with shadows of all that is in the box.
  private placeSun(): void {
    const { sun } = this;
    if (!sun) return;
    const size = this.box[0].distanceTo(this.box[1]);
    const middle = this.box[0].clone().add(this.box[1]).multiplyScalar(0.5);
    const azimuth = this.head.camera.azimuth - 0.9;
    sun.position.copy(middle).add(new Vector3(Math.cos(azimuth), Math.sin(azimuth), 1.5).multiplyScalar(size));
    sun.target.position.copy(middle);
    sun.shadow.normalBias = 0.002 * size;
    const eye = sun.shadow.camera;
    [eye.left, eye.right, eye.bottom, eye.top, eye.near, eye.far] = [-size, size, -size, size, 0.1 * size, 5 * size];
    eye.updateProjectionMatrix();
  }

  private addGroundLine(size: number): void {
    const { colours, ground } = this.head;
    const half = 100 * size;
    const plane = new Mesh(new PlaneGeometry(2 * half, half), new MeshBasicMaterial({ color: colour(colours.ground), transparent: true, opacity: 0.14 }));
    plane.position.set(0, ground.height - half / 2, -1);
    const line = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array([-half, ground.height, 1, half, ground.height, 1]), 3));
    this.scene.add(plane, new LineSegments(line, new LineBasicMaterial({ color: colour(colours.ground) })));
  }

  private addGroundPlane(size: number): void {
    const { colours, ground, box } = this.head;
    const shadow = new Mesh(new PlaneGeometry(20 * size, 20 * size), new ShadowMaterial({ opacity: 0.3 }));
    shadow.position.set((box[0][0] + box[1][0]) / 2, (box[0][1] + box[1][1]) / 2, ground.height);
    shadow.receiveShadow = true;
    const points: number[] = [];
    const reach = Math.ceil((3 * size) / this.gridLength);
    const low = [0, 1].map((axis) => Math.round((box[0][axis] + box[1][axis]) / 2 / this.gridLength) - reach);
    for (let i = 0; i <= 2 * reach; ++i) {
      const [x, y] = low.map((first) => (first + i) * this.gridLength);
      const [x0, y0, x1, y1] = [low[0], low[1], low[0] + 2 * reach, low[1] + 2 * reach].map((value) => value * this.gridLength);
      points.push(x, y0, ground.height, x, y1, ground.height, x0, y, ground.height, x1, y, ground.height);
    }
    const lines = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
    this.scene.add(shadow, new LineSegments(lines, new LineBasicMaterial({ color: colour(colours.ground), transparent: true, opacity: 0.16 })));
  }

  /// Of a pose in m and rad: x, z, angle or x, y, z, quaternion w, x, y, z.
  private matrixOf(pose: ArrayLike<number>): Matrix4 {
    const one = new Vector3(1, 1, 1);
    if (this.flat) return new Matrix4().makeRotationZ(pose[2]).setPosition(pose[0], pose[1], 0);
    return new Matrix4().compose(new Vector3(pose[0], pose[1], pose[2]), new Quaternion(pose[4], pose[5], pose[6], pose[3]).normalize(), one);
  }

  /// The run whose frames are shown. Its head must be of the same scene's dimension.
  setRun(timeline: Timeline): void {
    for (const shape of this.shapes) shape.mesh.removeFromParent();
    this.shapes.length = this.place.length = 0;
    this.timeline = timeline;
    this.head = timeline.head;
    this.box = this.boxOf(this.head);
    const { awake_outline, asleep_outline } = this.head.colours;
    const material = outlined(this.flat ? new MeshBasicMaterial() : new MeshLambertMaterial(), awake_outline, asleep_outline);
    for (const shape of this.head.shapes) {
      const instances = new Instances(geometryOf(shape.pieces), material, !this.flat, 64);
      this.shapes.push(instances);
      this.scene.add(instances.mesh);
    }
    this.redraw();
  }

  private poseOf(body: number): number[] {
    const { pose } = this.timeline!.state;
    const { position, angle, quaternion } = this.head.quantum;
    if (this.flat) return [pose[3 * body] * position, pose[3 * body + 1] * position, pose[3 * body + 2] * angle];
    return Array.from({ length: 7 }, (_, i) => pose[7 * body + i] * (i < 3 ? position : quaternion));
  }

  /// Brings bodies to where the timeline's state has them.
  update(changed: Changed, paint: Paint): void {
    const state = this.timeline!.state;
    const nothing = new Matrix4().makeScale(0, 0, 0);
    for (let body = this.place.length; body < state.bodies; ++body) this.place.push(this.shapes[state.shape[body]].add(body));
    const bodies = changed === "all" ? Array.from(this.place.keys()) : changed;
    for (const body of bodies) {
      const gone = body >= state.bodies || state.removed[body] !== 0;
      const matrix = gone ? nothing : this.matrixOf(this.poseOf(body));
      const tint = body === this.selected ? highlight : gone ? this.head.colours.asleep : paint(body);
      const shape = this.shapeOf(body);
      this.shapes[shape].set(this.place[body], matrix, colour(tint), !gone && state.asleep[body] !== 0);
    }
    for (const shape of this.shapes) shape.upload();
    const removed = new Set(this.timeline!.happenedSoFar().flatMap(({ number }) => this.head.events[number]?.removes ?? []));
    this.obstacles.forEach((obstacle, number) => (obstacle.mesh.visible = !removed.has(number)));
    if (this.follows) this.follow(bodies.filter((body) => body < state.bodies && state.removed[body] === 0));
    this.redraw();
  }

  /// A body keeps its shape where the frame shown is older than the body.
  private shapeOf(body: number): number {
    if (body < this.timeline!.state.bodies) return this.timeline!.state.shape[body];
    return this.shapes.findIndex((shape) => shape.bodies[this.place[body]] === body);
  }

  private updateLayers(piles: Pile[]): void {
    if (this.layersDrawn === piles) return;
    this.layersDrawn = piles;
    for (const child of this.layers.children as Mesh[]) {
      child.geometry.dispose();
      (child.material as Material).dispose();
    }
    this.layers.clear();
    for (const pile of this.showLayers ? piles : []) {
      for (const { layer, bottom, top, value } of coarse(pile)) {
        const { radius } = pile.layers[layer];
        const opacity = 0.1 + 0.22 * Math.min(1, Math.max(0, value));
        const material = new MeshBasicMaterial({ color: colour(this.head.colours.layer), transparent: true, opacity: (this.flat ? 1 : 0.5) * opacity, depthWrite: false, side: DoubleSide });
        const mesh = this.flat
          ? new Mesh(new PlaneGeometry(2 * radius, 0.97 * (top - bottom)), material)
          : new Mesh(new CylinderGeometry(radius, radius, 0.97 * (top - bottom), 48, 1, true).rotateX(0.5 * Math.PI), material);
        const height = (bottom + top) / 2;
        if (this.flat) mesh.position.set(pile.centre[0], pile.centre[1] + height, 0.5);
        else mesh.position.set(pile.centre[0], pile.centre[1], pile.centre[2] + height);
        this.layers.add(mesh);
      }
    }
  }

  /// Draws when the browser has time for the next picture.
  redraw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  private draw(): void {
    const start = performance.now();
    if (this.timeline) this.updateLayers(this.showLayers ? this.timeline.state.piles : []);
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.render(this.scene, this.camera);
    this.drawLabels();
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
    this.redraw();
  }

  private onScreen(point: Vector3): Vector2 {
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
    if (!this.showLayers || !this.timeline) return;
    paper.font = "12px system-ui, sans-serif";
    paper.textBaseline = "middle";
    const right = new Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
    let above = Infinity;
    for (const pile of this.timeline.state.piles) {
      for (const { layer, bottom, top, value, count } of coarse(pile)) {
        if (count === 0) continue;
        const middle = new Vector3(...pile.centre, 0).setComponent(this.flat ? 1 : 2, pile.centre[this.flat ? 1 : 2] + (bottom + top) / 2);
        if (this.flat) middle.z = 0;
        const at = this.onScreen(middle.addScaledVector(right, pile.layers[layer].radius));
        if (Math.abs(above - at.y) < 13) continue;
        above = at.y;
        paper.lineWidth = 3;
        paper.strokeStyle = css(this.head.colours.paper, 0.85);
        paper.fillStyle = css(this.head.colours.layer);
        paper.strokeText(value.toFixed(2), at.x + 5, at.y);
        paper.fillText(value.toFixed(2), at.x + 5, at.y);
      }
    }
  }

  private drawArrow(): void {
    if (!this.arrow) return;
    const [x0, y0, x1, y1] = this.arrow;
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

  private drawScale(): void {
    const paper = this.labels;
    const bottom = this.canvas.clientHeight - 14;
    paper.fillStyle = paper.strokeStyle = css(this.head.colours.quiet_text);
    paper.font = "12px system-ui, sans-serif";
    paper.textBaseline = "middle";
    if (!this.flat) {
      paper.fillText(`squares of ${this.gridLength} m`, 14, bottom);
      return;
    }
    const pixelsPerMetre = this.onScreen(new Vector3(1, 0, 0)).x - this.onScreen(new Vector3(0, 0, 0)).x;
    const length = niceLength(this.canvas.clientWidth / 6 / pixelsPerMetre);
    const end = 14 + length * pixelsPerMetre;
    paper.lineWidth = 1.5;
    paper.beginPath();
    for (const [x, y] of [[14, bottom - 4], [14, bottom + 4], [14, bottom], [end, bottom], [end, bottom - 4], [end, bottom + 4]]) paper.lineTo(x, y);
    paper.stroke();
    paper.fillText(`${length} m`, end + 7, bottom);
  }

  /// The body at a place of the canvas [CSS pixels], -1: none.
  bodyAt(x: number, y: number): number {
    const ray = new Raycaster();
    const place = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    ray.setFromCamera(place, this.camera);
    const hits = this.shapes.flatMap((shape) => ray.intersectObject(shape.mesh).map((hit) => ({ distance: hit.distance, body: shape.bodies[hit.instanceId!] })));
    hits.sort((a, b) => a.distance - b.distance);
    return hits.find(({ body }) => body < this.timeline!.state.bodies)?.body ?? -1;
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

/// At most mostLayers slices of a pile, neighbours put together.
function coarse(pile: Pile): { layer: number; bottom: number; top: number; value: number; count: number }[] {
  const together = Math.max(1, Math.ceil(pile.layers.length / mostLayers));
  const slices = [];
  for (let layer = 0; layer < pile.layers.length; layer += together) {
    const end = Math.min(pile.layers.length, layer + together);
    let [count, capacity] = [0, 0];
    for (let i = layer; i < end; ++i) {
      count += pile.counts[2 * i];
      capacity += pile.layers[i].capacity;
    }
    const value = together === 1 ? density(pile, layer) : capacity > 0 ? count / capacity : 0;
    slices.push({ layer, bottom: pile.layers[layer].bottom, top: pile.layers[end - 1].top, value, count });
  }
  return slices;
}
