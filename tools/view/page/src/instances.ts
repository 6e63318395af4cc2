// Many bodies of one shape, drawn at once with their outlines.

import { colour } from "./colours";
import type { Rgb } from "./head";
import { BufferGeometry, Color, DynamicDrawUsage, InstancedBufferAttribute, InstancedMesh, LineSegments, type Material, type Matrix4, Mesh, type Object3D, Vector3 } from "./vendor";

/// The bodies of one shape.
export class Instances {
  mesh: InstancedMesh;
  readonly bodies: number[] = [];
  private sleeping: InstancedBufferAttribute;
  private changed = false;

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
      const [old, asleep] = [this.mesh, this.sleeping];
      [this.mesh, this.sleeping] = this.make(2 * room);
      this.mesh.instanceMatrix.array.set(old.instanceMatrix.array);
      this.mesh.instanceColor!.array.set(old.instanceColor!.array);
      this.sleeping.array.set(asleep.array);
      old.parent?.add(this.mesh);
      discard(old);
    }
    this.bodies.push(body);
    this.mesh.count = this.bodies.length;
    return this.bodies.length - 1;
  }

  /// Takes the body at a place out; returns the one that has this place now, the same where there is none.
  remove(place: number): number {
    const last = this.bodies.length - 1;
    const moved = this.bodies[last];
    if (place !== last) {
      const { instanceMatrix, instanceColor } = this.mesh;
      instanceMatrix.array.copyWithin(16 * place, 16 * last, 16 * last + 16);
      instanceColor!.array.copyWithin(3 * place, 3 * last, 3 * last + 3);
      this.sleeping.setX(place, this.sleeping.getX(last));
      this.bodies[place] = moved;
    }
    this.bodies.pop();
    this.mesh.count = this.bodies.length;
    this.changed = true;
    return moved;
  }

  dispose(): void {
    discard(this.mesh);
  }

  clear(): void {
    this.bodies.length = this.mesh.count = 0;
  }

  set(place: number, matrix: Matrix4, tint: Color, asleep: boolean): void {
    this.mesh.setMatrixAt(place, matrix);
    this.mesh.setColorAt(place, tint);
    this.sleeping.setX(place, asleep ? 1 : 0);
    this.changed = true;
  }

  /// Sends the graphics card what changed since the last time.
  upload(): void {
    if (!this.changed) return;
    this.changed = false;
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.instanceColor!.needsUpdate = true;
    this.sleeping.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }
}

/// Takes a part out of the scene and frees what the graphics card holds of it, but for its materials.
export function discard(part: Object3D): void {
  part.removeFromParent();
  part.traverse((one) => {
    if (one instanceof Mesh || one instanceof LineSegments) one.geometry.dispose();
    if (one instanceof InstancedMesh) one.dispose();
  });
}

/// A share of `colour` in all colours, which may change from picture to picture.
export interface Veil {
  colour: Rgb;
  share: { value: number };
}

/// Draws outlines one and a half pixels wide, in one colour where `sleeping` is 0, in another where it is 1.
export function outlined(material: Material, awake: Rgb, asleep: Rgb, veil: Veil = { colour: awake, share: { value: 0 } }): Material {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.veil = veil.share;
    shader.uniforms.veilColour = { value: new Vector3(...veil.colour) };
    shader.uniforms.awakeOutline = { value: colour(awake) };
    shader.uniforms.asleepOutline = { value: colour(asleep) };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nattribute float edge; attribute float sleeping; varying float vEdge; varying float vSleeping;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvEdge = edge; vSleeping = sleeping;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nuniform vec3 awakeOutline; uniform vec3 asleepOutline; uniform float veil; uniform vec3 veilColour; varying float vEdge; varying float vSleeping;")
      .replace("#include <colorspace_fragment>", "#include <colorspace_fragment>\ngl_FragColor.rgb = mix(gl_FragColor.rgb, veilColour, veil);")
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
