// A cube of 1 m falls from 4 m, as in examples/hello.c:  make js && node examples/js/hello.mjs
import Feather from '../../build/js/index.js';

const { World } = await Feather();
const world = new World();
world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
const box = world.createBody({ position: [0, 4, 0] });
box.addBox(0.5, 0.5, 0.5);
for (let step = 0; step <= 90; ++step) {
    if (step % 15 === 0) console.log(`${(step / 60).toFixed(2)} s  y = ${box.position.y.toFixed(4)} m`);
    world.step(1 / 60);
}
world.destroy();
