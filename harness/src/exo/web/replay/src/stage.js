// What stands around the arm: floor with its grid, table, wall, light.

import {
  AmbientLight, BoxGeometry, DirectionalLight, GridHelper, Group, HemisphereLight, Mesh, MeshStandardMaterial,
  PlaneGeometry, ShadowMaterial,
} from "three";

/** Height of the floor (m): the pad hangs above it, the table stands on it. */
export function floorOf(geometry) {
  return geometry.table === null ? -0.75 : top(geometry) - 0.3;
}

/** Height of the table's top (m). A payload has no height in the model; here it lies on the table with its top where the
 *  pad meets it. */
export function top(geometry) {
  return geometry.table - (geometry.payload?.size[2] ?? 0);
}

const solid = (roughness, more = {}) => new MeshStandardMaterial({ roughness, metalness: 0.0, ...more });

/** Everything that does not move; `paint(palette)` gives it colours. */
export function stage(geometry) {
  const group = new Group();
  const floor = floorOf(geometry);
  const wide = geometry.bases.length > 1;
  const surface = solid(0.85);
  const legs = solid(0.9);
  const glass = solid(0.7, { transparent: true, opacity: 0.55, depthWrite: false });
  if (geometry.table !== null) group.add(...table(top(geometry), floor, wide ? 1.2 : 0.8, surface, legs));
  if (geometry.wall !== null) {
    const wall = new Mesh(new BoxGeometry(0.03, wide ? 1.3 : 0.9, 0.45 - floor), glass);
    wall.position.set(geometry.wall + 0.015, 0, (0.45 + floor) / 2);
    group.add(wall);
  }
  const shadows = new ShadowMaterial({ opacity: 0.2 });
  const ground = new Mesh(new PlaneGeometry(5, 5), shadows);
  ground.position.z = floor;
  ground.receiveShadow = true;
  group.add(ground);
  let grid = null;
  const sky = new HemisphereLight(0xffffff, 0x8899aa, 1.5);
  sky.position.set(0, 0, 1);
  group.add(sky, new AmbientLight(0xffffff, 0.35), sun(floor));
  return {
    group,
    paint(palette) {
      surface.color.set(palette.table);
      legs.color.set(palette.legs);
      glass.color.set(palette.table);
      shadows.opacity = palette.shadow;
      if (grid) {
        group.remove(grid);
        grid.dispose();
      }
      // Squares of 0.1 m.
      grid = new GridHelper(2.4, 24, palette.gridAxis, palette.grid);
      grid.rotation.x = Math.PI / 2;
      grid.position.set(0.3, 0, floor + 0.001);
      group.add(grid);
    },
  };
}

function table(height, floor, width, surface, legs) {
  const board = new Mesh(new BoxGeometry(0.72, width, 0.03), surface);
  board.position.set(0.5, 0, height - 0.015);
  board.castShadow = board.receiveShadow = true;
  const found = [board];
  for (const x of [0.18, 0.82]) {
    for (const y of [-1, 1]) {
      const leg = new Mesh(new BoxGeometry(0.035, 0.035, height - 0.03 - floor), legs);
      leg.position.set(x, y * (width / 2 - 0.04), (height - 0.03 + floor) / 2);
      leg.castShadow = true;
      found.push(leg);
    }
  }
  return found;
}

function sun(floor) {
  const light = new DirectionalLight(0xffffff, 1.9);
  light.position.set(0.1, -1.1, 2.2);
  light.target.position.set(0.4, 0, floor);
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  Object.assign(light.shadow.camera, { left: -1, right: 1, top: 1, bottom: -1, near: 0.5, far: 4.5 });
  light.shadow.radius = 3;
  light.shadow.normalBias = 0.01;
  const group = new Group();
  group.add(light, light.target);
  return group;
}
