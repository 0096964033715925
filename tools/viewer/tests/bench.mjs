// bench.mjs - milliseconds that the page's main thread takes for a frame, without the step: a heap of BODIES that falls, all of it
// awake. Taking and placing is what the page computes, rendering what three does until the GPU has its commands.
//   make test-viewer; node tools/viewer/tests/bench.mjs [bodies]
import { resolve } from 'node:path';
process.env.VIEWER_PAGE = resolve(process.env.VIEWER_PAGE ?? 'build/viewer.html'), process.env.VIEWER_TOOLS = resolve(process.env.VIEWER_TOOLS ?? 'build/viewer-test');
const { openBrowser, openPage, drop } = await import('./page.mjs');
const { default: Feather } = await import(resolve(process.env.FEATHER_PACKAGE ?? 'build/js', 'index.js'));

const bodies = Number(process.argv[2] ?? 5000), STEPS = 40, side = Math.ceil(Math.cbrt(bodies));
const { World } = await Feather(), world = new World();
world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
for (let k = 0; k < bodies; ++k) {
    const at = (n) => 1.3 * (n - side / 2), body = world.createBody({ position: [at(k % side), 1 + 1.3 * Math.floor(k / side ** 2), at(Math.floor(k / side) % side)], angularVelocity: [k % 3, 1, k % 5] });
    if (k % 3 === 0) body.addBox(0.4, 0.3, 0.35);
    else if (k % 3 === 1) body.addSphere(0.4);
    else body.addCapsule(0.3, 0.25);
}
const recorder = world.createRecorder();
for (let k = 0; k < STEPS; ++k) world.step(1 / 60);
const bytes = recorder.read(), browser = await openBrowser(), page = await openPage(browser, '?demo=none', { width: 160, height: 120 });
const start = performance.now();
await drop(page, [{ name: 'heap.feather', bytes }]);
const opened = performance.now() - start;
const told = await page.evaluate((steps) => {
    viewer.scanner.worker.terminate(); // another processor's work, where there is one
    const { instances, playback, view } = viewer, placed = [], rendered = [];
    for (let k = 0; k < steps && playback.advance(); ++k) {
        const a = performance.now();
        instances.take(viewer.world, view.origin, ['shapes', 'islands', 'sleep'], true), instances.draw(0.5);
        const b = performance.now();
        placed.push(b - a);
        if (k % 8 === 0) view.render(), rendered.push(performance.now() - b);
    }
    const at = (list, p) => list.sort((a, b) => a - b)[Math.floor(p * (list.length - 1))].toFixed(2);
    return { placed: [at(placed, 0.1), at(placed, 0.5)], rendered: [at(rendered, 0.1), at(rendered, 0.5)], calls: view.renderer.info.render.calls };
}, STEPS - 5);
console.log(`${bodies} bodies, ${(bytes.length / 1e6).toFixed(1)} MB: shown ${(opened / 1e3).toFixed(1)} s after the drop
taking and placing ${told.placed.join(', ')} ms, rendering ${told.rendered.join(', ')} ms (10th, 50th percentile); ${told.calls} draw calls`);
await browser.close();
