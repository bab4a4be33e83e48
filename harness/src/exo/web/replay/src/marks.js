// What is drawn on top of the arm: forces as arrows, the nominal hand as a ghost, the payload.

import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, Group, Line,
  LineDashedMaterial, Mesh, MeshBasicMaterial, MeshStandardMaterial, SphereGeometry, Vector3,
} from "three";

const UP = new Vector3(0, 1, 0);

/** An arrow of any direction and length. */
export function arrow() {
  const look = new MeshBasicMaterial();
  const shaft = new Mesh(new CylinderGeometry(1, 1, 1, 14), look);
  const head = new Mesh(new ConeGeometry(1, 1, 20), look);
  const group = new Group();
  group.add(shaft, head);
  group.visible = false;
  const direction = new Vector3();
  return {
    group,
    look,
    /** From `from` (m) along `vector` (m). */
    set(from, vector) {
      const length = Math.hypot(...vector);
      group.visible = length > 0.004;
      if (!group.visible) return;
      group.position.set(...from);
      group.quaternion.setFromUnitVectors(UP, direction.set(...vector).divideScalar(length));
      const tip = Math.min(0.05, 0.6 * length);
      shaft.scale.set(0.008, length - tip, 0.008);
      shaft.position.y = (length - tip) / 2;
      head.scale.set(0.02, tip, 0.02);
      head.position.y = length - tip / 2;
    },
  };
}

/** The nominal hand, with a dashed line from the hand to it. */
export function ghost() {
  const look = new MeshStandardMaterial({ transparent: true, opacity: 0.55, roughness: 0.6, depthWrite: false, depthTest: false });
  const line = new LineDashedMaterial({ dashSize: 0.014, gapSize: 0.01, depthTest: false });
  const shape = new Group();
  shape.add(new Mesh(new CapsuleGeometry(0.018, 0.11, 6, 16), look), new Mesh(new SphereGeometry(0.03, 24, 16), look));
  const cone = new Mesh(new ConeGeometry(0.03, 0.07, 24), look);
  const positions = new Float32BufferAttribute(6, 3);
  const thread = new Line(new BufferGeometry().setAttribute("position", positions), line);
  thread.frustumCulled = false;
  const group = new Group();
  group.add(shape, cone, thread);
  // Seen through table and wall: that is where a law pulls it.
  group.traverse((one) => (one.renderOrder = 2));
  const direction = new Vector3();
  return {
    group,
    paint(color) {
      look.color.set(color);
      line.color.set(color);
    },
    set(hand, { at, outside }, yaw) {
      shape.visible = !outside;
      cone.visible = outside;
      shape.position.set(...at);
      shape.rotation.z = yaw;
      cone.position.set(...at);
      if (outside) cone.quaternion.setFromUnitVectors(UP, direction.set(at[0] - hand[0], at[1] - hand[1], at[2] - hand[2]).normalize());
      positions.setXYZ(0, ...hand);
      positions.setXYZ(1, ...at);
      positions.needsUpdate = true;
      thread.computeLineDistances();
    },
  };
}

/** The payload as a plate of steel of its mass. */
export function plate(size) {
  const look = new MeshStandardMaterial({ roughness: 0.55, metalness: 0.2 });
  const mesh = new Mesh(new BoxGeometry(...size), look);
  mesh.castShadow = mesh.receiveShadow = true;
  return {
    mesh,
    look,
    /** `top` is the middle of its upper face (m). */
    set(top, yaw) {
      mesh.position.set(top[0], top[1], top[2] - size[2] / 2);
      mesh.rotation.z = yaw;
    },
  };
}
