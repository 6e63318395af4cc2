// Poses as the head and the frames have them.

import { Matrix4, Quaternion, Vector3 } from "./vendor";

/// Of a pose in m and rad: x, z, angle or x, y, z, quaternion w, x, y, z.
export function matrixOf(pose: ArrayLike<number>): Matrix4 {
  if (pose.length === 3) return new Matrix4().makeRotationZ(pose[2]).setPosition(pose[0], pose[1], 0);
  return new Matrix4().compose(new Vector3(pose[0], pose[1], pose[2]), new Quaternion(pose[4], pose[5], pose[6], pose[3]).normalize(), new Vector3(1, 1, 1));
}
