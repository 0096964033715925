// resolve.mjs - so that the page's modules find the package in node, as esbuild lets them: FEATHER_PACKAGE is its folder.
import { pathToFileURL } from 'node:url';

const folder = `${pathToFileURL(process.env.FEATHER_PACKAGE).href}/`;
const FILES = { 'feather-physics/module': 'module.js', 'feather-physics/core.js': 'core.js' };
export async function resolve(name, context, next) {
    return next(FILES[name] ? folder + FILES[name] : name, context);
}
