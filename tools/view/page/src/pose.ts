// Poses as the messages have them.

import { Matrix4, Quaternion, Vector3 } from "./vendor";

/// Numbers of a pose.
export const poseValues = (dimension: number): number => (dimension === 2 ? 3 : 7);

/// Of a pose in m and rad: x, z, angle or x, y, z, quaternion w, x, y, z.
export function matrixOf(pose: ArrayLike<number>): Matrix4 {
  if (pose.length === 3) return new Matrix4().makeRotationZ(pose[2]).setPosition(pose[0], pose[1], 0);
  return new Matrix4().compose(new Vector3(pose[0], pose[1], pose[2]), new Quaternion(pose[4], pose[5], pose[6], pose[3]).normalize(), new Vector3(1, 1, 1));
}

/// Between two poses. A rotation has many numbers: of the second those nearest to the first are taken.
export function mixedPose(a: ArrayLike<number>, b: ArrayLike<number>, share: number): number[] {
  const turn = 2 * Math.PI;
  const turns = a.length === 3 ? turn * Math.round((b[2] - a[2]) / turn) : 0;
  const opposite = a.length === 7 && a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0;
  return Array.from(a, (part, i) => part + share * ((opposite && i > 2 ? -b[i] : b[i]) - (a.length === 3 && i === 2 ? turns : 0) - part));
}
