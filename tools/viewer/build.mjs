// Builds the viewer, one page without a file beside it: scripts by esbuild, the module deflated, as base64.
//   node build.mjs package tools out      the folder of `make js`, that of node_modules, viewer.html
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [feather, tools, out] = process.argv.slice(2).map((p) => resolve(p)), source = fileURLToPath(new URL('src/', import.meta.url));
const MOST = 2e6; // bytes of the page
const { build } = createRequire(`${tools}/`)('esbuild');
const script = async (entry, format) => {
    const made = await build({
        entryPoints: [source + entry], bundle: true, minify: true, format, target: 'es2022', write: false, legalComments: 'none', charset: 'utf8',
        nodePaths: [`${tools}/node_modules`],
        alias: { 'feather-physics/module': `${feather}/module.js`, 'feather-physics/core.js': `${feather}/core.js` },
    });
    return made.outputFiles[0].text.replace(/<\/script/g, '<\\/script');
};
const style = await build({ entryPoints: [`${source}style.css`], minify: true, write: false });
const parts = {
    '/*STYLE*/': style.outputFiles[0].text.trim(),
    '/*MODULE*/': gzipSync(readFileSync(`${feather}/feather.wasm`), { level: 9 }).toString('base64'),
    '/*WORKER*/': await script('scan.js', 'iife'),
    '/*MAIN*/': await script('main.js', 'esm'),
};
let page = readFileSync(`${source}page.html`, 'utf8');
for (const [mark, text] of Object.entries(parts)) page = page.replace(mark, () => text);
writeFileSync(out, page);
const size = Buffer.byteLength(page);
console.log(`  ${out}: ${Math.round(size / 1e3)} KB, ${Math.round(gzipSync(page).length / 1e3)} KB with gzip`);
for (const [mark, text] of Object.entries(parts)) console.log(`      ${mark.slice(2, -2).toLowerCase().padEnd(7)} ${Math.round(Buffer.byteLength(text) / 1e3)} KB`);
if (size > MOST) throw new Error(`the page has ${size} bytes, more than ${MOST}`);
