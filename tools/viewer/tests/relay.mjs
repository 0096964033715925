// relay.mjs - feather-live: to whom it gives the file, and when a file is another one.
import test, { before, after } from 'node:test';
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { once } from 'node:events';
import { request } from 'node:http';
import { tmpdir } from 'node:os';

const folder = mkdtempSync(`${tmpdir()}/feather-live-`), file = `${folder}/run.feather`;
let live, host, word;
before(async () => {
    writeFileSync(file, 'one');
    const relay = new URL('../../feather-live', import.meta.url).pathname;
    live = spawn('python3', [relay, file, '--port', '0'], { stdio: ['ignore', 'pipe', 'ignore'] });
    const [line] = await once(live.stdout, 'data');
    [, host, word] = String(line).match(/ws:\/\/([^/]*)\/(\S+)/);
});
after(() => (live.kill(), rmSync(folder, { recursive: true })));

// The status, and the socket when there is one
const ask = (path, origin) => new Promise((done, fail) => {
    const headers = { Upgrade: 'websocket', Connection: 'Upgrade', 'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==' };
    const asked = request(`http://${host}${path}`, { headers: origin ? { ...headers, Origin: origin } : headers });
    asked.on('upgrade', (response, socket, head) => done({ status: response.statusCode, socket, head }));
    asked.on('response', (response) => (response.resume(), done({ status: response.statusCode })));
    asked.on('error', fail).end();
});
const statusOf = async (path, origin) => {
    const { status, socket } = await ask(path, origin);
    socket?.destroy();
    return status;
};

test('its own page and programs read the file, other pages do not', async () => {
    assert.equal(await statusOf('/'), 101);
    assert.equal(await statusOf('/', `http://${host}`), 101);
    for (const path of ['/', '/last', '/a-word', '/a-word/last']) {
        for (const origin of ['null', 'http://elsewhere.example', `https://${host}`]) {
            assert.equal(await statusOf(path, origin), 403);
        }
    }
});

test('a page from a disk reads it by the word', async () => {
    for (const path of [`/${word}`, `/${word}/last`]) assert.equal(await statusOf(path, 'null'), 101);
});

test('a file that was replaced by another one of its length ends the socket', async () => {
    const { socket, head } = await ask('/'), got = [head];
    socket.on('data', (bytes) => got.push(bytes));
    while (!Buffer.concat(got).includes('one')) await once(socket, 'data');
    writeFileSync(`${file}.new`, 'two'), renameSync(`${file}.new`, file);
    await once(socket, 'end');
    const close = [0x88, 2, 1000 >> 8, 1000 & 255]; // as RFC 6455 has it
    assert.deepEqual([...Buffer.concat(got).subarray(-4)], close);
    socket.destroy();
});
