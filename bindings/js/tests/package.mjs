// The package as it was built: FEATHER_PACKAGE is its folder. With FEATHER_THREADS so many threads.
import { pathToFileURL } from 'node:url';
const folder = process.env.FEATHER_PACKAGE ?? new URL('../../../build/js', import.meta.url).pathname;
export const file = (name) => pathToFileURL(`${folder}/${name}`);
const threads = Number(process.env.FEATHER_THREADS ?? 0);
const { default: Feather } = await import(file(threads ? 'threads.js' : 'index.js'));
const feather = await Feather(threads ? { threads } : undefined);
if (threads && feather.threads !== threads) throw new Error(`${feather.threads} threads of ${threads}: ${feather.reason}`);
export { Feather };
export default feather;
