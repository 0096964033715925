// inline.mjs - feather-physics/inline: the module as base64 in a script, for hosts that serve no other files.
//   node inline.mjs feather.wasm > inline.js
import { readFileSync } from 'node:fs';
console.log(`// Made from feather.wasm by bindings/js/inline.mjs
import Start from './module.js';
export * from './names.js';
const text = '${readFileSync(process.argv[2]).toString('base64')}';
const bytes = () => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
export default function Feather() { return Start(bytes()); }
Feather.sync = () => Start.sync(bytes());`);
