// The scenes of examples/web in headless Chromium: they load, step, and do as a hand on the keys says.
//   node pages.mjs folder      of node_modules with playwright-core and three
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { extname } from 'node:path';

const [tools] = process.argv.slice(2), LIMIT = 240e3; // ms; a busy machine draws a frame in a second
const { chromium } = createRequire(`${tools}/`)('playwright-core');
const examples = fileURLToPath(new URL('../../../examples/web', import.meta.url));
const package_ = process.env.FEATHER_PACKAGE ?? fileURLToPath(new URL('../../../build/js', import.meta.url));
const TYPES = { '.html': 'text/html', '.wasm': 'application/wasm' };

const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://host'), path = pathname === '/' ? '/index.html' : pathname;
    const file = path.startsWith('/feather-physics/') ? package_ + path.slice('/feather-physics'.length)
        : (path.startsWith('/node_modules/') ? tools : examples) + path;
    try {
        const bytes = await readFile(file);
        response.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'text/javascript' }).end(bytes);
    } catch {
        response.writeHead(404).end();
    }
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
// WebGL 2 without a GPU, as root too
const args = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args });

async function open(scene, key) {
    const page = await browser.newPage({ viewport: { width: 320, height: 200 } });
    page.setDefaultTimeout(LIMIT);
    page.errors = [];
    page.on('pageerror', (error) => page.errors.push(error.stack));
    await page.goto(`http://127.0.0.1:${server.address().port}/?${scene}`);
    await page.waitForFunction('window.stage');
    if (key) await page.keyboard.down(key);
    return page;
}
async function close(page) {
    assert.match(await page.textContent('#told'), /ms a step, \d+ awake, \d+ contacts\nhash [0-9a-f]{16} after \d+ steps/);
    assert.deepEqual(page.errors, []);
    await page.close();
}
const after = (page, steps) => page.waitForFunction(`document.querySelector('#told').textContent.match(/after (\\d+)/)?.[1] >= ${steps}`);

const cubes = await open('cubes');
await after(cubes, 30);
await close(cubes);

const ragdolls = await open('ragdolls');
const highest = () => ragdolls.evaluate('Math.max(...stage.world.bodies.map((id) => stage.world.body(id).position.y))');
const before = await highest();
await after(ragdolls, 60);
assert.ok(before - await highest() > 1, 'nobody fell');
await close(ragdolls);

const car = await open('car', 'ArrowUp');
await after(car, 90);
assert.ok(await car.evaluate('stage.target.x') > 1, 'the car did not drive');
await close(car);

await browser.close();
server.close();
