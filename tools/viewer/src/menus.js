// menus.js - the menus at the top.
import { DEMOS } from './demo.js';
import { PARTS } from './keys.js';
import { choose } from './load.js';
const $ = (id) => document.getElementById(id);

function item(name, told, key, act) {
    const b = document.createElement('button');
    b.innerHTML = `<i></i><span>${name}${told ? `<small>${told}</small>` : ''}</span>${key ? `<kbd>${key}</kbd>` : ''}`;
    b.onclick = () => act(b);
    return b;
}
const close = () => { for (const d of document.querySelectorAll('details[open]')) d.open = false; };
function save(name, bytes, type) {
    const a = document.createElement('a');
    a.href = URL.createObjectURL(new Blob([bytes], { type })), a.download = name, a.click();
    setTimeout(() => URL.revokeObjectURL(a.href), 1000);
}
async function picture(app) {
    app.view.render(); // the picture is read in the same task
    const blob = await new Promise((done) => app.view.renderer.domElement.toBlob(done, 'image/png'));
    save(`${app.fileName ?? 'feather'}-${app.step}.png`, blob, 'image/png');
}
// A few seconds of what is seen, as the browser encodes it
let clip = null;
function record(app, button) {
    if (clip) return clip.stop();
    const canvas = app.view.renderer.domElement, parts = [];
    clip = new MediaRecorder(canvas.captureStream(60), { mimeType: 'video/webm', videoBitsPerSecond: 12e6 });
    clip.ondataavailable = (e) => parts.push(e.data);
    clip.onstop = () => { clip = null, button.firstElementChild.textContent = '', save(`${app.fileName ?? 'feather'}.webm`, new Blob(parts), 'video/webm'); };
    clip.start(), button.firstElementChild.textContent = '●';
    return undefined;
}

export function menus(app) {
    $('demo-list').append(...DEMOS.map((d, k) => item(d.name, d.told, '', () => { close(), app.demo(k); })));
    const parts = PARTS.map(([name, key, told]) => { const b = item(name, told, key, () => app.show(name)); b.dataset.part = name; return b; });
    $('show-list').append(...parts);
    app.menu = () => { for (const b of parts) b.firstElementChild.textContent = app.parts.has(b.dataset.part) ? '✓' : ''; };
    app.menu();
    const then = (act) => (b) => { close(), act(b); };
    $('tool-list').append(
        item('Compare with another recording', 'drop two files, or choose the second here', '', then(() => choose(async (file) => app.compare(file.name, await file.arrayBuffer())))),
        item('Compare with other settings', 'the same calls from here on, twice the substeps', '', then(() => app.other.settings())),
        item('Take over', 'leave the recording, grab bodies, throw boxes', 'G', then(() => app.takeOver())),
        item('Save as a recording', 'what you did since you took over, or the recording itself', '', then(() => save((app.fileName ?? 'run').replace(/(\.feather)?$/, '.feather'), app.bytes(), 'application/octet-stream'))),
        document.createElement('hr'),
        item('Copy a link', 'place, step, camera', '', then(() => app.copyLink())),
        item('Picture', 'as PNG', '', then(() => picture(app))),
        item('Clip', 'as WebM; once more to end it', '', (b) => record(app, b)),
        document.createElement('hr'),
        item('Keys', '', '?', then(() => ($('help').hidden = false))),
    );
    for (const d of document.querySelectorAll('details')) d.ontoggle = () => d.open && document.querySelectorAll('details[open]').forEach((o) => o !== d && (o.open = false));
}
