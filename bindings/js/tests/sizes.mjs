// sizes.mjs - what docs/javascript.md says of the module's size is so, to 5 %: by the compiler that the page names.
//   node sizes.mjs PACKAGE DOCUMENT
import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

const [folder, document] = process.argv.slice(2), text = readFileSync(document, 'utf8');
const told = text.match(/`feather\.wasm`\s+has\s+(\d+)\s+KB,\s+(\d+)\s+KB\s+with\s+gzip/);
if (!told) throw new Error(`${document} tells no size of feather.wasm`);
const bytes = readFileSync(`${folder}/feather.wasm`), sizes = [bytes.length, gzipSync(bytes, { level: 9 }).length].map((b) => b / 1024);
sizes.forEach((size, i) => {
    const said = Number(told[i + 1]);
    if (Math.abs(size / said - 1) > 0.05) throw new Error(`${document} says ${said} KB, and it is ${size.toFixed(0)} KB`);
});
console.log(sizes.map((size) => `${size.toFixed(0)} KB`).join(', '));
