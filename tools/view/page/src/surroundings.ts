// What stands around the bodies: obstacles, ground, and the light.

import { colour } from "./colours";
import { type Box, boundsOf, type Head } from "./head";
import { discard, Instances, outlined } from "./instances";
import { matrixOf } from "./pose";
import { niceLength } from "./scale";
import { geometryOf } from "./shapes";
import { outlinesOf, shiftsInside } from "./sides";
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  type Raycaster,
  ShadowMaterial,
  Vector3,
} from "./vendor";

export class Surroundings {
  readonly group = new Group();
  /// Of the squares on the ground [m].
  readonly gridLength: number;
  private readonly obstacles: Instances[] = [];
  private readonly sun: DirectionalLight | null = null;
  /// Of the box [m].
  readonly size: number;

  /// `box`: the part of space about which ground is drawn.
  constructor(
    private readonly head: Head,
    private readonly box: Box,
  ) {
    const sizes = box[1].map((high, i) => high - box[0][i]);
    this.size = Math.hypot(...sizes);
    this.gridLength = niceLength(Math.max(...sizes) / 5);
    this.addObstacles();
    if (head.dimension === 3) {
      this.sun = new DirectionalLight(0xffffff, 2.1);
      this.sun.castShadow = true;
      this.sun.shadow.mapSize.set(2048, 2048);
      this.sun.shadow.radius = 4;
      this.group.add(this.sun, this.sun.target, new AmbientLight(0xffffff, 1.7));
    }
    this.addSides();
    if (head.ground.present) head.dimension === 2 ? this.addGroundLine() : this.addGroundPlane();
  }

  /// Takes all out of the scene and frees what the graphics card holds of it.
  dispose(): void {
    this.sun?.dispose();
    discard(this.group);
  }

  private addObstacles(): void {
    const { colours, obstacles, dimension } = this.head;
    const material = outlined(
      dimension === 2 ? new MeshBasicMaterial() : new MeshLambertMaterial({ transparent: true, opacity: 0.45, depthWrite: false, side: DoubleSide }),
      colours.obstacle_outline,
      colours.obstacle_outline,
    );
    for (const obstacle of obstacles) {
      const instance = new Instances(geometryOf(obstacle.pieces), material, false, 1);
      this.obstacles.push(instance);
      this.group.add(instance.mesh);
    }
    obstacles.forEach(({ pose }, number) => this.placeObstacle(number, pose));
  }

  /// `pose` in m and rad. With its images, where it reaches through a periodic side.
  placeObstacle(number: number, pose: ArrayLike<number>): void {
    const { colours, obstacles, sides } = this.head;
    const instance = this.obstacles[number];
    if (!instance) return;
    instance.clear();
    const own = Array.from(pose);
    for (const shift of [[], ...shiftsInside(sides, boundsOf(obstacles[number].pieces, own))])
      instance.set(instance.add(number), matrixOf(own.map((value, i) => value + (shift[i] ?? 0))), colour(colours.obstacle), false);
    instance.upload();
  }

  private addSides(): void {
    const points = outlinesOf(this.head.sides, this.box).flatMap((point) => [point[0], point[1], point[2] ?? 1]);
    const length = this.size / 60;
    const lines = new LineSegments(
      new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3)),
      new LineDashedMaterial({ color: colour(this.head.colours.ground), dashSize: length, gapSize: length }),
    );
    this.group.add(lines.computeLineDistances());
  }

  /// The nearest obstacle that a ray meets, -1: none.
  obstacleOn(ray: Raycaster): number {
    const hits = this.obstacles.flatMap(({ mesh }, number) => (mesh.visible ? ray.intersectObject(mesh).map(({ distance }) => ({ distance, number })) : []));
    hits.sort((a, b) => a.distance - b.distance);
    return hits[0]?.number ?? -1;
  }

  hideObstacles(removed: Set<number>): void {
    this.obstacles.forEach((obstacle, number) => (obstacle.mesh.visible = !removed.has(number)));
  }

  /// Light from the left of the eye at the start, with shadows of all that is in the box.
  placeSun(low: Vector3, high: Vector3): void {
    const { sun } = this;
    if (!sun) return;
    const size = low.distanceTo(high);
    const middle = low.clone().add(high).multiplyScalar(0.5);
    const azimuth = this.head.camera.azimuth - 0.9;
    sun.position.copy(middle).add(new Vector3(Math.cos(azimuth), Math.sin(azimuth), 1.5).multiplyScalar(size));
    sun.target.position.copy(middle);
    sun.shadow.normalBias = 0.002 * size;
    const eye = sun.shadow.camera;
    [eye.left, eye.right, eye.bottom, eye.top, eye.near, eye.far] = [-size, size, -size, size, 0.1 * size, 5 * size];
    eye.updateProjectionMatrix();
  }

  private addGroundLine(): void {
    const { colours, ground } = this.head;
    const half = 100 * this.size;
    const plane = new Mesh(new PlaneGeometry(2 * half, half), new MeshBasicMaterial({ color: colour(colours.ground), transparent: true, opacity: 0.14 }));
    plane.position.set(0, ground.height - half / 2, -1);
    const line = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array([-half, ground.height, 1, half, ground.height, 1]), 3));
    this.group.add(plane, new LineSegments(line, new LineBasicMaterial({ color: colour(colours.ground) })));
  }

  private addGroundPlane(): void {
    const { colours, ground } = this.head;
    const { box } = this;
    const shadow = new Mesh(new PlaneGeometry(20 * this.size, 20 * this.size), new ShadowMaterial({ opacity: 0.3 }));
    shadow.position.set((box[0][0] + box[1][0]) / 2, (box[0][1] + box[1][1]) / 2, ground.height);
    shadow.receiveShadow = true;
    const points: number[] = [];
    const reach = Math.ceil((3 * this.size) / this.gridLength);
    const low = [0, 1].map((axis) => Math.round((box[0][axis] + box[1][axis]) / 2 / this.gridLength) - reach);
    for (let i = 0; i <= 2 * reach; ++i) {
      const [x, y] = low.map((first) => (first + i) * this.gridLength);
      const [x0, y0, x1, y1] = [low[0], low[1], low[0] + 2 * reach, low[1] + 2 * reach].map((value) => value * this.gridLength);
      points.push(x, y0, ground.height, x, y1, ground.height, x0, y, ground.height, x1, y, ground.height);
    }
    const lines = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
    this.group.add(shadow, new LineSegments(lines, new LineBasicMaterial({ color: colour(colours.ground), transparent: true, opacity: 0.16 })));
  }
}
