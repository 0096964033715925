// Serves this folder, and build/js as /feather-physics:  make js; cd examples/web; npm ci; npm start
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { extname, normalize } from 'node:path';

const SCRIPT = 'text/javascript';
const TYPES = { '.html': 'text/html', '.js': SCRIPT, '.mjs': SCRIPT, '.wasm': 'application/wasm' };
const here = fileURLToPath(new URL('.', import.meta.url));
const built = fileURLToPath(new URL('../../build/js/', import.meta.url));
const port = Number(process.argv[2] ?? 8080);
createServer(async (request, response) => {
    const path = normalize(new URL(request.url, 'http://host').pathname);
    const [, part] = path.match(/^\/feather-physics\/(.*)/) ?? [];
    const file = part ? built + part : here + (path === '/' ? 'index.html' : path.slice(1));
    try {
        const bytes = await readFile(file);
        response.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'text/plain' });
        response.end(bytes);
    } catch {
        response.writeHead(404).end('there is no such file');
    }
}).listen(port, '127.0.0.1', () => console.log(`http://127.0.0.1:${port}`));
