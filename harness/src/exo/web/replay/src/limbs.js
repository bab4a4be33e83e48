// The moving arm: links on their joints, handle, suction pad.

import { CapsuleGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Object3D, SphereGeometry } from "three";

const material = (roughness = 0.5, metalness = 0.15) => new MeshStandardMaterial({ roughness, metalness });

function shadowed(geometry, look) {
  const mesh = new Mesh(geometry, look);
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** A rod between two points of the x-z plane. */
function rod([x0, z0], [x1, z1], radius, look) {
  const length = Math.hypot(x1 - x0, z1 - z0);
  const mesh = shadowed(new CapsuleGeometry(radius, Math.max(1e-3, length), 6, 16), look);
  mesh.position.set((x0 + x1) / 2, 0, (z0 + z1) / 2);
  // A capsule stands along y.
  mesh.rotation.set(Math.PI / 2, 0, 0, "YXZ");
  mesh.rotation.y = Math.atan2(x1 - x0, z1 - z0);
  return mesh;
}

function joint(radius, length, look) {
  return shadowed(new CylinderGeometry(radius, radius, length, 28), look);
}

/** One arm at its `base`; `pose(q)` turns its joints. Its frame is that of the plant. */
export function limbs(geometry, base, floor) {
  const looks = { link: material(), joint: material(0.45, 0.4), post: material(0.8, 0), grip: material(0.6, 0), cup: material(0.7, 0) };
  const root = new Group();
  root.position.set(...base);
  const post = shadowed(new CylinderGeometry(0.022, 0.026, -floor, 20), looks.post);
  post.rotation.x = Math.PI / 2;
  post.position.set(0, 0, floor / 2);
  const foot = shadowed(new CylinderGeometry(0.1, 0.11, 0.02, 32), looks.post);
  foot.rotation.x = Math.PI / 2;
  foot.position.set(0, 0, floor + 0.01);
  const yaw = new Group();
  const turntable = joint(0.045, 0.1, looks.joint);
  turntable.rotation.x = Math.PI / 2;
  const shoulder = new Group();
  shoulder.position.x = geometry.A1;
  const elbow = new Group();
  elbow.position.x = geometry.L1;
  const [hx, hz] = geometry.handle;
  const [px, pz] = geometry.pad;
  elbow.add(rod([0, 0], [hx, hz], 0.024, looks.link), joint(0.036, 0.085, looks.joint), rod([hx, hz], [px, pz], 0.011, looks.joint));
  const hand = new Object3D();
  hand.position.set(hx, 0, hz);
  const grip = shadowed(new CapsuleGeometry(0.016, 0.1, 6, 16), looks.grip);
  hand.add(grip, shadowed(new SphereGeometry(0.026, 24, 16), looks.grip));
  elbow.add(hand);
  shoulder.add(rod([0, 0], [geometry.L1, 0], 0.03, looks.link), joint(0.042, 0.1, looks.joint), elbow);
  yaw.add(turntable, rod([0, 0], [geometry.A1, 0], 0.03, looks.link), shoulder);
  // The cup keeps level: the model has it as a point.
  const cup = shadowed(new CylinderGeometry(0.017, 0.04, 0.026, 28), looks.cup);
  cup.rotation.x = Math.PI / 2;
  root.add(post, foot, yaw);
  return {
    root,
    cup,
    hand,
    pose(q, pad) {
      yaw.rotation.z = q[0];
      shoulder.rotation.y = -q[1];
      elbow.rotation.y = -q[2];
      cup.position.set(pad[0], pad[1], pad[2] + 0.013);
    },
    paint(palette) {
      looks.link.color.set(palette.robot);
      looks.joint.color.set(palette.joint);
      looks.post.color.set(palette.post);
      looks.grip.color.set(palette.grip);
      looks.cup.color.set(palette.cup);
    },
  };
}
