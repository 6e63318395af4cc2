// Contacts on the screen: at each point a disc with a bar along the normal as long as the normal force is large, or
// force chains, which are lines between the middles of bodies as wide as their force is large.

import { colour, force as tints, mixed } from "./colours";
import { chainsOf, type Contact, magnitude } from "./contacts";
import type { Head, Point, Rgb } from "./head";
import { roundUp } from "./scale";
import { near } from "./sides";
import { CylinderGeometry, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from "./vendor";

/// Longest bar, in lengths of that of the scale.
const longest = 2;
const up = new Vector3(0, 1, 0);

/// Width of a line, in lengths of a bar.
export const lineWidth = 0.07;

export type ContactWay = "none" | "points" | "chains";

/// The force above which one in five lies.
function largeForce(forces: number[]): number {
  return forces.sort((a, b) => a - b)[Math.floor(0.8 * forces.length)] ?? 0;
}

export class ContactMarks {
  readonly group = new Group();
  /// Length of a bar of the force below [m]; a line is narrower by lineWidth.
  readonly length: number;
  /// [N]; changes only where bars would be much too long or short.
  force = 0;
  /// How many are drawn.
  count = 0;
  private discs: InstancedMesh | null = null;
  private bars: InstancedMesh | null = null;
  private readonly flat: boolean;

  constructor(private readonly head: Head) {
    this.flat = head.dimension === 2;
    this.length = Math.min(...head.shapes.map(({ extent }) => extent));
    if (!Number.isFinite(this.length)) this.length = 1;
    this.group.renderOrder = 20;
  }

  /// `middle`: of a body [m].
  show(contacts: Contact[], way: ContactWay, middle: (body: number) => Point): void {
    const chains = way === "chains" ? chainsOf(contacts) : [];
    const count = (this.count = way === "chains" ? chains.length : contacts.length);
    this.makeRoom(count);
    if (!this.discs || !this.bars) return;
    this.bars.count = count;
    this.discs.count = way === "chains" ? 0 : count;
    if (count === 0) return;
    const large = largeForce(way === "chains" ? chains.map(({ force }) => force) : contacts.map(({ normalForce }) => magnitude(normalForce)));
    if (large > 1.25 * this.force || large < 0.3 * this.force) this.force = roundUp(large);
    if (way === "chains") chains.forEach(({ a, b, point, force, kept }, i) => this.placeLine(middle(a), b < 0 ? point : near(this.head.sides, middle(b), middle(a)), force, kept, i));
    else contacts.forEach((contact, i) => this.placePoint(contact, i));
    for (const mesh of [this.discs, this.bars]) {
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  private vector(point: Point): Vector3 {
    return new Vector3(point[0], point[1], this.flat ? 1 : point[2]);
  }

  private tint(share: number, kept: boolean): Rgb {
    const tint = mixed(tints[0], tints[1], Math.min(1, share));
    return kept ? mixed(tint, this.head.colours.paper, 0.35) : tint;
  }

  private placeLine(from: Point, to: Point, force: number, kept: boolean, i: number): void {
    const [a, b] = [this.vector(from), this.vector(to)];
    const share = Math.min(longest, force / this.force);
    const along = b.clone().sub(a);
    const length = along.length() || 1e-9;
    const radius = this.length * Math.max(0.006, (lineWidth / 2) * share);
    this.bars!.setMatrixAt(i, new Matrix4().compose(a.add(b).multiplyScalar(0.5), new Quaternion().setFromUnitVectors(up, along.divideScalar(length)), new Vector3(radius, length, radius)));
    this.bars!.setColorAt(i, colour(this.tint(share, kept)));
  }

  private placePoint({ point, normalForce, kept }: Contact, i: number): void {
    const size = magnitude(normalForce);
    const share = Math.min(longest, size / this.force);
    const at = this.vector(point);
    const normal = new Vector3(normalForce[0], normalForce[1], normalForce[2] ?? 0).divideScalar(size || 1);
    const along = new Quaternion().setFromUnitVectors(up, normal);
    // Seen from above in 2D; in 3D in the plane in which the bodies touch.
    const facing = this.flat ? new Quaternion().setFromUnitVectors(up, new Vector3(0, 0, 1)) : along;
    const radius = this.length * (this.flat ? 0.05 : 0.07);
    const width = this.length * (0.014 + 0.03 * Math.min(1, share));
    this.discs!.setMatrixAt(i, new Matrix4().compose(at, facing, new Vector3(radius, 0.01 * this.length, radius)));
    this.bars!.setMatrixAt(i, new Matrix4().compose(at, along, new Vector3(width, this.length * share, width)));
    const tint = colour(this.tint(share, kept));
    this.discs!.setColorAt(i, tint);
    this.bars!.setColorAt(i, tint);
  }

  private makeRoom(count: number): void {
    if (this.discs && this.discs.instanceMatrix.count >= count) return;
    for (const mesh of [this.discs, this.bars]) {
      mesh?.removeFromParent();
      mesh?.geometry.dispose();
      mesh?.dispose();
    }
    const make = (sides: number): InstancedMesh => {
      // Drawn over the bodies, which hide most contacts.
      const material = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true, opacity: 0.95 });
      const mesh = new InstancedMesh(new CylinderGeometry(1, 1, 1, sides), material, Math.max(64, 2 * count));
      mesh.instanceMatrix.setUsage(DynamicDrawUsage);
      mesh.frustumCulled = false;
      mesh.renderOrder = 20;
      this.group.add(mesh);
      return mesh;
    };
    [this.discs, this.bars] = [make(12), make(6)];
  }
}
