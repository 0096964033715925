// bench.mjs - milliseconds of the page's main thread a frame, without the steps: a heap of BODIES that falls, all of it awake.
//   make test-viewer; VIEWER_PAGE=build/viewer.html VIEWER_TOOLS=build/viewer-test node tools/viewer/tests/bench.mjs [bodies]
import { resolve } from 'node:path';
process.env.VIEWER_PAGE = resolve(process.env.VIEWER_PAGE ?? 'build/viewer.html'), process.env.VIEWER_TOOLS = resolve(process.env.VIEWER_TOOLS ?? 'build/viewer-test');
const { openBrowser, openPage, drop } = await import('./page.mjs');
const { default: Feather } = await import(resolve(process.env.FEATHER_PACKAGE ?? 'build/js', 'index.js'));

const bodies = Number(process.argv[2] ?? 5000), STEPS = 60, FRAMES = 30, side = Math.ceil(Math.cbrt(bodies));
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
const bytes = recorder.read(), browser = await openBrowser(), page = await openPage(browser, '?demo=none', { width: 800, height: 500 });
const start = performance.now();
await drop(page, [{ name: 'heap.feather', bytes }]);
const opened = performance.now() - start;
const told = await page.evaluate((frames) => new Promise((done) => {
    const draw = [], step = [];
    viewer.onFrame = (spent, steps) => {
        if (steps) draw.push(spent.draw), step.push(spent.step);
        if (draw.length < frames && viewer.playing) return;
        viewer.onFrame = null;
        const sorted = draw.sort((a, b) => a - b), at = (p) => sorted[Math.floor(p * (sorted.length - 1))];
        done({ frames: sorted.length, median: at(0.5), tenth: at(0.1), ninth: at(0.9), step: step.sort((a, b) => a - b)[step.length >> 1], calls: viewer.view.renderer.info.render.calls });
    };
    viewer.play();
}), FRAMES);
console.log(`${bodies} bodies, ${(bytes.length / 1e6).toFixed(1)} MB: shown ${(opened / 1e3).toFixed(1)} s after the drop
${told.frames} frames with steps: main thread without steps ${told.tenth.toFixed(1)}, ${told.median.toFixed(1)}, ${told.ninth.toFixed(1)} ms (10th, 50th, 90th percentile); steps ${told.step.toFixed(1)} ms
${told.calls} draw calls`);
await browser.close();
