// A cube of 10 x 10 x 10 cubes falls apart under a ball. A key throws the ball again.
import Feather from 'feather-physics';
import { Stage, THREE } from './stage.mjs';

const SIDE = 10, GAP = 1.02; // cubes; m from one cube's centre to the next
const { World } = await Feather();
const world = new World({ substeps: 4 });
world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
const cubes = [];
for (let i = 0; i < SIDE ** 3; ++i) {
    const at = [i % SIDE, Math.floor(i / SIDE) % SIDE, Math.floor(i / SIDE ** 2)];
    const cube = world.createBody({ position: [(at[0] - 4.5) * GAP, 0.5 + at[1] * GAP, (at[2] - 4.5) * GAP] });
    cube.addBox(0.5, 0.5, 0.5, { density: 400, friction: 0.5 });
    cubes.push(cube);
}
const ball = world.createBody({ position: [-22, 7, 3] });
ball.addSphere(1.5, { density: 2000 });
const shoot = () => {
    ball.position = [-22, 7, 3];
    ball.linearVelocity = [30, 2, -2];
};
shoot();
addEventListener('keydown', shoot);

const stage = new Stage(world);
const hues = (k) => new THREE.Color().setHSL((Math.floor(k / SIDE) % SIDE) / SIDE, 0.55, 0.55);
stage.add(new THREE.BoxGeometry(1, 1, 1), cubes, hues);
stage.add(new THREE.SphereGeometry(1.5, 32, 16), [ball], () => new THREE.Color(0xe8e8ea));
stage.run();
