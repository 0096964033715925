// viewer.mjs - the page shows what the library says: recordings of case.c, dropped, scrubbed, picked, cut, compared.
import test, { before, after } from 'node:test';
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync, appendFileSync } from 'node:fs';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { createServer } from 'node:http';
import { openBrowser, openPage, drop, scanned } from './page.mjs';

const files = process.env.VIEWER_FILES, read = (name) => readFileSync(`${files}/${name}`);
const said = JSON.parse(read('case.json')), a = read('a.feather'), f = Math.fround;
let browser, page;
before(async () => {
    browser = await openBrowser();
    page = await openPage(browser);
    await drop(page, [{ name: 'a.feather', bytes: a }]);
});
after(() => browser?.close());

// What the page says of the world at a step
const valuesAt = (at) => page.evaluate(({ step, top, pendulum, hinge }) => {
    viewer.jump(step);
    const { world } = viewer, pose = (id) => {
        const b = world.body(Number(id)), { position: p, rotation: q } = b.transform, v = b.linearVelocity;
        return [p.x, p.y, p.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z];
    };
    return { step: viewer.step, hash: world.hash, kinetic: world.energy.kinetic, angle: world.joint(Number(hinge)).state.angle, box: pose(top), pendulum: pose(pendulum) };
}, { ...said, step: at });
const same = (found, wanted) => {
    assert.equal(found.step, wanted.step);
    assert.equal(found.hash, wanted.hash);
    assert.equal(found.kinetic, wanted.kinetic);
    assert.equal(f(found.angle), f(wanted.angle));
    for (const name of ['box', 'pendulum']) {
        assert.deepEqual(found[name].slice(0, 3), wanted[name].slice(0, 3));
        assert.deepEqual(found[name].slice(3).map(f), wanted[name].slice(3).map(f));
    }
};

test('every value is that of C, forwards and backwards', async () => {
    for (const wanted of said.steps) same(await valuesAt(wanted.step), wanted);
    for (const wanted of [...said.steps].reverse()) same(await valuesAt(wanted.step), wanted);
});

test('the page shows the values of what is picked, and what a note calls it', async () => {
    const wanted = said.steps[2];
    await page.evaluate(({ step, pendulum }) => { viewer.jump(step), viewer.pick({ body: Number(pendulum) }), viewer.panels(); }, { step: wanted.step, pendulum: said.pendulum });
    const text = await page.innerText('#inspector'), y = wanted.pendulum[1].toFixed(4).replace('-', '−');
    assert.match(text, /the pendulum/);
    assert.ok(text.includes(y), `${y} in ${text}`);
    assert.match(await page.innerText('#clock'), new RegExp(`^${wanted.step}\\b`));
    const title = await page.getAttribute('#inspector output >> nth=0', 'title');
    assert.deepEqual(title.split(', ').map(Number), wanted.pendulum.slice(0, 3));
    const outline = await page.innerText('#outline');
    assert.match(outline, /the pendulum/);
    await page.evaluate(({ hinge }) => { viewer.pick({ joint: Number(hinge) }), viewer.panels(); }, said);
    assert.ok((await page.innerText('#inspector')).includes(`${((wanted.angle * 180) / Math.PI).toFixed(3).replace('-', '−').slice(0, 5)}`));
});

test('the head tells what the step that is shown has, of a recording begun in an empty world too', async () => {
    const other = await openPage(browser);
    await drop(other, [{ name: 'empty.feather', bytes: read('empty.feather') }]);
    for (const step of [1, said.added, 2]) {
        await other.evaluate((at) => { viewer.jump(at), viewer.panels(); }, step);
        assert.match(await other.innerText('#facts'), new RegExp(`^${step} bod`));
    }
    await other.close();
});

test('a click picks the body under it', async () => {
    const at = await page.evaluate(({ top }) => {
        viewer.jump(0), viewer.pick(null), viewer.focus();
        return viewer.view.camera.updateMatrixWorld(), viewer.view.project(viewer.world.body(Number(top)).position);
    }, said);
    await page.mouse.click(at.x, at.y);
    assert.equal(await page.evaluate('viewer.picked?.body'), Number(said.top));
    await page.keyboard.press('Escape');
    assert.equal(await page.evaluate('viewer.picked'), null);
});

test('the timeline is scrubbed by the pointer, keys step, space plays to the end', async () => {
    await scanned(page);
    assert.equal(await page.evaluate('viewer.last'), said.last);
    const bar = await page.locator('#timeline').boundingBox();
    await page.mouse.click(bar.x + bar.width / 2, bar.y + bar.height / 2);
    await page.waitForFunction('viewer.goal === null');
    assert.ok(Math.abs((await page.evaluate('viewer.step')) - said.last / 2) <= 1);
    await page.evaluate('viewer.jump(57)');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction('viewer.goal === null && viewer.step === 58');
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction('viewer.goal === null && viewer.step === 57');
    assert.equal(await page.evaluate('viewer.world.hash'), said.steps[2].hash);
    await page.evaluate(`viewer.jump(${said.last - 20})`);
    await page.keyboard.press(' ');
    await page.waitForFunction(`!viewer.playing && viewer.step === ${said.last}`);
});

test('plots have a value for every step, of pinned values too', async () => {
    await scanned(page);
    for (const { step, kinetic } of said.steps) assert.equal(await page.evaluate((s) => viewer.series.at(s, 0), step), kinetic);
    const marks = () => page.evaluate('viewer.timeline.marks.map((m) => `${m.step} ${m.kind} ${m.text}`).sort()');
    const before = await marks();
    assert.ok(before.length > 1);
    await page.evaluate(({ pendulum }) => { viewer.pick({ body: Number(pendulum) }), viewer.pin('position.y'); }, said);
    await scanned(page);
    assert.deepEqual(await marks(), before); // the worker has told all events again
    for (const { step, pendulum } of said.steps) assert.equal(await page.evaluate((s) => viewer.series.at(s, viewer.series.width - 1), step), pendulum[1]);
    assert.ok(await page.isVisible('#plot'));
    await page.keyboard.press('p');
});

test('plots have the parts of the time of a step', async () => {
    await scanned(page);
    const rows = await page.evaluate((last) => {
        const { series, plots } = viewer, found = [];
        const columns = plots.all(), whole = columns.find((c) => c.name === 'time of a step').k;
        const parts = columns.filter((c) => c.name.startsWith('in '));
        for (let s = viewer.first + 1; s <= last; ++s) found.push([series.at(s, whole), parts.map((c) => series.at(s, c.k))]);
        return found;
    }, said.last);
    const sum = (list) => list.reduce((all, v) => all + v, 0);
    assert.equal(rows.length, said.last);
    for (const [step, parts] of rows) {
        assert.equal(parts.length, 8);
        for (const part of parts) assert.ok(part >= 0 && part <= step, `${part} of ${step}`);
    }
    const [steps, parts] = [sum(rows.map((r) => r[0])), sum(rows.map((r) => sum(r[1])))];
    assert.ok(parts > 0.5 * steps && parts <= 1.001 * steps, `${parts} of ${steps}`); // they do not overlap
});

// What the page copies, as a program; its exit and what it prints
function runTest(text, recording) {
    const source = `${files}/copied.c`, program = `${files}/copied`;
    const options = ['-std=c99', '-Wall', '-Wextra', '-Wpedantic', '-Werror', `-I${process.env.FEATHER_INCLUDE}`];
    writeFileSync(source, text);
    execFileSync('cc', [...options, source, process.env.FEATHER_LIBRARY, '-lm', '-pthread', '-o', program]);
    const { status, stdout } = spawnSync(program, [recording], { encoding: 'utf8' });
    return { status, stdout };
}

test('a step is copied as a test in C, which finds what the page showed, and nothing else', async () => {
    const copied = (body) => page.evaluate(({ picked, step }) => {
        viewer.jump(step), viewer.pick(picked && { body: Number(picked) }), viewer.panels();
        document.querySelector('[data-do=test]').click();
        return new Promise((go) => setTimeout(() => go(viewer.copied), 50));
    }, { picked: body, step: said.last - 1 });
    const [ofBody, ofWorld] = [await copied(said.pendulum), await copied(null)];
    assert.match(ofBody, /the pendulum/);
    const passes = { status: 0, stdout: 'as in the viewer\n' };
    for (const text of [ofBody, ofWorld]) assert.deepEqual(runTest(text, `${files}/a.feather`), passes);
    const nudged = runTest(ofWorld, `${files}/b.feather`);
    assert.equal(nudged.status, 1);
    assert.match(nudged.stdout, /hash is 0x[0-9a-f]{16}, not 0x[0-9a-f]{16}\ndiffers\n$/);
    const another = runTest(ofBody, `${files}/b.feather`); // its worlds have other numbers
    assert.equal(another.status, 1);
    assert.match(another.stdout, /is a body of world/);
    const altered = runTest(ofBody.replace(/"position.y", (.*), .*\}/, '"position.y", $1, 7.5}'), `${files}/a.feather`);
    assert.equal(altered.status, 1);
    assert.match(altered.stdout, /^position.y is -?[0-9.e-]+, not 7.5\ndiffers\n$/);
    const late = runTest(ofWorld.replace(/seek\(player, \d+\)/, 'seek(player, 1000000)'), `${files}/a.feather`);
    assert.deepEqual([late.status, late.stdout.slice(0, 23)], [1, 'the recording ends befo']);
});

test('what is drawn lies where the bodies are', async () => {
    const [drawn, wanted] = await page.evaluate(({ top }) => {
        viewer.jump(200), viewer.instances.draw(1);
        const k = viewer.instances.instancesOf(Number(top))[0], m = viewer.instances.matrixOf(k, viewer.view.camera.matrix.clone()).elements;
        return [[m[12], m[13], m[14], Math.hypot(m[0], m[1], m[2])], viewer.world.body(Number(top)).position];
    }, said);
    assert.deepEqual(drawn.slice(0, 3), [wanted.x, wanted.y, wanted.z].map(f));
    assert.ok(Math.abs(drawn[3] - 0.4) < 1e-6); // the half extent
});

test('the two first differ where C says it', async () => {
    await drop(page, [{ name: 'a.feather', bytes: a }, { name: 'b.feather', bytes: read('b.feather') }]);
    await page.waitForFunction('viewer.other.difference');
    const difference = await page.evaluate('viewer.other.difference');
    assert.equal(difference.step, said.first);
    assert.match(await page.innerText('#banner-text'), new RegExp(`differ first at step ${said.first}`));
    await page.evaluate('viewer.other.end()');
});

test('two are compared at the same step, though one begins later', async () => {
    let from = 0;
    for (let at = 40; at < a.length; at += 32 + Math.ceil(Number(a.readBigUInt64LE(at + 8)) / 8) * 8) {
        if (a.toString('latin1', at, at + 4) === 'KEYF' && a.readBigInt64LE(at + 24) < said.last) from = at;
    }
    const late = Buffer.concat([a.subarray(0, 40), a.subarray(from)]);
    await drop(page, [{ name: 'a.feather', bytes: a }, { name: 'late.feather', bytes: late }]);
    await page.waitForFunction('/the same/.test(document.getElementById("banner-text").textContent)');
    const found = await page.evaluate((step) => {
        viewer.jump(step);
        const { playback } = viewer.other;
        return { first: playback.first, step: playback.step, hashes: [viewer.world.hash, playback.world.hash] };
    }, said.last - 1);
    assert.ok(found.first > said.last / 2);
    assert.equal(found.step, said.last - 1);
    assert.equal(found.hashes[0], found.hashes[1]);
    assert.match(await page.innerText('#banner-text'), new RegExp(`bit for bit, for ${said.last - found.first} steps`));
    await page.evaluate('viewer.other.end()');
});

test('the same world goes on beside itself with twice the substeps, from the step where one asks', async () => {
    const found = await page.evaluate(({ pendulum }) => {
        const at = () => viewer.other.world.body(Number(pendulum)).position, own = () => viewer.world.body(Number(pendulum)).position;
        viewer.jump(57), viewer.other.settings();
        const start = [at(), own(), viewer.world.substeps, viewer.other.world.substeps];
        viewer.jump(100);
        const later = [at(), own()];
        viewer.jump(60); // before it: made anew there
        const again = [at(), own()];
        viewer.other.end();
        return { start, later, again };
    }, said);
    assert.deepEqual(found.start[0], found.start[1]);
    assert.equal(found.start[3], 2 * found.start[2]);
    for (const [there, here] of [found.later, found.again]) assert.ok(Math.abs(there.y - here.y) < 0.05, `${there.y}, ${here.y}`); // both swing
    assert.notEqual(found.later[0].y, found.start[0].y);
});

test('a body is copied as calls, a place as a link', async () => {
    const [c, python, link] = await page.evaluate(({ pendulum }) => {
        viewer.jump(57), viewer.pick({ body: Number(pendulum) });
        const all = [], { copy } = viewer;
        viewer.copy = (text) => all.push(text);
        for (const what of ['c', 'python']) document.querySelector(`[data-do=${what}]`).click();
        viewer.copy = copy;
        return [...all, viewer.link()];
    }, said);
    const y = said.steps[2].pendulum[1];
    assert.match(c, /fe_geometry_capsule\(&form, 0\.6\d*f, 0\.3\d*f\)/);
    for (const text of [c, python]) assert.ok(text.includes(String(y)), text);
    assert.match(link, /step=57&camera=(-?\d+\.\d{3}_){5}-?\d+\.\d{3}$/);
});

test('a packed recording plays as the plain one', async () => {
    await drop(page, [{ name: 'packed.feather', bytes: read('packed.feather') }]);
    for (const wanted of said.steps) same(await valuesAt(wanted.step), wanted);
});

test('a cut file says where it is cut and to which step it plays', async () => {
    await drop(page, [{ name: 'cut.feather', bytes: a.subarray(0, said.cut) }]);
    await scanned(page);
    assert.equal(await page.innerText('#banner-text'), `cut at byte ${said.cut}: plays to step ${said.cutStep}`);
    const wanted = said.steps.find((s) => s.step === 200);
    if (wanted.step <= said.cutStep) same(await valuesAt(200), wanted);
});

test('what is no recording, and an altered one, are told in words', async () => {
    const refused = async (bytes) => {
        await page.evaluate((text) => {
            viewer.open('x', new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))]).stream());
        }, Buffer.from(bytes).toString('base64'));
        await page.waitForFunction('!viewer.growing && !document.getElementById("banner").hidden');
        return page.innerText('#banner-text');
    };
    assert.match(await refused(Buffer.from('a text that is no recording, but longer than a header of one')), /no recording/);
    assert.match(await refused(Buffer.alloc(0)), /empty/);
    assert.match(await refused(a.subarray(0, 100)), /cut at byte 100/);
    const altered = Buffer.from(a);
    altered[said.size - 40] ^= 1;
    const text = await refused(altered);
    assert.match(text, /plays to step/);
    assert.doesNotMatch(text, /^cut/);
    same(await valuesAt(57), said.steps[2]);
});

test('taken over, the world is grabbed, thrown at, recorded, and left again', async () => {
    await drop(page, [{ name: 'a.feather', bytes: a }]);
    const got = await page.evaluate(({ top }) => {
        viewer.jump(57);
        const at = viewer.world.hash;
        viewer.takeOver(), viewer.pause();
        const start = viewer.world.hash, bodies = viewer.world.counters.bodies;
        viewer.taken.throw(), viewer.pause(), viewer.stepBy(30);
        const more = viewer.world.counters.bodies - bodies, hash = viewer.world.hash, bytes = viewer.bytes();
        viewer.takeOver();
        return { at, start, more, hash, bytes: Array.from(bytes), back: viewer.world.hash, step: viewer.step };
    }, said);
    assert.equal(got.start, said.steps[2].hash);
    assert.equal(got.more, 1);
    assert.equal(got.back, got.at);
    assert.equal(got.step, 57);
    await drop(page, [{ name: 'mine.feather', bytes: Uint8Array.from(got.bytes) }]);
    await scanned(page);
    assert.equal(await page.evaluate('viewer.jump(viewer.last), viewer.world.hash'), got.hash);
    assert.equal(await page.evaluate('viewer.bytes().length'), got.bytes.length);
    await drop(page, [{ name: 'a.feather', bytes: a }]);
    assert.equal(await page.evaluate('viewer.bytes().length'), a.length); // what was done belonged to the last one
});

test('?url= opens what a server has, and says what it lacks', async () => {
    const html = readFileSync(process.env.VIEWER_PAGE);
    const server = createServer((request, response) => {
        const path = new URL(request.url, 'http://x').pathname, body = path === '/' ? html : path === '/a.feather' ? a : null;
        response.writeHead(body ? 200 : 404, { 'content-type': path === '/' ? 'text/html' : 'application/octet-stream' }).end(body ?? '');
    });
    await new Promise((go) => server.listen(0, '127.0.0.1', go));
    const host = `http://127.0.0.1:${server.address().port}/`;
    const other = await openPage(browser, `${host}?url=a.feather&step=57`);
    await other.waitForFunction('viewer.step === 57 && viewer.goal === null');
    assert.equal(await other.evaluate('viewer.world.hash'), said.steps[2].hash);
    assert.deepEqual(other.errors, []);
    await other.close();
    const none = await openPage(browser, `${host}?url=none.feather`);
    await none.waitForFunction('!document.getElementById("banner").hidden');
    assert.match(await none.innerText('#banner-text'), /404/);
    await none.close(), server.close(), server.closeAllConnections();
});

test('what an address asks for in vain is told in words', async () => {
    const vain = [['?url=%E0%A4%A', /cannot be read/], ['?ws=nonsense:1', /cannot be opened/], ['?demo=99', /no demo 99/]];
    for (const [wish, words] of vain) {
        const other = await openPage(browser, wish);
        await other.waitForFunction('!document.getElementById("banner").hidden');
        assert.match(await other.innerText('#banner-text'), words);
        assert.deepEqual(other.errors, []);
        await other.close();
    }
});

test('a link names the demo that is open, and its step, however far, is gone to', async () => {
    const other = await openPage(browser, '?demo=1&step=700');
    await other.waitForFunction('viewer.step === 700 && viewer.goal === null');
    assert.match(await other.evaluate('viewer.link()'), /\?demo=1&step=700&/);
    await drop(other, [{ name: 'a.feather', bytes: a }]);
    assert.match(await other.evaluate('viewer.link()'), /\?demo=none&step=/);
    assert.deepEqual(other.errors, []);
    await other.close();
});

test('a file that grows is shown live, from its start or from its last keyframe', async () => {
    const file = `${files}/growing.feather`, half = said.cut;
    writeFileSync(file, a.subarray(0, half));
    const live = spawn('python3', ['tools/feather-live', file, '--port', '0', '--page', process.env.VIEWER_PAGE], { stdio: ['ignore', 'pipe', 'inherit'] });
    try {
        const [line] = await once(live.stdout, 'data'), host = String(line).match(/http:[^ ]*/)[0];
        const shown = await openPage(browser, host);
        await shown.waitForFunction(`viewer.playback?.ready && viewer.scanner.ended && viewer.last === ${said.cutStep}`);
        assert.equal(await shown.evaluate('viewer.isEndKnown'), false);
        await shown.waitForFunction(`viewer.step === ${said.cutStep}`); // it is there, and does not play what was
        appendFileSync(file, a.subarray(half));
        await shown.waitForFunction(`viewer.last === ${said.last} && viewer.scanner.ended`);
        for (const wanted of said.steps) {
            assert.equal(await shown.evaluate((step) => (viewer.jump(step), viewer.world.hash), wanted.step), wanted.hash);
        }
        assert.equal(await shown.evaluate('viewer.playing'), false);
        await shown.keyboard.press('End');
        await shown.waitForFunction('viewer.playing && viewer.isFollowingEnd');
        const [word] = String(line).match(/\?ws=\S+/), disk = await openPage(browser, word); // a page from a disk
        await disk.waitForFunction(`viewer.last === ${said.last}`);
        await disk.close();
        const late = await openPage(browser, `${host}last`);
        await late.waitForFunction('viewer.playback?.ready && viewer.scanner.ended');
        assert.equal(await late.evaluate(`viewer.jump(${said.last}), viewer.world.hash`), said.steps.at(-1).hash);
        assert.ok((await late.evaluate('viewer.first')) > said.last / 2);
        assert.deepEqual([...shown.errors, ...late.errors], []);
        await shown.close(), await late.close();
    } finally {
        live.kill();
    }
});

test('on a phone the panels are sheets, and nothing lies outside the page', async () => {
    const phone = await openPage(browser, '?demo=none', { width: 390, height: 780 });
    await drop(phone, [{ name: 'a.feather', bytes: a }]);
    assert.equal(await phone.isVisible('#left'), false);
    await phone.click('#outline-button');
    assert.equal(await phone.isVisible('#left'), true);
    await phone.click('.row >> nth=1');
    await phone.click('#inspect-button');
    assert.equal(await phone.isVisible('#right'), true);
    for (const id of ['top', 'bottom', 'right', 'play', 'theme', 'plots-button']) {
        const { x, width } = await phone.locator(`#${id}`).boundingBox();
        assert.ok(x >= 0 && x + width <= 390, `${id} from ${x} to ${x + width}`);
    }
    assert.deepEqual(phone.errors, []);
    await phone.close();
});

test('no script failed', () => assert.deepEqual(page.errors, []));
