// The package as it was built: FEATHER_PACKAGE is its folder.
import { pathToFileURL } from 'node:url';
const folder = process.env.FEATHER_PACKAGE ?? new URL('../../../build/js', import.meta.url).pathname;
export const file = (name) => pathToFileURL(`${folder}/${name}`);
const { default: Feather } = await import(file('index.js'));
export { Feather };
export default await Feather();
