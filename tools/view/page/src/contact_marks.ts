// Contacts on the screen: a disc at each point, and a bar along the normal as long as the normal force is large.

import { colour } from "./colours";
import { type Contact, magnitude } from "./contacts";
import type { Head, Rgb } from "./head";
import { Color, CylinderGeometry, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from "./vendor";

const weak: Rgb = [0.1, 0.75, 0.7];
const strong: Rgb = [0.85, 0.05, 0.5];
/// Longest bar, in lengths of that of the scale.
const longest = 2;

/// The force above which one in five lies.
function largeForce(contacts: Contact[]): number {
  const forces = contacts.map(({ normalForce }) => magnitude(normalForce)).sort((a, b) => a - b);
  return forces[Math.floor(0.8 * forces.length)] ?? 0;
}

/// 1, 2 or 5 times a power of ten, at least `value`.
function roundUp(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([1, 2, 5].find((digit) => digit * power >= value) ?? 10);
}

export class ContactMarks {
  readonly group = new Group();
  /// Length of a bar [m] of the force below.
  readonly length: number;
  /// [N]; changes only where bars would be much too long or short.
  force = 0;
  private discs: InstancedMesh | null = null;
  private bars: InstancedMesh | null = null;
  private readonly flat: boolean;

  constructor(head: Head) {
    this.flat = head.dimension === 2;
    this.length = Math.min(...head.shapes.map(({ extent }) => extent));
    if (!Number.isFinite(this.length)) this.length = 1;
    this.group.renderOrder = 20;
  }

  show(contacts: Contact[]): void {
    this.makeRoom(contacts.length);
    if (!this.discs || !this.bars) return;
    this.discs.count = this.bars.count = contacts.length;
    if (contacts.length === 0) return;
    const large = largeForce(contacts);
    if (large > 1.5 * this.force || large < 0.2 * this.force) this.force = roundUp(large);
    contacts.forEach((contact, i) => this.place(contact, i));
    for (const mesh of [this.discs, this.bars]) {
      mesh.instanceMatrix.needsUpdate = true;
      mesh.instanceColor!.needsUpdate = true;
    }
  }

  private place({ point, normalForce, kept }: Contact, i: number): void {
    const size = magnitude(normalForce);
    const share = Math.min(longest, size / this.force);
    const at = new Vector3(point[0], point[1], this.flat ? 1 : point[2]);
    const normal = new Vector3(normalForce[0], normalForce[1], normalForce[2] ?? 0).divideScalar(size || 1);
    const along = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), normal);
    // Seen from above in 2D; in 3D in the plane in which the bodies touch.
    const facing = this.flat ? new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(0, 0, 1)) : along;
    const radius = this.length * (this.flat ? 0.05 : 0.07);
    const width = this.length * (0.014 + 0.03 * Math.min(1, share));
    this.discs!.setMatrixAt(i, new Matrix4().compose(at, facing, new Vector3(radius, 0.01 * this.length, radius)));
    this.bars!.setMatrixAt(i, new Matrix4().compose(at, along, new Vector3(width, this.length * share, width)));
    const tint: Color = colour(weak).lerp(colour(strong), Math.min(1, share));
    if (kept) tint.lerp(colour([1, 1, 1]), 0.35);
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
