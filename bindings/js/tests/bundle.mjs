// The scene of scenario.mjs and the package, bundled for a page as main.js and what it loads.
//   node bundle.mjs vite | webpack  folder [threads]     in the folder of node_modules; with /threads, three of them
import { copyFileSync, mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [bundler, out, threads] = process.argv.slice(2), root = process.cwd(), source = `${root}/page`;
const find = createRequire(`${root}/`).resolve, load = async (name) => import(pathToFileURL(find(name)));
mkdirSync(source, { recursive: true });
copyFileSync(new URL('scenario.mjs', import.meta.url), `${source}/scenario.mjs`);
writeFileSync(`${source}/package.mjs`, !threads ? "import Feather from 'feather-physics';\nexport default await Feather();\n" : `
import Feather from 'feather-physics/threads';
const feather = await Feather({ threads: 3 });
if (feather.threads !== 3) throw new Error(feather.reason);
export default feather;`);

async function vite() {
    const { build } = await import(pathToFileURL(`${root}/node_modules/vite/dist/node/index.js`));
    const output = { entryFileNames: 'main.js', chunkFileNames: '[name].js', assetFileNames: '[name][extname]' };
    await build({ root: source, base: './', logLevel: 'warn', worker: { rollupOptions: { output: { ...output, entryFileNames: '[name].js' } } }, build: { outDir: out, emptyOutDir: true, target: 'esnext', rollupOptions: { input: `${source}/scenario.mjs`, output } } });
}
async function webpack() {
    const { default: make } = await load('webpack');
    const output = { path: out, filename: 'main.js', chunkFilename: '[id].js', assetModuleFilename: '[name][ext]', module: true, clean: true };
    const stats = await new Promise((resolve, reject) => make({ mode: 'production', context: source, entry: './scenario.mjs', output, experiments: { outputModule: true }, performance: { hints: false } })
        .run((error, result) => (error ? reject(error) : resolve(result))));
    if (stats.hasErrors() || stats.hasWarnings()) throw new Error(stats.toString('errors-warnings'));
}
await { vite, webpack }[bundler]();
