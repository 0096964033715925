// page.mjs - a page of headless Chromium with the viewer in it, opened as a file.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const { chromium } = createRequire(`${process.env.VIEWER_TOOLS}/`)('playwright-core');
export const ARGS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']; // WebGL 2 without a GPU, as root too
const LIMIT = 240e3; // ms; a busy machine draws a frame in a second

export async function openBrowser() { return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ARGS }); }
// Its errors end the test that looks: page.errors
export async function openPage(browser, wish = '?demo=none', size = { width: 900, height: 600 }) {
    const page = await browser.newPage({ viewport: size });
    page.setDefaultTimeout(LIMIT);
    page.errors = [];
    page.on('pageerror', (error) => page.errors.push(error.stack));
    await page.goto((wish.startsWith('http') ? '' : pathToFileURL(process.env.VIEWER_PAGE).href) + wish);
    await page.waitForFunction('window.viewer');
    return page;
}
// As a hand does it: the browser makes a File of the bytes and drops it
export async function drop(page, files) {
    const given = files.map(({ name, bytes }) => ({ name, text: Buffer.from(bytes).toString('base64') }));
    await page.evaluate((list) => {
        const transfer = new DataTransfer();
        for (const { name, text } of list) transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
        for (const type of ['dragenter', 'dragover', 'drop']) document.body.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer: transfer }));
    }, given);
    await page.waitForFunction('viewer.playback?.ready && !viewer.growing');
    await page.evaluate('viewer.pause()');
}
export const scanned = (page) => page.waitForFunction('viewer.scanDone');
