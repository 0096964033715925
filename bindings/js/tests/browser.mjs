// The scene of scenario.mjs in a page of headless Chromium, served as a host serves files: prints its two lines.
//   node browser.mjs [index.js | inline.js]     the package, or
//   node browser.mjs threads.js                 three threads, in an isolated page
//   node browser.mjs alone                      the same in a page that is not isolated: one thread
//   node browser.mjs bundle folder              what bundle.mjs made of it, in an isolated page
import { createServer } from 'node:http';
import { spawn } from 'node:child_process';
import { readFileSync, existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { fileURLToPath } from 'node:url';

const wanted = process.argv[2] ?? 'index.js', entry = wanted === 'alone' ? 'threads.js' : wanted, LIMIT = 240e3; // ms; a busy machine takes a minute
const folder = process.argv[3] ?? process.env.FEATHER_PACKAGE ?? fileURLToPath(new URL('../../../build/js', import.meta.url));
const page = `<!doctype html><meta charset=utf-8><script type=module>
const lines = [], log = console.log;
console.log = (line) => { lines.push(line); log(line); };
const send = (text) => fetch('/result', { method: 'POST', body: text });
addEventListener('error', (e) => send('ERROR ' + e.message));
addEventListener('unhandledrejection', (e) => send('ERROR ' + e.reason));
try { await import('${entry === 'bundle' ? '/js/main.js' : '/scenario.mjs'}'); await send(lines.join('\\n')); } catch (e) { await send('ERROR ' + e.stack); }
</script>`;
const served = {
    '/': ['text/html', page],
    '/package.mjs': ['text/javascript', entry !== 'threads.js' ? `import Feather from '/js/${entry}';\nexport default await Feather();` : `
import Feather from '/js/threads.js';
const feather = await Feather({ threads: 3 }), wanted = ${wanted === 'alone' ? 1 : 3};
if (feather.threads !== wanted) throw new Error(feather.threads + ' threads: ' + feather.reason);
export default feather;`],
    '/scenario.mjs': ['text/javascript', readFileSync(new URL('scenario.mjs', import.meta.url))],
};
const profile = mkdtempSync(`${tmpdir()}/feather-chromium-`);
let browser;
function end(text, status) {
    console.log(text);
    browser?.kill();
    server.close(), server.closeAllConnections();
    setTimeout(() => {
        rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 250 }); // its processes end one by one
        process.exit(status);
    }, 300);
}
const server = createServer((request, response) => {
    if (request.url === '/result') {
        let text = '';
        request.on('data', (part) => (text += part)).on('end', () => (response.end(), end(text, text.startsWith('hash ') ? 0 : 1)));
        return;
    }
    const file = `${folder}/${request.url.replace('/js/', '')}`;
    const found = served[request.url] ?? (/^\/js\/[\w.-]+$/.test(request.url) && existsSync(file)
        ? [file.endsWith('.wasm') ? 'application/wasm' : 'text/javascript', readFileSync(file)] : undefined);
    const isolated = ['threads.js', 'bundle'].includes(wanted) ? { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' } : {};
    response.writeHead(found ? 200 : 404, { 'content-type': found?.[0] ?? 'text/plain', ...isolated });
    response.end(found?.[1] ?? 'none');
}).listen(0, '127.0.0.1', () => {
    browser = spawn(process.env.CHROMIUM ?? 'chromium', ['--headless', '--no-sandbox', '--disable-gpu', `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore' });
    browser.on('error', (error) => end(`ERROR ${error.message}`, 1));
    setTimeout(() => end('ERROR nothing came from the browser', 1), LIMIT);
});
