// feather-physics/module: the caller brings the module: bytes, a WebAssembly.Module, a Response, or a promise of one.
import { start, startAsync } from './runtime.js';
import { feather } from './names.js';
export * from './names.js';

export default async function Feather(source) {
    await startAsync(await source);
    return feather;
}
Feather.sync = (source) => {
    start(source);
    return feather;
};
