// keys.js - what keys do, and the card that tells it.
export const PARTS = [
    ['contacts', 'C', 'points and normals'], ['forces', 'F', 'of contacts and joints'], ['joints', 'J', 'anchors and frames'], ['limits', 'K', 'where joints stand'],
    ['bounds', 'B', 'the box around each shape'], ['centres', 'M', 'centres of mass'], ['trees', 'T', 'the broad phase'], ['islands', 'I', 'a hue for each'], ['sleep', 'S', 'who sleeps is dim'],
];
const CARD = [['Play, pause', 'Space'], ['A step', '← →'], ['A second', '⇧← ⇧→'], ['Start, end', 'Home End'], ['Speed', '[ ]'], ['Again and again', 'R'], ['Frame what is picked, or all', 'Z'], ['Follow what is picked', 'X'],
    ['Throw a box', 'V'], ['Nothing picked', 'Esc'], ['From the front, the side, above', '1 2 3'], ['Search', '/'], ['Plots', 'P'], ['Take over', 'G'], ['Light, dark', 'L'], ['Open', 'O'], ...PARTS.map(([name, key]) => [name, key])];

export function listen(app) {
    const help = document.getElementById('help');
    help.firstElementChild.innerHTML = CARD.map(([what, key]) => `<p>${what} <span>${key.split(' ').map((k) => `<kbd>${k}</kbd>`).join(' ')}</span></p>`).join('');
    help.onclick = () => (help.hidden = true);
    const step = (n) => app.stepBy(n), second = () => Math.max(1, Math.round(1 / app.dt));
    const keys = {
        ' ': () => app.toggle(), arrowleft: (e) => step(e.shiftKey ? -second() : -1), arrowright: (e) => step(e.shiftKey ? second() : 1), home: () => app.seek(app.first), end: () => app.toEnd(),
        '[': () => app.timeline.setSpeed(-1), ']': () => app.timeline.setSpeed(1), r: () => app.timeline.setLoop(!app.timeline.loop), z: () => app.focus(), x: () => app.follow(),
        escape: () => (help.hidden ? app.pick(null) : (help.hidden = true)), 1: () => app.view.direct(0, 0.12, 1), 2: () => app.view.direct(1, 0.12, 0), 3: () => app.view.direct(0, 1, 0.001),
        '/': () => document.getElementById('search').focus(), p: () => app.plots.toggle(), g: () => app.takeOver(), v: () => app.taken.throw(), l: () => app.theme(), o: () => document.getElementById('open').click(), '?': () => (help.hidden = !help.hidden),
        ...Object.fromEntries(PARTS.map(([name, key]) => [key.toLowerCase(), () => app.show(name)])),
    };
    addEventListener('keydown', (e) => {
        const typing = e.target.matches('input, select, textarea');
        if (typing && e.key === 'Escape') return e.target.blur();
        if (typing || e.ctrlKey || e.metaKey || e.altKey) return undefined;
        const act = keys[e.key.toLowerCase()];
        if (!act || (e.target.matches('button, summary') && e.key === ' ')) return undefined;
        e.preventDefault();
        return act(e);
    });
}
