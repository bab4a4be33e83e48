// Where points of an arm are: the plant's kinematics (plant-fmu/mechanics/src/arm/kinematics.rs).
//
// Base frame: x forward, y to the left, z up, origin at the shoulder. Joints: yaw about z, pitch of shoulder and elbow
// about −y, so that positive pitch lifts.

/** A point of link 3 at `along`, `across` from the elbow; `base` is the shoulder (m), `q` the joint angles (rad). */
function point(geometry, base, q, [along, across]) {
  const pitch = q[1] + q[2];
  const r = geometry.A1 + geometry.L1 * Math.cos(q[1]) + along * Math.cos(pitch) - across * Math.sin(pitch);
  const z = geometry.L1 * Math.sin(q[1]) + along * Math.sin(pitch) + across * Math.cos(pitch);
  return [base[0] + r * Math.cos(q[0]), base[1] + r * Math.sin(q[0]), base[2] + z];
}

/** Handle, pad and joints of an arm (m). */
export function points(geometry, base, q) {
  return {
    shoulder: [base[0] + geometry.A1 * Math.cos(q[0]), base[1] + geometry.A1 * Math.sin(q[0]), base[2]],
    elbow: point(geometry, base, q, [0, 0]),
    handle: point(geometry, base, q, geometry.handle),
    pad: point(geometry, base, q, geometry.pad),
  };
}

/** The middle of the pads, under which the payload hangs. */
export function middleOfPads(geometry, arms) {
  const pads = arms.map((arm, side) => points(geometry, geometry.bases[side], arm.q).pad);
  return [0, 1, 2].map((k) => pads.reduce((sum, pad) => sum + pad[k], 0) / pads.length);
}
